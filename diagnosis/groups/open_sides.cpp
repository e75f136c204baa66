#include "diagnosis/groups/open_sides.h"

#include <algorithm>

namespace trunnion::diagnosis {
namespace {

constexpr double promising_squares =
    25.0;  ///< minimum weighted squares explained by an effect: five sigma

std::vector<identification::FoundSide> sides_for(
    Prepared& p, const std::vector<identification::KeyedEffect>& by) {
    return identification::choose_sides_beside(p.base, p.table, by, p.open_sides, p.replay);
}

void take_plus(Prepared& p) {
    for (const std::size_t k : p.open_sides) p.replay.assume_side(k, 1);
}

/// True for effects that are not yet in the model, have no keys, and depend on an unknown side.
bool may_join(const Prepared& p, const effects::Effect& effect,
              const std::vector<identification::KeyedEffect>& taken) {
    if (modelled(p, effect) || has_keys(effect)) return false;
    for (const identification::KeyedEffect& t : taken)
        if (t.effect == &effect) return false;
    const auto model = identification::usual_model(effect, effect.zeros());
    return std::any_of(p.open_sides.begin(), p.open_sides.end(), [&](std::size_t k) {
        return identification::sees_side(p.replay, k, *model);
    });
}

}  // namespace

void take_promising_sides(Prepared& p) {
    std::vector<identification::KeyedEffect> taken;
    double most = 0.0;
    while (!p.open_sides.empty()) {
        const effects::Effect* best = nullptr;
        double promised = most + promising_squares;
        for (const effects::Effect& effect : p.catalogue) {
            if (!may_join(p, effect, taken)) continue;
            auto joined = taken;
            joined.push_back({&effect, effect.zeros(), {}});
            take_plus(p);
            sides_for(p, joined);
            if (const double gain = identification::explained(p.replay, p.base, joined);
                gain > promised)
                promised = gain, best = &effect;
        }
        if (!best) break;
        taken.push_back({best, best->zeros(), {}});
        most = promised;
    }
    take_plus(p);
    sides_for(p, taken);
}

bool retake_sides(Prepared& p, const Design& design, const Model& model) {
    std::vector<identification::KeyedEffect> members;
    for (const std::size_t m : model.members)
        if (const ColumnGroup& group = design.group(m); group.effect && !group.is_change())
            members.push_back(
                {group.effect, group.keys.empty() ? group.effect->zeros() : group.keys, {}});
    if (p.open_sides.empty() || members.empty()) return false;
    std::vector<signed char> before;
    for (const std::size_t k : p.open_sides) before.push_back(p.replay.side(k));
    p.sides = p.base_sides;
    for (identification::FoundSide& found : sides_for(p, members))
        p.sides.push_back(std::move(found));
    bool changed = false;
    for (std::size_t j = 0; j < before.size(); ++j)
        changed = changed || p.replay.side(p.open_sides[j]) != before[j];
    return changed;
}

}  // namespace trunnion::diagnosis
