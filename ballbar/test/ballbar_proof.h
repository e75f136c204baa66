// What a ballbar's own second run cannot show: the true tip, and a check by another instrument.
#pragma once

#include "ballbar/test/ballbar_procedure.h"
#include "emulator/compensating_sink.h"

namespace trunnion::ballbar::test {

/// A simulator knows where a tip really is: its largest way from its place at home, over poses
/// every 30 degrees of the tested ranges, effects included, axes coming from the - side.
TrueTip true_tip(const setup::Setup& setup, const BallbarLayout& layout,
                 const emulator::EffectModels& effects, const emulator::Compensation& compensate);

/// The setup's sphere found by its probe in the same poses; nothing without probe or sphere.
std::optional<SphereCheck> check_by_sphere(const setup::Setup& setup, const BallbarLayout& layout,
                                           const emulator::EffectModels& effects,
                                           const emulator::Compensation& compensate);

}  // namespace trunnion::ballbar::test
