// What a stored number of the other control would have to be: least squares on the pairs.
#pragma once

#include <optional>

#include "choices/compared_run.h"
#include "choices/store_table.h"

namespace trunnion::choices {

struct FittedNumber {
    std::string name, unit;
    double from = 0.0, to = 0.0;  ///< in this control, in the other one
    double sigma = 0.0;           ///< scaled by what the fit leaves
};

struct StoreFit {
    std::vector<FittedNumber> numbers;  ///< those that stand out from their uncertainty
    setup::Setup setup;                 ///< with the fitted numbers
    ComparedRun run;
    std::vector<double> left_out;  ///< losses of the rows, their fold left out of the fit
    bool seen = false;             ///< the program's path depends on the store
};

/// Gauss-Newton through the control, from the store as it is. A pair whose place slides along its
/// segment says nothing about the direction of travel. `blocks`: block of each row. No numbers
/// where nothing improves; `seen` tells whether that is for want of influence.
StoreFit fit_store(const Comparer& comparer, const setup::Setup& setup, const ComparedRun& before,
                   const Store& store, const std::vector<int>& blocks);

}  // namespace trunnion::choices
