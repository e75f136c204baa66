// The simulation fitted to readings: modelled effects and set-up re-identified, residuals left.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "effects/catalogue.h"
#include "identification/set_up.h"

namespace trunnion::identification {

/// One unknown of the fit. Set-up quantities (artefact centres, cup, bar length) have effect
/// "setup".
struct FitParameter {
    std::string effect, name, unit;
    int component = -1;
    double typical = 1.0;  ///< in `unit`
    double value = 0.0;    ///< in `unit`: the correction found, or the total for a location error
    double sigma = 0.0;    ///< of `value`; NaN when it cannot be told apart
    double sigma_monte_carlo = 0.0;  ///< the same by repetition, 0 when that was not asked for
    double prior_value = 0.0;
    double prior_sigma = 0.0;  ///< 0: no prior
    std::optional<kinematics::ErrorName> location = {};
    SetUpQuantity set_up = {};
};

/// Parameters that cannot be told apart: moving along `direction` (in their units) changes nothing.
struct Inseparable {
    std::vector<std::string> names;
    std::vector<double> direction;
};

/// "pivot.p1970x.dd_mm[z]"; set-up quantities without "setup.".
std::string full_name(const FitParameter& parameter);
/// "1 dp_mm[y] - 1 dd_mm[y]": the change that no reading shows.
std::string to_string(const Inseparable& group);

/// One sigma of each device row, mm, and whether every row had one in the table or in the setup.
struct RowNoise {
    Eigen::VectorXd sigma_mm;
    bool given = true;
};
RowNoise row_noise(const setup::Setup& setup, const records::ReadingTable& table,
                   const emulator::Replay& replay);

/// A replay with the fitted base and all that a linear analysis of what remains needs. mm inside.
struct BaseModel {
    setup::Setup setup;  ///< as fitted: loads again, predicts the same
    std::vector<FitParameter> parameters;
    std::vector<Inseparable> inseparable;
    emulator::EffectModels models;                   ///< of effects that the setup switched on
    std::vector<kinematics::Perturbation> gradient;  ///< of each device row
    Eigen::MatrixXd columns;  ///< d reading / d parameter, for one typical change, mm
    Eigen::VectorXd measured_mm, residual_mm, start_residual_mm, sigma_mm;
    bool noise_given = true;
    Eigen::MatrixXd covariance;  ///< of the parameters, in their units
    int rank = 0;
    std::vector<std::string> notes;  ///< large residuals that were meant
};

/// Throws InputError when a device row has no value, and on residuals that no machine can have
/// (units, frames or the setup of another machine), unless they are meant: by `allow_large` of the
/// setup's model or by a `sigma_mm` of the row itself. Then a note tells them.
BaseModel fit_base(const setup::Setup& setup, const records::ReadingTable& table,
                   const emulator::Replay& replay, const effects::Catalogue& catalogue,
                   const std::vector<std::string>& effects);

/// Derivatives of the device rows by parameter j of an effect whose keys are in `values`, mm for
/// one typical change.
Eigen::VectorXd effect_column(const emulator::Replay& replay,
                              const std::vector<kinematics::Perturbation>& gradient,
                              const effects::Effect& effect, const std::vector<double>& values,
                              std::size_t j);

/// The unknowns that a replay has for this setup and these effects, and their derivatives.
struct BaseColumns {
    std::vector<FitParameter> parameters;
    Eigen::MatrixXd columns;  ///< mm for one typical change
};
BaseColumns base_columns(const setup::Setup& setup, const emulator::Replay& replay,
                         const effects::Catalogue& catalogue,
                         const std::vector<std::string>& effects,
                         const std::vector<kinematics::Perturbation>& gradient);

/// The same for some rows only.
Eigen::VectorXd effect_column(const emulator::Replay& replay,
                              const std::vector<kinematics::Perturbation>& gradient,
                              const effects::Effect& effect, const std::vector<double>& values,
                              std::size_t j, const std::vector<std::size_t>& rows);

/// Moves a fitted setup by a further step of the base parameters, in units of their typical size.
void shift_base(setup::Setup& setup, const BaseModel& base, const effects::Catalogue& catalogue,
                const Eigen::VectorXd& step);

/// The setup with an effect's values added: location errors to the machine, others to [effects].
void add_effect(setup::Setup& setup, const effects::Effect& effect,
                const std::vector<double>& values);

}  // namespace trunnion::identification
