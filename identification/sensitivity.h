// How each reading answers to each parameter.
#pragma once

#include "identification/base_model.h"

namespace trunnion::identification {

/// Derivatives of the device rows of a table, at the setup as it stands.
struct Sensitivity {
    std::vector<FitParameter> parameters;  ///< of the effects, then of the free set-up
    std::vector<int> index;                ///< of each device row, as in the table
    Eigen::MatrixXd jacobian;  ///< d reading / d parameter: mm (angular rows: rad) for one unit of
                               ///< the parameter, by central differences
};

/// Without `effects` those of [model].modelled. Throws InputError on an unknown effect, and as
/// Replay on a row that the setup cannot read.
Sensitivity sensitivity(const setup::Setup& setup, const records::ReadingTable& table,
                        const std::vector<std::string>& effects);

}  // namespace trunnion::identification
