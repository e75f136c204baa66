// Verification beyond the bar's own second run: the true tip, and a check by another instrument.
#pragma once

#include "ballbar/test/ballbar_procedure.h"
#include "emulator/compensating_sink.h"

namespace trunnion::ballbar::test {

/// Simulation only: largest displacement of the tip from its position at home, over poses every 30
/// degrees of the tested ranges. Includes effects; axes arrive from the - side.
TrueTip true_tip(const setup::Setup& setup, const BallbarLayout& layout,
                 const emulator::EffectModels& effects, const emulator::Compensation& compensate);

/// The setup's sphere measured by its probe in the same poses; empty without probe or sphere.
std::optional<SphereCheck> check_by_sphere(const setup::Setup& setup, const BallbarLayout& layout,
                                           const emulator::EffectModels& effects,
                                           const emulator::Compensation& compensate);

}  // namespace trunnion::ballbar::test
