#include "diagnosis/groups/few_places.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "base/units.h"
#include "diagnosis/groups/ripples.h"
#include "diagnosis/prepare/places.h"
#include "diagnosis/rules/rules.h"

namespace trunnion::diagnosis {
namespace {

constexpr double even = 0.01;  ///< positions in equal steps are rounded

/// The ways between neighbouring positions of a rotary axis, rad. Over more than a turn the
/// positions of all turns are one circle.
struct Steps {
    double widest_rad = 0.0, mean_rad = 0.0;
    bool are_equal() const { return widest_rad <= (1.0 + even) * mean_rad; }
};
Steps steps_of(const Prepared& prepared, Axis axis) {
    std::set<double> places_rad;
    for (std::size_t i = 0; i < prepared.replay.size(); ++i)
        places_rad.insert(prepared.replay.sample(i).position[axis]);
    if (*places_rad.rbegin() - *places_rad.begin() > 2.0 * pi) {
        std::set<double> circle_rad;
        for (const double q : places_rad)
            circle_rad.insert(q - 2.0 * pi * std::floor(q / (2.0 * pi)));
        circle_rad.insert(*circle_rad.begin() + 2.0 * pi);
        places_rad = std::move(circle_rad);
    }
    constexpr double same_rad = 1e-6;
    Steps steps;
    double before = *places_rad.begin(), count = 0.0;
    for (const double place : places_rad) {
        if (place - before < same_rad) continue;
        steps.widest_rad = std::max(steps.widest_rad, place - before);
        before = place;
        count += 1.0;
    }
    steps.mean_rad = (before - *places_rad.begin()) / std::max(1.0, count);
    return steps;
}

/// True for harmonics of a turn with a wave that has a crest and a trough between two neighbouring
/// positions: what they do there is not read.
bool waves_between_places(const Prepared& prepared, const ColumnGroup& group, Axis axis) {
    int order = 0;
    for (const std::size_t k : group.parameters)
        order = std::max(order, group.effect->parameters[k].order);
    return order > 0 && steps_of(prepared, axis).widest_rad > (1.0 + even) * pi / order;
}

bool shows_no_displacement(const Prepared& p, std::size_t row) {
    return p.replay.contact(row).device == records::Device::angle;
}

struct TwoPlaces {
    double low = HUGE_VAL, high = -HUGE_VAL;  ///< mm
    bool is_high(double q) const { return 2.0 * q > low + high; }
};

/// The two positions of an axis; none where it stands at one, or at three and more.
std::optional<TwoPlaces> two_places(const Prepared& p, Axis axis) {
    constexpr double same_place = 1e-3;  // of the way
    TwoPlaces places;
    for (std::size_t i = 0; i < p.replay.size(); ++i) {
        if (shows_no_displacement(p, i)) continue;
        places.low = std::min(places.low, p.replay.sample(i).position[axis]);
        places.high = std::max(places.high, p.replay.sample(i).position[axis]);
    }
    const double near = same_place * (places.high - places.low);
    if (!(near > 0.0)) return std::nullopt;
    for (std::size_t i = 0; i < p.replay.size(); ++i) {
        const double q = p.replay.sample(i).position[axis];
        if (!shows_no_displacement(p, i) && q - places.low > near && places.high - q > near)
            return std::nullopt;
    }
    return places;
}

}  // namespace

bool is_at_two_places(const Prepared& p, Axis axis) {
    return two_places(p, axis).has_value();
}

bool is_squareness_here(const Prepared& p, const effects::Effect& effect) {
    if (effect.kind != effects::EffectKind::lateral_play) return false;
    const std::optional<TwoPlaces> places = two_places(p, *effect.axis);
    if (!places) return false;
    bool seen[2][2] = {};  // at the low and the high position, travelling to - and to +
    for (std::size_t i = 0; i < p.replay.size(); ++i) {
        const int travel = p.replay.sample(i).travel[index_of(*effect.axis)];
        if (travel != 0 && !shows_no_displacement(p, i))
            seen[places->is_high(p.replay.sample(i).position[*effect.axis])][travel > 0] = true;
    }
    return !(seen[0][0] && seen[0][1]) && !(seen[1][0] && seen[1][1]);
}

bool is_of_resting_axis(const Prepared& p, const effects::Effect& effect) {
    constexpr double same_place = 1e-6;  // mm or rad
    using enum effects::EffectKind;
    if (!effect.axis || effect.kind == zero || range_of(p, *effect.axis).span() >= same_place)
        return false;
    if (effect.kind != backlash && effect.kind != lateral_play) return true;
    const auto side = [&](std::size_t i) {
        return p.replay.sample(i).travel[index_of(*effect.axis)];
    };
    for (std::size_t i = 1; i < p.replay.size(); ++i)
        if (side(i) != side(0)) return false;
    return true;
}

void add_resting(const Prepared& prepared, std::vector<std::string>& unseen) {
    for (const effects::Effect& effect : prepared.catalogue)
        if (!has_keys(effect) && is_of_resting_axis(prepared, effect) &&
            std::find(unseen.begin(), unseen.end(), effect.name) == unseen.end())
            unseen.push_back(effect.name);
}

bool is_side_of_places(const Prepared& p, const effects::Effect& effect) {
    using enum effects::EffectKind;
    constexpr double same_place_mm = 1e-3;
    constexpr int most_changes = 2;
    if ((effect.kind != lateral_play && effect.kind != backlash) ||
        p.table.names.is_rotary(*effect.axis))
        return false;
    std::vector<std::pair<double, int>> sides;  // position, side
    for (std::size_t i = 0; i < p.replay.size(); ++i) {
        const AxisSample& sample = p.replay.sample(i);
        const int side = sample.travel[index_of(*effect.axis)];
        if (side != 0 && !shows_no_displacement(p, i))
            sides.emplace_back(sample.position[*effect.axis], side);
    }
    std::sort(sides.begin(), sides.end());
    int changes = 0;
    for (std::size_t k = 1; k < sides.size(); ++k) {
        if (sides[k].second == sides[k - 1].second) continue;
        if (sides[k].first - sides[k - 1].first < same_place_mm) return false;
        ++changes;
    }
    return changes <= most_changes;
}

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

bool is_alias_of_finer(Design& design, const Prepared& prepared, const Model& model,
                       std::size_t position) {
    constexpr double most_part = 0.2;  // of the squares of a table (assumed)
    const ColumnGroup& group = design.group(model.members[position]);
    const TableForm& table = group.table;
    if (group.kind != GroupKind::table || !table.knots.empty()) return false;
    const Steps steps = steps_of(prepared, table.axis.axis);
    if (!steps.are_equal()) return false;
    const Fit fit = fit_of(design, model);
    const Eigen::VectorXd values =
        group.feature_values(fit.mean.segment(fit.first[position], fit.size[position]));
    double fine = 0.0;
    for (Eigen::Index k = 0; k < values.size(); ++k) {
        const auto harmonic = static_cast<int>(k % table.per_direction()) / 2;
        if (3.0 * (table.first_order + harmonic) * steps.mean_rad > 2.0 * pi * (1.0 + even))
            fine += values(k) * values(k);
    }
    return fine > most_part * values.squaredNorm();
}

}  // namespace trunnion::diagnosis
