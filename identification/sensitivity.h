// Derivatives of each reading with respect to each parameter.
#pragma once

#include "identification/base_model.h"

namespace trunnion::identification {

/// Derivatives of the device rows of a table, at the setup as given.
struct Sensitivity {
    std::vector<FitParameter> parameters;  ///< of the effects, then of the free set-up quantities
    std::vector<int> index;                ///< index of each device row in the table
    Eigen::MatrixXd jacobian;  ///< d reading / d parameter: mm (angular rows: rad) per unit of the
                               ///< parameter, by central differences
};

/// Empty `effects`: those of [model].modelled. Throws InputError for an unknown effect, and like
/// Replay for a row that does not fit the setup.
Sensitivity sensitivity(const setup::Setup& setup, const records::ReadingTable& table,
                        const std::vector<std::string>& effects);

}  // namespace trunnion::identification
