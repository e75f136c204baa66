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

/// True where all that sees an axis reads it at targets, not on its way.
bool is_read_at_targets(const Prepared& p, Axis axis) {
    const std::vector<bool> sees = sees_moves(p, axis);
    for (std::size_t i = 0; i < p.replay.size(); ++i) {
        const records::Device device = p.replay.contact(i).device;
        if (sees[i] && device != records::Device::linear && device != records::Device::point &&
            device != records::Device::angle)
            return false;
    }
    return true;
}

/// True where the curve of the positioning of an axis is needed between the places: the setup has
/// one, or a table that holds between them explains more than the ripple `position`.
bool needs_curve(const Outcome& f, const kinematics::AxisGeometry& axis, std::size_t position) {
    const auto along =
        static_cast<std::size_t>(effects::main_direction(axis) + (axis.rotary ? 3 : 0));
    const auto& errors = f.prepared.base.setup.machine.errors.axis[index_of(axis.axis)];
    if (!errors.motion[along].at.empty()) return true;
    const Eigen::MatrixXd parts = contributions(f.design, f.model, fit_of(f.design, f.model));
    const auto square = [&](std::size_t k) {
        return parts.col(static_cast<Eigen::Index>(k)).squaredNorm();
    };
    for (std::size_t k = 0; k < f.model.members.size(); ++k) {
        const ColumnGroup& other = f.design.group(f.model.members[k]);
        if (other.kind == GroupKind::table && !other.table.play &&
            other.table.motion == effects::EffectKind::positioning &&
            other.table.axis.axis == axis.axis && f.judgement.interpolates[k] &&
            square(k) > square(position))
            return true;
    }
    return false;
}

}  // namespace

bool is_ripple_of_places(const Outcome& f, std::size_t group) {
    const ColumnGroup& own = f.design.group(group);
    const auto at = std::find(f.model.members.begin(), f.model.members.end(), group);
    if (own.kind != GroupKind::periodic || own.is_change() || at == f.model.members.end() ||
        own.effect->kind != effects::EffectKind::cyclic)
        return false;
    const auto position = static_cast<std::size_t>(at - f.model.members.begin());
    const kinematics::AxisGeometry& axis =
        *f.prepared.base.setup.machine.chain.find(*own.effect->axis);
    return !f.judgement.equal_periods[position].empty() &&
           std::abs(axis.direction(effects::main_direction(axis))) > 1.0 - 1e-12 &&
           !needs_curve(f, axis, position) && is_read_at_targets(f.prepared, axis.axis);
}

bool holds_at_places(const Outcome& f, std::size_t group) {
    if (is_ripple_of_places(f, group)) return true;
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
