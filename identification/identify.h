// Fit of effects to readings: values, uncertainties, inseparable parameters.
#pragma once

#include <functional>

#include "base/finite.h"
#include "identification/base_model.h"
#include "identification/key_gain.h"

namespace trunnion::identification {

struct Identification {
    std::vector<FitParameter> parameters;
    std::vector<Inseparable> inseparable;
    bool angles = false;   ///< all readings are angles: what is named _um is µrad
    Finite rms_before_um;  ///< with the setup as it stands
    Finite rms_after_um;
    int dof = 0;
    /// Covariance of the parameters that are not keys, in their order and units, without the
    /// unobservable directions (listed in `inseparable`).
    Eigen::MatrixXd covariance;
    std::vector<std::string> set_up_words;  ///< pose of a part or instrument, in sentences
    std::vector<std::string> notes;
    /// Keyed effects whose keys keep their usual values because the fit was ended.
    std::vector<std::string> not_searched;
    setup::Setup setup;  ///< with the values entered; loads again
};

/// Fits the named effects (none: those of [model].modelled) and the free set-up quantities to all
/// device rows. Keys of effects (pitch, time constant) are searched, each as long as `go_on`
/// (empty: always) says true; the values are fitted at the keys found until then. Uncertainties are
/// those of the noise of the readings; where nothing states it they follow the residual, if that is
/// larger, and a residual of twice the noise gets a note. Throws InputError
/// as fit_base.
Identification identify(const setup::Setup& setup, const records::ReadingTable& table,
                        std::vector<std::string> effects, const std::function<bool()>& go_on = {});

/// Refines the keys of an effect, starting from `keys`, so that it explains the most.
/// Golden-section search, one key after the other.
std::vector<double> refine_keys(const KeyGain& gain, const effects::Effect& effect,
                                std::vector<double> keys);
/// ... of `left_mm`, together with the base columns.
std::vector<double> refine_keys(const emulator::Replay& replay, const BaseModel& base,
                                const effects::Effect& effect, std::vector<double> keys,
                                const Eigen::VectorXd& left_mm);

/// The best keys of an effect on its grid, then refined.
std::vector<double> search_keys(const emulator::Replay& replay, const BaseModel& base,
                                const effects::Effect& effect, const Eigen::VectorXd& left_mm);

}  // namespace trunnion::identification
