// Fit of effects to readings: values, uncertainties, inseparable parameters.
#pragma once

#include "identification/base_model.h"

namespace trunnion::identification {

struct Identification {
    std::vector<FitParameter> parameters;
    std::vector<Inseparable> inseparable;
    double rms_before_um = 0.0;  ///< with the setup as given
    double rms_after_um = 0.0;
    int dof = 0;
    /// Covariance of the parameters that are not keys, in their order and units, without the
    /// unobservable directions (listed in `inseparable`).
    Eigen::MatrixXd covariance;
    std::vector<std::string> set_up_words;  ///< pose of a part or instrument, in sentences
    std::vector<std::string> notes;
    setup::Setup setup;  ///< with the fitted values; loads again
};

/// Fits the named effects (empty: those of [model].modelled) and the free set-up quantities to all
/// device rows. Keys of effects (period, time constant) are searched. Throws InputError like
/// fit_base.
Identification identify(const setup::Setup& setup, const records::ReadingTable& table,
                        std::vector<std::string> effects);

/// Refines the keys of an effect, starting from `keys`, so that together with the base columns it
/// explains the most of `left_mm`. Golden-section search, one key after the other.
std::vector<double> refine_keys(const emulator::Replay& replay, const BaseModel& base,
                                const effects::Effect& effect, std::vector<double> keys,
                                const Eigen::VectorXd& left_mm);

/// The best keys of an effect on its grid, then refined.
std::vector<double> search_keys(const emulator::Replay& replay, const BaseModel& base,
                                const effects::Effect& effect, const Eigen::VectorXd& left_mm);

}  // namespace trunnion::identification
