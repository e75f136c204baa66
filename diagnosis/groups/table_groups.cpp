// Errors of any form: free forms of the error motions of every axis.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "base/units.h"
#include "diagnosis/groups/candidate_groups.h"
#include "diagnosis/prepare/places.h"
#include "diagnosis/rules/rules.h"
#include "estimation/free_form.h"

namespace trunnion::diagnosis {
namespace {

using effects::EffectKind;

/// One family of error motions of an axis, and the functions that belong to its textbook form.
struct Family {
    EffectKind motion;
    bool rotary, along, angular;  ///< along: in the axis's own direction, else perpendicular to it
    bool all_angles;              ///< all three directions
    std::size_t knots;            ///< maximum
    Eigen::Index shapes;          ///< maximum for one direction
    int owned;               ///< number of polynomials, or of harmonics of a turn beside a constant
    double log_prior = 0.0;  ///< relative to the others
};

/// The bow of a straightness stays in its table, as in that of the angles: seen through one arm
/// they are the same curve, and one of them must not need a second cause for its bow.
constexpr Family families[] = {
    {EffectKind::positioning, false, true, false, false, 40, 24, 2},
    {EffectKind::straightness, false, false, false, false, 24, 12, 2},
    {EffectKind::angular, false, false, true, true, 16, 8, 2, rules::by_an_arm},
    {EffectKind::backlash, false, true, false, false, 40, 24, 1},
    {EffectKind::positioning, true, true, true, false, 40, 24, 2},
    {EffectKind::backlash, true, true, true, false, 24, 12, 0},
    {EffectKind::radial, true, false, false, false, 24, 12, 3},
    {EffectKind::axial, true, true, false, false, 24, 12, 2},
    {EffectKind::tilt, true, false, true, false, 24, 12, 2}};
constexpr std::size_t most_targets = 128;  ///< of a table with a value for each
constexpr double whole_turn_rad = 5.0;     ///< a wider range counts as a whole turn
constexpr double least_range_mm = 1.0, least_range_rad = 1e-3;
constexpr int last_order = 24;
/// Of an angle sensor, read at many places: interpolation errors stand at multiples of its lines.
constexpr int last_order_of_sensor = 120;
constexpr int last_single_order = 9;  ///< the next ones are periods of R.cyclic
constexpr double soft_orders[] = {4.0, 12.0, 36.0, 108.0};  ///< harmonics decrease beyond these

/// Positions of the axis in readings that see it move; a single one where none does.
std::vector<double> places_of(const Prepared& p, Axis axis) {
    const std::vector<bool> sees = sees_moves(p, axis);
    std::vector<double> places;
    for (std::size_t i = 0; i < p.replay.size(); ++i)
        if (sees[i]) places.push_back(p.replay.sample(i).position[axis]);
    if (places.empty()) places.push_back(p.replay.sample(0).position[axis]);
    return places;
}

std::vector<int> directions_of(const Family& family, const kinematics::AxisGeometry& axis) {
    std::vector<int> directions;
    for (int d = 0; d < 3; ++d)
        if (family.all_angles || (d == effects::main_direction(axis)) == family.along)
            directions.push_back(d + (family.angular ? 3 : 0));
    return directions;
}

/// The same shapes for each direction.
Eigen::MatrixXd for_each_direction(const Eigen::MatrixXd& shape, std::size_t directions) {
    const auto count = static_cast<Eigen::Index>(directions);
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(count * shape.rows(), count * shape.cols());
    for (Eigen::Index k = 0; k < count; ++k)
        all.block(k * shape.rows(), k * shape.cols(), shape.rows(), shape.cols()) = shape;
    return all;
}

/// True where the textbook effect of a rotary axis has a slope: positioning, if the setup limits
/// the travel to less than a turn.
bool has_slope(const Prepared& p, const Family& family, Axis axis) {
    const effects::Effect* effect = effects::find_effect(p.catalogue, family.motion, axis);
    return effect && std::any_of(effect->parameters.begin(), effect->parameters.end(),
                                 [](const auto& q) { return q.name == "slope_rad_per_rad"; });
}

/// First harmonic of a positioning with a slope that belongs to its textbook form. Over less than
/// most of its period a harmonic is a bow, which the textbook form has only with large harmonics
/// that cancel: it stays in the table.
int first_owned(const Family& family, const std::vector<double>& knots, bool sloped) {
    constexpr double most_of_period = 0.75;
    if (!sloped) return 1;
    const double turns = (knots.back() - knots.front()) / (2.0 * pi);
    int n = 1;
    while (n <= family.owned && n * turns < most_of_period) ++n;
    return n;
}

/// The textbook form at the knots: polynomials, or harmonics of part of a turn. A slope that the
/// textbook form lacks stays in the table.
Eigen::MatrixXd owned_at(const Prepared& p, const Family& family, const TableForm& table) {
    const std::vector<double>& knots = table.knots;
    if (!family.rotary) return estimation::polynomials_at(knots, family.owned);
    const bool sloped = has_slope(p, family, table.axis.axis);
    const int powers = sloped ? 2 : 1, first = first_owned(family, knots, sloped);
    Eigen::MatrixXd owned(static_cast<Eigen::Index>(knots.size()),
                          powers + 2 * (family.owned - first + 1));
    owned.leftCols(powers) = estimation::polynomials_at(knots, powers);
    for (std::size_t k = 0; k < knots.size(); ++k)
        for (int n = first; n <= family.owned; ++n) {
            const Eigen::Index at = powers + 2 * (n - first);
            owned(static_cast<Eigen::Index>(k), at) = std::cos(n * knots[k]);
            owned(static_cast<Eigen::Index>(k), at + 1) = std::sin(n * knots[k]);
        }
    return owned;
}

/// A shape of one direction and its share of the free form's prior. What has a component of its own
/// may stand beside other shapes.
struct Shape {
    Eigen::MatrixXd columns;
    double log_prior = 0.0;
    std::string component = {};
};

/// `owned`: the textbook form at the knots. `each`: one of the shapes has a value of its own at
/// each knot, as many as there are: what a truncated one lacks would be taken for a ripple.
std::vector<Shape> shapes_at_knots(const Family& family, const std::vector<double>& knots,
                                   const Eigen::MatrixXd& owned, bool each) {
    std::vector<Shape> shapes;
    const std::vector<double> lengths = estimation::correlation_lengths(knots, each);
    for (const double length : lengths) {
        const bool whole = each && length == lengths.back();
        shapes.push_back({estimation::smooth_shapes(
            knots, length, owned,
            whole ? static_cast<Eigen::Index>(knots.size()) : family.shapes)});
    }
    std::erase_if(shapes, [](const Shape& s) { return s.columns.cols() == 0; });
    for (Shape& s : shapes) s.log_prior = -std::log(static_cast<double>(shapes.size()));
    return shapes;
}

bool is_angle_sensor(const Prepared& p) {
    for (std::size_t i = 0; i < p.replay.size(); ++i)
        if (p.replay.contact(i).device != records::Device::angle) return false;
    return true;
}

/// Harmonics of the table from its first one on, as many as `sizes`, of these relative sizes.
Eigen::MatrixXd harmonics_of(const TableForm& table, const std::vector<double>& sizes) {
    const auto columns = 2 * static_cast<Eigen::Index>(sizes.size());
    Eigen::MatrixXd shape = Eigen::MatrixXd::Zero(2 * table.orders, columns);
    for (Eigen::Index c = 0; c < columns; ++c) shape(c, c) = sizes[static_cast<std::size_t>(c / 2)];
    return shape * std::sqrt(2.0) / shape.norm();
}

/// A single harmonic: poles of a resolver, lobes of a bearing. They share half of the prior. Poles
/// that are uneven have overtones: one order stands beside another, and beside a curve.
std::vector<Shape> single_harmonics(const TableForm& table, int count) {
    std::vector<Shape> shapes;
    for (int n = 0; n < count; ++n)
        shapes.push_back(
            {Eigen::MatrixXd::Identity(2 * table.orders, 2 * table.orders).middleCols(2 * n, 2),
             -std::log(2.0 * count), fmt::format("order {}", table.first_order + n)});
    return shapes;
}

/// All harmonics, decreasing beyond some order; of an angle sensor also the low ones alone, alike:
/// at few places all of them follow noise; or a single one of a low order. Half of the prior for
/// each kind.
std::vector<Shape> shapes_of_turn(const Prepared& p, const TableForm& table) {
    std::vector<Shape> shapes;
    const int last = table.first_order + table.orders - 1;
    for (const double soft : soft_orders) {
        if (soft > soft_orders[1] && soft > last) continue;
        std::vector<double> sizes;
        for (int n = table.first_order; n <= last; ++n)
            sizes.push_back(1.0 / (1.0 + std::pow(n / soft, 2)));
        shapes.push_back({harmonics_of(table, sizes)});
    }
    const int singles = std::min(last_single_order - table.first_order + 1, table.orders);
    if (singles < table.orders && is_angle_sensor(p))
        shapes.push_back(
            {harmonics_of(table, std::vector<double>(static_cast<std::size_t>(singles), 1.0))});
    for (Shape& s : shapes) s.log_prior = -std::log(2.0 * static_cast<double>(shapes.size()));
    for (Shape& single : single_harmonics(table, singles)) shapes.push_back(std::move(single));
    return shapes;
}

/// The places at which readings see the play from both sides, if these are most of them and four at
/// least; where most were visited again, from each side twice: one spoiled reading must not make a
/// play. Two and three places must be seen three times from each side. Elsewhere it
/// cannot be told from positioning, and is that of the nearest such places.
std::vector<double> places_of_play(const Prepared& p, const TableForm& table,
                                   const std::vector<double>& places) {
    std::vector<int> forward(places.size(), 0), back(places.size(), 0);
    const Eigen::VectorXd column = identification::effect_column(
        p.replay, p.base.gradient, {*table.play, table.play->zeros(), 0});
    for (std::size_t i = 0; i < p.replay.size(); ++i) {
        const int travel = p.replay.sample(i).travel[index_of(table.axis.axis)];
        if (travel == 0 || column(static_cast<Eigen::Index>(i)) == 0.0) continue;
        const auto [place, weight] =
            estimation::place_between(places, p.replay.sample(i).position[table.axis.axis]);
        ++(travel > 0 ? forward : back)[static_cast<std::size_t>(place) + (weight > 0.5 ? 1 : 0)];
    }
    const auto seen_from_both = [&](int times) {
        std::vector<double> list;
        for (std::size_t k = 0; k < places.size(); ++k)
            if (std::min(forward[k], back[k]) >= times) list.push_back(places[k]);
        const std::size_t least = times > 2 ? 2 : 4;  // what repeats again and again is no chance
        return list.size() >= least && 2 * list.size() >= places.size() ? list
                                                                        : std::vector<double>{};
    };
    for (const int times : {2, 1, 3})
        if (auto list = seen_from_both(times); !list.empty()) return list;
    return {};
}

/// The targets of a laser or an autocollimator, if they were visited again; else none. Other
/// readings have no targets, and at a place read once an error of its own is noise.
std::vector<double> targets_of(const Prepared& p, const std::vector<double>& places) {
    for (std::size_t i = 0; i < p.replay.size(); ++i)
        if (!reads_targets(p.replay.contact(i).device)) return {};
    std::vector<double> targets = estimation::knots_of(places, most_targets + 1);
    const bool again = places.size() >= 2 * targets.size();
    return again && targets.size() <= most_targets ? targets : std::vector<double>{};
}

/// An error with a value of its own at each target; a play has one where both sides are seen.
bool has_targets(const Prepared& p, const Family& family, const TableForm& table) {
    return family.motion != EffectKind::backlash &&
           table.knots == targets_of(p, places_of(p, table.axis.axis));
}

bool is_whole_turn(const kinematics::AxisGeometry& axis, const std::vector<double>& places) {
    const auto [low, high] = std::minmax_element(places.begin(), places.end());
    return axis.rotary && *high - *low > whole_turn_rad;
}

/// The highest harmonic that positions in equal steps show; above it are aliases of lower ones.
int last_on_grid(const std::vector<double>& places) {
    constexpr double even = 1e-3;
    const std::vector<double> steps = estimation::knots_of(places, 2 * last_order + 2);
    if (steps.size() < 2 || steps.size() > 2 * last_order) return last_order;
    const double step = steps[1] - steps[0];
    for (std::size_t k = 1; k < steps.size(); ++k)
        if (std::abs(steps[k] - steps[k - 1] - step) > even * step) return last_order;
    return std::max(1, static_cast<int>(std::floor(pi / step + even)));
}

/// The highest harmonic that the readings of an angle sensor tell: half as many as the places of
/// its turn, even or not. Readings of other devices are rarer than those, and their tables
/// smoother.
int last_of_sensor(std::vector<double> places) {
    for (double& q : places) q -= 2.0 * pi * std::floor(q / (2.0 * pi) + 1e-9);
    const std::vector<double> turn = estimation::knots_of(places, 2 * last_order_of_sensor + 2);
    return std::min(last_order_of_sensor, (static_cast<int>(turn.size()) - 1) / 2);
}

TableForm form_of(const Prepared& p, const Family& family, const kinematics::AxisGeometry& axis) {
    TableForm table{family.motion, axis, directions_of(family, axis), {}, 0, 0};
    const std::vector<double> places = places_of(p, axis.axis);
    if (is_whole_turn(axis, places)) {
        table.first_order = family.owned + 1;
        const int last = family.shapes >= 24 ? last_order : last_order / 2;
        const bool sensor = family.motion == EffectKind::positioning && is_angle_sensor(p);
        table.orders =
            (sensor ? last_of_sensor(places) : std::min(last, last_on_grid(places))) - family.owned;
    } else {
        table.knots = estimation::knots_of(places, family.knots);
        if (auto targets = targets_of(p, places); !targets.empty())
            table.knots = std::move(targets);
    }
    return table;
}

/// The bow of positions and of angles is a table already; that of other motions is in their
/// textbook form. A play differs between two places.
std::size_t least_knots(const Family& family) {
    if (family.motion == EffectKind::backlash) return 2;
    const bool bow_is_table =
        family.motion == EffectKind::positioning || family.motion == EffectKind::angular;
    return bow_is_table ? 3 : 4;
}

/// The shapes of a free form; of a turn with knots, which has its harmonics beside it, that alone
/// with a value of its own at each.
std::vector<Shape> shapes_of(const Prepared& p, const Family& family, const TableForm& table,
                             const Eigen::MatrixXd& owned) {
    if (table.knots.empty())
        return is_whole_turn(table.axis, places_of(p, table.axis.axis))
                   ? shapes_of_turn(p, table)
                   : single_harmonics(table, table.orders);
    std::vector<Shape> shapes =
        shapes_at_knots(family, table.knots, owned, has_targets(p, family, table));
    if (is_whole_turn(table.axis, table.knots) && !shapes.empty())
        shapes = {{std::move(shapes.back().columns), std::log(0.5)}};
    return shapes;
}

void add_table(Design& design, const Prepared& p, const Whitener& whitener, const Family& family,
               const TableForm& table) {
    const Eigen::MatrixXd owned =
        table.knots.empty() ? Eigen::MatrixXd() : owned_at(p, family, table);
    const std::vector<Shape> shapes = shapes_of(p, family, table, owned);
    if (shapes.empty()) return;
    Eigen::MatrixXd white = table_features(p.replay, p.base.gradient, table);
    whitener.apply(white);
    const Eigen::Index first = design.add_features(white);
    const auto group_of = [&](const Eigen::MatrixXd& shape) {
        ColumnGroup group;
        group.kind = GroupKind::table;
        group.name = effects::effect_name(table.axis.name, family.motion);
        group.table = table;
        group.shape = for_each_direction(shape, table.directions.size());
        for (Eigen::Index k = 0; k < white.cols(); ++k) group.features.push_back(first + k);
        return group;
    };
    for (const Shape& shape : shapes) {
        ColumnGroup group = group_of(shape.columns);
        group.log_prior = rules::table_prior + family.log_prior + shape.log_prior;
        group.component = shape.component;
        design.add(std::move(group));
    }
    if (table.knots.empty()) return;
    ColumnGroup line = group_of(owned);
    line.is_line = true;
    line.component = "line";  // so that it is no other form of the table
    design.hide(design.add(std::move(line)));
}

/// The single harmonics of which part of a turn shows more than one period, and its places two
/// each; of those with less, a slope and a bow are as good.
void add_harmonics_of_part(Design& design, const Prepared& p, const Whitener& whitener,
                           const Family& family, TableForm table) {
    constexpr double least_periods = 1.5;
    const std::vector<double> places = places_of(p, table.axis.axis);
    const auto [low, high] = std::minmax_element(places.begin(), places.end());
    const double turns = (*high - *low) / (2.0 * pi);
    const auto steps = estimation::knots_of(places, 4 * last_single_order).size();
    const int last = std::min({last_single_order, last_on_grid(places),
                               static_cast<int>(static_cast<double>(steps) / (2.0 * turns))});
    table.knots.clear();
    table.first_order =
        std::max(family.owned + 1, static_cast<int>(std::ceil(least_periods / turns)));
    table.orders = last - table.first_order + 1;
    if (table.orders > 0) add_table(design, p, whitener, family, table);
}

void add_family(Design& design, const Prepared& p, const Whitener& whitener, const Family& family,
                const kinematics::AxisGeometry& axis) {
    TableForm table = form_of(p, family, axis);
    if (table.orders <= 0 && table.knots.size() < least_knots(family)) return;
    if (family.motion == EffectKind::backlash) {
        table.play = effects::find_effect(p.catalogue, family.motion, axis.axis);
        if (!table.play) return;
        const std::vector<double> places =
            table.knots.empty() ? estimation::knots_of(places_of(p, axis.axis), family.knots)
                                : table.knots;
        const std::vector<double> both = places_of_play(p, table, places);
        if (both.empty()) return;
        if (!table.knots.empty()) table.knots = both;
    }
    add_table(design, p, whitener, family, table);
    if (!family.rotary || family.motion != EffectKind::positioning) return;
    if (table.orders == 0) {
        add_harmonics_of_part(design, p, whitener, family, std::move(table));
        return;
    }
    table.orders = table.first_order = 0;
    table.knots = targets_of(p, places_of(p, axis.axis));
    if (table.knots.size() >= least_knots(family)) add_table(design, p, whitener, family, table);
}

}  // namespace

void add_table_groups(Design& design, const Prepared& prepared, const Whitener& whitener) {
    for (const kinematics::AxisGeometry& axis : prepared.base.setup.machine.chain.axes()) {
        const std::vector<double> places = places_of(prepared, axis.axis);
        const auto [low, high] = std::minmax_element(places.begin(), places.end());
        if (*high - *low < (axis.rotary ? least_range_rad : least_range_mm)) continue;
        for (const Family& family : families)
            if (family.rotary == axis.rotary) add_family(design, prepared, whitener, family, axis);
    }
}

}  // namespace trunnion::diagnosis
