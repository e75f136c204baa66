#include "diagnosis/measured_places.h"

#include <algorithm>
#include <cmath>

#include "base/units.h"
#include "diagnosis/groups/few_places.h"
#include "diagnosis/prepare/places.h"
#include "estimation/free_form.h"

namespace trunnion::diagnosis {
namespace {

constexpr double on_a_knot = 1e-5;  ///< of the distance to the next one, or of a turn

/// True for the harmonics of an angle sensor whose every place in the turn was read again: readings
/// left out at the same places confirm them there, as they do a value of its own for each place.
bool holds_at_places_of_turn(const Outcome& f, const ColumnGroup& own) {
    if (own.table.motion != effects::EffectKind::positioning) return false;
    std::vector<double> places;
    for (std::size_t i = 0; i < f.prepared.replay.size(); ++i) {
        if (f.prepared.replay.contact(i).device != records::Device::angle) return false;
        const double turns = f.prepared.replay.sample(i).position[own.table.axis.axis] / (2.0 * pi);
        places.push_back(turns - std::floor(turns + on_a_knot));
    }
    std::sort(places.begin(), places.end());
    for (std::size_t k = 0; k < places.size(); ++k) {
        const bool before = k > 0 && places[k] - places[k - 1] < on_a_knot;
        const bool after = k + 1 < places.size() && places[k + 1] - places[k] < on_a_knot;
        if (!before && !after) return false;
    }
    return true;
}

}  // namespace

bool holds_at_places(const Outcome& f, std::size_t group) {
    const ColumnGroup& own = f.design.group(group);
    const auto at = std::find(f.model.members.begin(), f.model.members.end(), group);
    if (own.kind != GroupKind::table || at == f.model.members.end()) return false;
    const auto position = static_cast<std::size_t>(at - f.model.members.begin());
    if (f.judgement.interpolates[position]) return false;
    // Harmonics are written for all angles: those that may be the alias of finer ones are not.
    if (own.table.knots.empty())
        return holds_at_places_of_turn(f, own) &&
               !is_alias_of_finer(f.design, f.prepared, f.model, position);
    const std::vector<bool> sees = sees_moves(f.prepared, own.table.axis.axis);
    for (std::size_t i = 0; i < f.prepared.replay.size(); ++i) {
        const emulator::Contact& contact = f.prepared.replay.contact(i);
        if (!sees[i]) continue;
        if (contact.device != records::Device::linear && contact.device != records::Device::angle &&
            contact.device != records::Device::point)
            return false;
        const double q = f.prepared.replay.sample(i).position[own.table.axis.axis];
        const auto [knot, weight] = estimation::place_between(own.table.knots, q);
        if (std::min(weight, 1.0 - weight) > on_a_knot) return false;
    }
    const auto axis = index_of(own.table.axis.axis);
    const setup::Setup& setup = f.prepared.base.setup;
    if (own.table.play) return setup.gap[axis].at.empty();
    return std::all_of(own.table.directions.begin(), own.table.directions.end(),
                       [&](int direction) {
                           return setup.machine.errors.axis[axis]
                               .motion[static_cast<std::size_t>(direction)]
                               .at.empty();
                       });
}

}  // namespace trunnion::diagnosis
