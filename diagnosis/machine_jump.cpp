#include "diagnosis/machine_jump.h"

#include "diagnosis/candidate_groups.h"
#include "identification/identify.h"

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

void add_jumps_instead(Design& design, const Prepared& prepared, const Whitener& whitener,
                       Rests& rests, const Model& model) {
    for (std::size_t k = 0; k < model.members.size(); ++k) {
        const effects::Effect* effect = design.group(model.members[k]).effect;
        if (!effect || effect->kind != effects::EffectKind::thermal_drift) continue;
        const Rests::Rest rest = rests.of(without(model, k));
        for (const effects::Effect& jump : prepared.only_rivals)
            for (auto& keys : rests.keys().best(jump, rest.remainder, 1))
                add_machine_jump(design, prepared, whitener, jump,
                                 identification::refine_keys(prepared.replay, prepared.base, jump,
                                                             std::move(keys), rest.mm));
    }
}

}  // namespace trunnion::diagnosis
