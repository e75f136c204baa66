// Periods of a ripple between which the readings do not decide.
#pragma once

#include "diagnosis/prepare/prepare.h"
#include "diagnosis/search/search.h"

namespace trunnion::diagnosis {

/// A search whose ripples are questioned.
struct RippleSearch {
    const Prepared& prepared;
    const Whitener& whitener;
    Design& design;
    const SearchSetting& setting;
    const Eigen::VectorXd& sigma_mm;  ///< of device rows
};

/// Other periods of the catalogue with which a model is not worse by 3 nats, the prior of the
/// period included, than with that of this ripple. Places off a grid tell aliases apart in
/// principle; if they say little, the likelihood is nearly the same. Neighbours within the
/// resolution (one cycle over the range) are the same period. Takes the better period for the
/// member.
std::vector<double> alike_periods(const RippleSearch& search, Model& model, std::size_t position);

/// The model without ripples of a period that the readings leave open: on fewer than 24 places (as
/// many as they are worth) such a ripple is a rival only, as one on a grid, and the model grows
/// without it; on more it stays, and its group names the other periods.
Model without_open_ripples(const RippleSearch& search, Model model);

}  // namespace trunnion::diagnosis
