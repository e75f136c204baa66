// The values of a stored number with which a log agrees as well: samples do not show every end.
#pragma once

#include "choices/gap_search.h"

namespace trunnion::choices {

struct AgreeingRange {
    double low = 0.0, high = 0.0;
    bool anything =
        false;  ///< no value within `most_searched` and above the number's least differs
};

constexpr double most_searched = 5.0;  ///< mm or deg, to each side

/// Around the value of `control`, by runs with others. `step`: the first one to each side; where
/// both already differ, the range is empty.
AgreeingRange agreeing_range(const Comparer& comparer, const FittedControl& control,
                             const StoredNumber& number, double step);

/// A number that was found with a sigma smaller than such a range gets its middle, and the sigma of
/// a value that may be anywhere in it.
void settle_in_ranges(const SearchQuestion& question, GapSearch& found);

/// Numbers of canned cycles (5114, 5115) that the program uses and that the log does not show, or
/// only within a range: notes; the names of those that it does not show.
std::vector<std::string> tell_ranges(const Comparer& comparer, const FittedControl& control,
                                     std::vector<std::string>& notes);

}  // namespace trunnion::choices
