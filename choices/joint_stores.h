// Stores that explain a log together: which ones, with which numbers, and what would do as well.
#pragma once

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "choices/store_fit.h"

namespace trunnion::choices {

/// One store of those found.
struct StoreCause {
    std::string name, what;
    std::vector<FittedNumber> numbers;  ///< those that differ from the start
    double others = 0.0;                ///< sum of the odds of sets without it
    std::vector<std::string> rivals;    ///< stores that do as well in its place
};

struct JointStores {
    FittedControl control;
    std::vector<StoreCause> causes;
    std::vector<double> left_out;   ///< losses of the rows, with their fold left out of the fit
    std::set<std::string> weighed;  ///< numbers that were compared; the others have no influence
};

/// Of a score: sets that differ by less leave as much of the gap. The one with fewer numbers is no
/// surer than the other: that a program shows more numbers of a store says nothing about it.
constexpr double equal_score = 0.05;

/// Score of a set: of its loss and the number of its numbers.
using SetScore = std::function<double(double loss, std::size_t numbers)>;

struct StoreQuestion {
    const Comparer& comparer;
    const setup::Setup& start;  ///< the control with its options and its own stores
    const std::vector<int>& blocks;
    const ProgramStores& used;  ///< of store_table
    SetScore score;
    double least_odds;  ///< of the score: what a further store costs
    double rival_gap;   ///< of the score: a set that is closer is a rival
};

/// Two stale stores may look like a third with another value, as long as they are sought one after
/// the other. So the numbers of all stores are weighed at once: at the run `now` their derivatives
/// are known, and with these sets are compared by least squares without another run: a number or
/// a store more, less, or in place of another, or one store in place of two. The best set is fitted
/// through the control, and the comparison repeated there. `now`: with the stores found so far;
/// what is returned scores at least as much, apart from foreign blocks. A store in place of one of
/// those found is fitted through the control, too.
JointStores explained_together(const StoreQuestion& question, FittedControl now);

}  // namespace trunnion::choices
