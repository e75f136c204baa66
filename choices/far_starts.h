// Other values of a store's numbers from which its fit may begin, where none leads from the present
// one.
#pragma once

#include <vector>

#include "choices/store_columns.h"

namespace trunnion::choices {

/// A control with one number changed.
struct FarStart {
    const StoredNumber* number;
    FittedControl control;
};

/// An empty number may be a move less (G43 without a length), so that it has no derivative: it
/// starts beside its value. In a log without numbers of blocks a large difference of one axis
/// brings the rows to wrong moves: the other axes tell their order, and the distances of most moves
/// in this axis what the number lacks.
class FarStarts {
  public:
    FarStarts(const Comparer& comparer, const FittedControl& now)
        : comparer_(comparer), now_(now) {}

    /// `has_derivative`: at its present value.
    std::vector<FarStart> of(const StoredNumber& number, bool has_derivative) const;
    /// Variables that are all vacant, as if all were set: one of them alone may not do.
    std::vector<FarStart> of_vacant(const Numbers& numbers) const;

  private:
    std::vector<double> lacks(const FittedControl& here, const StoredNumber& number) const;

    const Comparer& comparer_;
    const FittedControl& now_;
};

}  // namespace trunnion::choices
