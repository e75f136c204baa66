#include "diagnosis/prepare/jumps.h"

namespace trunnion::diagnosis {

effects::Catalogue jumps_like_moves(const effects::Catalogue& catalogue) {
    effects::Catalogue jumps;
    for (const effects::Effect& moved : catalogue) {
        if (moved.kind != effects::EffectKind::artefact_moved) continue;
        effects::Effect jump = moved;
        jump.name = machine_jump;
        jump.what = "The spindle side was displaced during the test";
        jump.formula = "tool tip shifted by shift_mm from time_s on";
        jump.add = [](const AxisSample& sample, const emulator::Contact&,
                      std::span<const double> value, kinematics::Perturbation& out) {
            if (sample.time_s < value[4]) return;
            out.tip_shift_mm += Vector3(value[0], value[1], value[2]);
        };
        jumps.push_back(std::move(jump));
    }
    return jumps;
}

}  // namespace trunnion::diagnosis
