// The active states of a control along one recorded run.
#pragma once

#include "regression/recorded_run.h"

namespace trunnion::regression {

/// Equal within float rounding.
bool same_value(const std::array<double, 3>& p, const std::array<double, 3>& q);

/// The states of one run by segment.
class RunStates {
  public:
    explicit RunStates(const RecordedRun& run) : rows_(run.states) {}

    /// The state row of a segment.
    std::uint64_t at(std::uint64_t segment);
    StateRow row(std::uint64_t index) { return rows_[index]; }
    /// The row where a field got the value that it has at `index`; searches at most 20,000 rows.
    std::uint64_t entry(const SnapshotField& field, std::uint64_t index);

  private:
    SpilledWindow<StateRow> rows_;
};

}  // namespace trunnion::regression
