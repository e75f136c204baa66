// Effects fitted to readings: values, uncertainties, and what cannot be told apart.
#pragma once

#include "identification/base_model.h"

namespace trunnion::identification {

struct Identification {
    std::vector<FitParameter> parameters;
    std::vector<Inseparable> inseparable;
    double rms_before_um = 0.0;  ///< with the setup as it stands
    double rms_after_um = 0.0;
    int dof = 0;
    /// Of the parameters that are no keys, in their order and units: it comes with the directions
    /// that the readings see (`inseparable` lists the others).
    Eigen::MatrixXd covariance;
    std::vector<std::string> set_up_words;  ///< how a part or instrument lay, in sentences
    std::vector<std::string> notes;
    setup::Setup setup;  ///< with the values entered; loads again
};

/// Fits the named effects (none: those of [model].modelled) and the free set-up quantities to all
/// device rows. Keys of effects (pitch, time constant) are searched. Throws InputError as fit_base.
Identification identify(const setup::Setup& setup, const records::ReadingTable& table,
                        std::vector<std::string> effects);

/// Refines the keys of an effect around `keys` so that it explains most of `left_mm` together with
/// the base columns. Golden-section search, one key after the other.
std::vector<double> refine_keys(const emulator::Replay& replay, const BaseModel& base,
                                const effects::Effect& effect, std::vector<double> keys,
                                const Eigen::VectorXd& left_mm);

/// The best setting of an effect's keys on its grid, then refined.
std::vector<double> search_keys(const emulator::Replay& replay, const BaseModel& base,
                                const effects::Effect& effect, const Eigen::VectorXd& left_mm);

}  // namespace trunnion::identification
