#include "diagnosis/few_places.h"

#include <algorithm>
#include <set>

#include "base/units.h"
#include "diagnosis/ripples.h"
#include "diagnosis/rules.h"

namespace trunnion::diagnosis {
namespace {

/// The widest way between two neighbouring positions of an axis, rad or mm.
double widest_step(const Prepared& prepared, Axis axis) {
    std::set<double> places;
    for (std::size_t i = 0; i < prepared.replay.size(); ++i)
        places.insert(prepared.replay.sample(i).position[axis]);
    double widest = 0.0, before = *places.begin();
    for (const double place : places) {
        widest = std::max(widest, place - before);
        before = place;
    }
    return widest;
}

/// True for harmonics of a turn with a wave that has a crest and a trough between two neighbouring
/// positions: what they do there is not read.
bool waves_between_places(const Prepared& prepared, const ColumnGroup& group, Axis axis) {
    int order = 0;
    for (const std::size_t k : group.parameters)
        order = std::max(order, group.effect->parameters[k].order);
    constexpr double even = 1.01;  // positions in equal steps are rounded
    return order > 0 && widest_step(prepared, axis) > even * pi / order;
}

}  // namespace

bool bends_at_few_places(const Design& design, const Prepared& prepared, const Model& model,
                         std::size_t position) {
    const ColumnGroup& group = design.group(model.members[position]);
    if (group.kind != GroupKind::textbook || !group.effect->axis) return false;
    const Axis axis = *group.effect->axis;
    if (prepared.table.names.is_rotary(axis)) return waves_between_places(prepared, group, axis);
    const auto bends = [&](std::size_t m) {
        const ColumnGroup& table = design.group(m);
        return table.kind == GroupKind::table && table.table.axis.axis == axis;
    };
    return place_count(prepared, axis) < rules::bend_places &&
           (group.columns() > 1 || group.effect->kind == effects::EffectKind::straightness ||
            std::any_of(model.members.begin(), model.members.end(), bends));
}

}  // namespace trunnion::diagnosis
