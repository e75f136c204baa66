// Required value of a stored number on the other control: least squares on the pairs.
#pragma once

#include <optional>

#include "choices/compared_run.h"
#include "choices/store_columns.h"

namespace trunnion::choices {

struct FittedNumber {
    std::string name, unit;
    double from = 0.0, to = 0.0;  ///< value in this control, in the other one
    double sigma = 0.0;           ///< scaled by the residual of the fit
};

struct StoreFit {
    std::vector<FittedNumber> numbers;  ///< the significant ones
    setup::Setup setup;                 ///< with the fitted numbers
    ComparedRun run;
    std::vector<double> left_out;  ///< losses of the rows, with their fold left out of the fit
    bool seen = false;             ///< the path of the program depends on the store
};

/// Gauss-Newton through the control, starting from the present store. A pair whose point slides
/// along its segment contains no information along the direction of travel. `blocks`: block of each
/// row. No numbers if nothing improves; `seen` is false if the store has no influence.
StoreFit fit_store(const Comparer& comparer, const setup::Setup& setup, const ComparedRun& before,
                   const Store& store, const std::vector<int>& blocks);

}  // namespace trunnion::choices
