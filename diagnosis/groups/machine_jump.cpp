#include "diagnosis/groups/machine_jump.h"

#include "diagnosis/groups/candidate_groups.h"
#include "identification/identify.h"

namespace trunnion::diagnosis {

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
