// Effects switched on by name: from a setup file, from --inject, and back into a setup.
#pragma once

#include <string>
#include <vector>

#include "effects/catalogue.h"

namespace trunnion::effects {

/// `C.backlash: gap_rad=6e-5`, `pivot.g54: dg_mm=[0.01, 0, 0]`, `C.cyclic: cos_rad=1e-5,
/// periods_per_turn=72` or, for the effect's first parameter, `C.backlash=60urad`. Units um mm m
/// urad mrad rad arcsec deg ppm us ms s may follow any number and are converted to the parameter's.
/// Throws InputError when the effect, a parameter or a unit is not known.
setup::EffectSetting parse_injection(const std::string& text, const Catalogue& catalogue);

/// Values for all parameters of an effect; parameters that are not named are 0 (keys: as usual).
/// Throws InputError for a parameter that the effect does not have.
std::vector<double> values_of(const Effect& effect, const setup::EffectSetting& setting);
/// The other way round, without parameters that are 0.
setup::EffectSetting setting_of(const Effect& effect, const std::vector<double>& values);

/// Throws InputError: no effect has this name; with its place where [effects] or [model].modelled
/// of the setup's file says it.
[[noreturn]] void refuse_effect_name(const setup::Setup& setup, const std::string& name);

/// Models of all effects that the setup switches on, behind what its control compensates. Throws
/// InputError for an unknown name.
emulator::EffectModels active_models(const setup::Setup& setup);

}  // namespace trunnion::effects
