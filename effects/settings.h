// Active effects by name: from a setup file, from --inject, and back into a setup.
#pragma once

#include <string>
#include <vector>

#include "effects/catalogue.h"

namespace trunnion::effects {

/// Parses `C.backlash: gap_rad=6e-5`, `pivot.g54: dg_mm=[0.01, 0, 0]`, `C.cyclic: cos_rad=1e-5,
/// periods_per_turn=72` or, for the first parameter of the effect, `C.backlash=60urad`. The units
/// um mm m urad mrad rad arcsec deg ppm us ms s may follow any number and are converted to the unit
/// of the parameter. Throws InputError for an unknown effect, parameter or unit, and without a
/// value.
setup::EffectSetting parse_injection(const std::string& text, const Catalogue& catalogue);

/// Values of all parameters of an effect. Parameters not named are 0 (keys: their usual value).
/// Throws InputError for a parameter that the effect does not have.
std::vector<double> values_of(const Effect& effect, const setup::EffectSetting& setting);
/// The inverse of values_of, without parameters that are 0.
setup::EffectSetting setting_of(const Effect& effect, const std::vector<double>& values);

/// Throws InputError for an unknown effect name, with its position if [effects] or [model].modelled
/// of the setup file contains it.
[[noreturn]] void refuse_effect_name(const setup::Setup& setup, const std::string& name);

/// Models of all effects that the setup switches on, behind what its control compensates. Throws
/// InputError for an unknown name.
emulator::EffectModels active_models(const setup::Setup& setup);

}  // namespace trunnion::effects
