// The base model: simulation fitted to readings. Re-identifies modelled effects and set-up
// quantities; returns the residuals.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "base/finite.h"
#include "effects/catalogue.h"
#include "identification/effect_column.h"
#include "identification/row_noise.h"
#include "identification/set_up.h"

namespace trunnion::identification {

/// One unknown of the fit. Set-up quantities (artefact centres, cup, bar length) have effect
/// "setup".
struct FitParameter {
    std::string effect, name, unit;
    int component = -1;
    double typical = 1.0;  ///< in `unit`
    Finite value;          ///< in `unit`: the correction found, or the total for a location error
    double sigma = 0.0;    ///< of `value`; NaN when it cannot be told apart
    double sigma_monte_carlo = 0.0;  ///< the same by repetition, 0 when that was not asked for
    double prior_value = 0.0;
    double prior_sigma = 0.0;  ///< 0: no prior
    std::optional<kinematics::ErrorName> location = {};
    SetUpQuantity set_up = {};
    bool of_set_up = false;  ///< a free quantity of the set-up, no error of the machine
};

/// Inseparable parameters: a change along `direction` (in their units, largest entry 1) changes no
/// reading.
struct Inseparable {
    std::vector<std::string> names;
    std::vector<double> direction;
};

/// "pivot.p1970x.dd_mm[z]"; set-up quantities without "setup.".
std::string full_name(const FitParameter& parameter);
/// "1 dp_mm[y] - 1 dd_mm[y]": the change that no reading shows.
std::string to_string(const Inseparable& group);

/// A replay with the fitted base, and all data for a linear analysis of its residuals. mm and rad.
struct BaseModel {
    setup::Setup setup;  ///< fitted; loads again and gives the same predictions
    std::vector<FitParameter> parameters;
    std::vector<Inseparable> inseparable;
    emulator::EffectModels models;                   ///< effects active in the setup
    std::vector<kinematics::Perturbation> gradient;  ///< derivatives of each device row with
                                                     ///< respect to a Perturbation
    Eigen::MatrixXd columns;  ///< derivative of each device row (row) by each parameter (column)
                              ///< times its typical size, mm; without directions that the readings
                              ///< do not determine
    Eigen::MatrixXd steps;    ///< times a step along the columns: the step of the parameters, in
                              ///< typical sizes (identification/determined.h)
    Eigen::VectorXd measured_mm, residual_mm, start_residual_mm, sigma_mm;
    bool noise_given = true;
    Eigen::MatrixXd covariance;  ///< of the parameters, in their units; without unobservable
                                 ///< directions
    int rank = 0;
    std::vector<std::string> notes;  ///< large residuals declared as intended
};

/// Fits the base by Levenberg-Marquardt with Huber weights, at most 20 steps, ranked least squares
/// in each (estimation/ranked_least_squares.h). What the readings do not determine stays as
/// declared, the machine before the set-up (identification/determined.h). Throws InputError when a
/// device row has no value, and for implausible residuals (wrong units, frames or setup) unless
/// they are declared as intended by `allow_large` of the setup's model or by a `sigma_mm` of the
/// row; then they are noted.
BaseModel fit_base(const setup::Setup& setup, const records::ReadingTable& table,
                   const emulator::Replay& replay, const effects::Catalogue& catalogue,
                   const std::vector<std::string>& effects);

/// The unknowns of a replay with this setup and these effects, and their derivatives.
struct BaseColumns {
    std::vector<FitParameter> parameters;
    Eigen::MatrixXd columns;  ///< derivative times typical size, mm
};
BaseColumns base_columns(const setup::Setup& setup, const emulator::Replay& replay,
                         const effects::Catalogue& catalogue,
                         const std::vector<std::string>& effects,
                         const std::vector<kinematics::Perturbation>& gradient);

/// Changes a fitted setup by a further step of the base parameters, in units of their typical size.
void shift_base(setup::Setup& setup, const BaseModel& base, const effects::Catalogue& catalogue,
                const Eigen::VectorXd& step);

/// Adds the values of an effect to the setup: location errors to the machine, others to [effects].
void add_effect(setup::Setup& setup, const effects::Effect& effect,
                const std::vector<double>& values);

}  // namespace trunnion::identification
