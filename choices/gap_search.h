// Search for the causes of a control's gap: candidates, their scores, greedy selection.
#pragma once

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "choices/choice_table.h"
#include "choices/store_fit.h"

namespace trunnion::choices {

/// A change of the control that may explain the log.
struct GapCandidate {
    std::string name, what;
    std::function<void(setup::Setup&)> take;
    std::vector<FittedNumber> numbers;
    ComparedRun run;
    std::vector<double> left_out;  ///< losses of the rows, each evaluated without its fold
    double score = 0.0;            ///< log evidence, up to a common constant
    bool store = false;            ///< numbers of a store; else an option
};

/// One accepted change with its results.
struct GapStep {
    GapCandidate chosen;
    std::vector<std::string> rivals;
    double probability = 0.0;       ///< among all candidates and none
    bool only_passes_stop = false;  ///< an option under which a program goes on that stopped, and
                                    ///< that changes nothing before
};

struct GapSearch {
    std::vector<GapStep> steps;
    setup::Setup setup;
    ComparedRun run;  ///< with all steps
    /// Losses of the rows, each fold left out of the decisions for options, or, as soon as there
    /// are stores, of the fit of their numbers: options beside stores count as decided.
    std::vector<double> left_out;
    std::vector<std::string> unseen;
};

struct SearchQuestion {
    const Comparer& comparer;
    const setup::Setup& setup;
    const ComparedRun& before;
    const std::vector<int>& blocks;  ///< block of each row, from 0
    const ProgramStores& used;       ///< by the programs
    double alike = 0.0;  ///< not 0: the difference is smaller than the noise of a row, and so many
                         ///< rows count as one
};

/// Score: -n/2 ln(mean loss) - k/2 ln n with n = blocks times axes, linear below a mean of 1. It is
/// independent of scale, so an unexplained remainder tempers it. Within the noise: -loss/2 - k/2
/// ln n of the rows that count.
GapSearch search_causes(const SearchQuestion& question,
                        const std::function<void(const char*)>& watch);

}  // namespace trunnion::choices
