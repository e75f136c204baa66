#include "setup/right_stores.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/units.h"
#include "offsets/control_position.h"
#include "positioning/rotary_transform.h"

namespace trunnion::setup {

namespace {

/// The component of `change` perpendicular to an axis line.
Vector3 across(const Vector3& change, const offsets::PivotAxis& axis) {
    const Vector3 u = axis.line.normalized();
    return change - u.dot(change) * u;
}

bool has_table(offsets::MechanicalUnit unit) {
    return unit == offsets::MechanicalUnit::table_table || unit == offsets::MechanicalUnit::mixed;
}

Vector3 holder(const offsets::PivotParameters& pivot) {
    return pivot.holder_offset_mm * pivot.tool_direction;
}

void correct_table(const kinematics::Machine& machine, offsets::PivotParameters& pivot) {
    pivot.table_point_mm +=
        across(known_point_mm(machine, pivot.first.axis) - pivot.table_point_mm, pivot.first);
    const Vector3 step = known_point_mm(machine, pivot.second.axis) - pivot.table_point_mm;
    pivot.table_offset_mm += across(step - pivot.table_offset_mm, pivot.second);
}

void correct_head(const kinematics::Machine& machine, offsets::PivotParameters& pivot) {
    const Vector3 first = known_point_mm(machine, pivot.first.axis) - holder(pivot);
    pivot.tool_offset_mm += across(first - pivot.tool_offset_mm, pivot.first);
}

void correct_second_of_head(const kinematics::Machine& machine, offsets::PivotParameters& pivot) {
    const Vector3 back =
        holder(pivot) + pivot.tool_offset_mm - known_point_mm(machine, pivot.second.axis);
    pivot.tool_second_offset_mm += across(back - pivot.tool_second_offset_mm, pivot.second);
}

void correct_one_table_axis(const kinematics::Machine& machine, offsets::PivotParameters& pivot) {
    pivot.table_point_mm +=
        across(known_point_mm(machine, pivot.second.axis) - pivot.table_point_mm, pivot.second);
}

/// End points of the common perpendicular of the two table axes.
std::pair<Vector3, Vector3> feet(const offsets::PivotParameters& pivot) {
    const Vector3 u = pivot.first.line, v = pivot.second.line, d = pivot.table_offset_mm;
    const double uv = u.dot(v), square = 1.0 - uv * uv;
    const double s = (u.dot(d) - uv * v.dot(d)) / square, t = (uv * u.dot(d) - v.dot(d)) / square;
    return {pivot.table_point_mm + s * u, pivot.table_point_mm + d + t * v};
}

Vector3 right_g54(const RotaryStores& stores) {
    const offsets::PivotParameters& pivot = stores.pivot;
    if (pivot.unit == offsets::MechanicalUnit::table_table) return feet(pivot).second;
    if (pivot.unit != offsets::MechanicalUnit::mixed) return stores.g54;
    return stores.g54 + across(pivot.table_point_mm - stores.g54, pivot.second);
}

kinematics::Machine without_tilts(kinematics::Machine machine) {
    for (kinematics::AxisErrors& axis : machine.errors.axis)
        for (const std::size_t tilt : {3U, 4U, 5U}) axis.location[tilt] = 0.0;
    return machine;
}

}  // namespace

std::optional<RotaryStores> rotary_stores(const kinematics::Chain& chain,
                                          const offsets::Stores& stores) {
    std::vector<Axis> order;
    for (const kinematics::AxisGeometry& axis : chain.axes()) order.push_back(axis.axis);
    const auto pivot = offsets::decode_pivot(stores.parameters, order);
    if (!pivot) return std::nullopt;
    return RotaryStores{
        *pivot, offsets::xyz_of(stores.work.standard[0]) + offsets::xyz_of(stores.work.external)};
}

Vector3 known_point_mm(const kinematics::Machine& machine, Axis axis) {
    const Vector3 gauge = machine.poses({}).pose_MS.translation_mm;
    kinematics::Machine carriers = machine;
    carriers.errors.spindle = {};
    for (auto* side : {&carriers.chain.work, &carriers.chain.tool}) {
        const auto at =
            std::find_if(side->begin(), side->end(), [&](auto& a) { return a.axis == axis; });
        if (at == side->end()) continue;
        const bool work = side == &carriers.chain.work;
        const Vector3 point = at->point_mm;
        side->erase(at + 1, side->end());
        const kinematics::MachinePose pose = carriers.poses({});
        return (work ? pose.pose_MW : pose.pose_MS) * point - gauge;
    }
    return Vector3::Zero();
}

RotaryStores right_stores(const kinematics::Machine& known, const RotaryStores& in_force) {
    const kinematics::Machine machine = without_tilts(known);
    RotaryStores right = in_force;
    offsets::PivotParameters& pivot = right.pivot;
    if (pivot.first.hypothetical || pivot.second.hypothetical) return right;
    switch (pivot.unit) {
        case offsets::MechanicalUnit::table_table: correct_table(machine, pivot); break;
        case offsets::MechanicalUnit::mixed:
            correct_head(machine, pivot);
            correct_one_table_axis(machine, pivot);
            break;
        case offsets::MechanicalUnit::tool_tool:
            correct_head(machine, pivot);
            correct_second_of_head(machine, pivot);
            break;
        default: return right;
    }
    right.g54 = right_g54(right);
    return right;
}

Vector3 step_between_axes_mm(const RotaryStores& stores) {
    if (stores.pivot.unit != offsets::MechanicalUnit::table_table) return Vector3::Zero();
    const auto [first, second] = feet(stores.pivot);
    return second - first;
}

namespace {

/// Parameter number of the first component of each place, 0 for G54.
constexpr int first_parameter[] = {0, 19700, 19703, 19709, 19712};

Vector3& vector_at(RotaryStores& stores, int place) {
    switch (place) {
        case 1: return stores.pivot.table_point_mm;
        case 2: return stores.pivot.table_offset_mm;
        case 3: return stores.pivot.tool_offset_mm;
        case 4: return stores.pivot.tool_second_offset_mm;
        default: return stores.g54;
    }
}

std::vector<int> places_of(offsets::MechanicalUnit unit) {
    switch (unit) {
        case offsets::MechanicalUnit::table_table: return {0, 1, 2};
        case offsets::MechanicalUnit::mixed: return {0, 1, 3};
        case offsets::MechanicalUnit::tool_tool: return {3, 4};
        default: return {};
    }
}

double to_increment(double value_mm, double increment_mm) {
    return std::round(value_mm / increment_mm) * increment_mm + 0.0;
}

}  // namespace

std::vector<StoreNumber> store_numbers(const RotaryStores& stores) {
    std::vector<StoreNumber> numbers;
    RotaryStores copy = stores;
    for (const int place : places_of(stores.pivot.unit))
        for (int i = 0; i < 3; ++i) {
            const int parameter = place == 0 ? 0 : first_parameter[place] + i;
            numbers.push_back(
                {place == 0 ? fmt::format("G54 {}", "XYZ"[i]) : fmt::format("{}", parameter),
                 parameter, i, place, vector_at(copy, place)[i]});
        }
    return numbers;
}

void set_number(RotaryStores& stores, const StoreNumber& number, double value_mm) {
    vector_at(stores, number.place)[number.component] = value_mm;
}

double least_increment_mm(const offsets::Parameters& parameters) {
    const double increment = parameters.bit(1013, 1) ? 1e-4 : 1e-3;
    return parameters.bit(1001, 0) ? mm_from_inch(0.1 * increment) : increment;
}

RotaryStores rounded(const RotaryStores& stores, double increment_mm) {
    RotaryStores out = stores;
    for (const StoreNumber& number : store_numbers(stores))
        set_number(out, number, to_increment(number.value_mm, increment_mm));
    return out;
}

namespace {

/// Every 15 degrees within travel, at most a quarter turn to each side, or one full turn.
std::vector<double> angles_of(const kinematics::Chain& chain, const offsets::PivotAxis& axis,
                              bool round) {
    const kinematics::AxisGeometry* geometry = chain.find(axis.axis);
    std::vector<double> angles;
    for (int deg = round ? 0 : -90; deg <= (round ? 345 : 90); deg += 15) {
        const double angle = rad_from_deg(deg);
        if (geometry && geometry->min && angle < *geometry->min) continue;
        if (geometry && geometry->max && angle > *geometry->max) continue;
        angles.push_back(angle);
    }
    return angles;
}

bool along_tool(const offsets::PivotParameters& pivot, const offsets::PivotAxis& axis) {
    return axis.line.cross(pivot.tool_direction).norm() < 1e-9;
}

/// A position of both rotary axes; `head` false: the tool is not tilted.
struct RotaryPose {
    AxisPositions q;
    bool head = false;
};

std::vector<RotaryPose> rotary_poses(const kinematics::Chain& chain,
                                     const offsets::PivotParameters& pivot) {
    std::vector<RotaryPose> poses;
    for (const double first : angles_of(chain, pivot.first, along_tool(pivot, pivot.first)))
        for (const double second :
             angles_of(chain, pivot.second, along_tool(pivot, pivot.second))) {
            RotaryPose pose;
            pose.q[pivot.first.axis] = first;
            pose.q[pivot.second.axis] = second;
            pose.head = pivot.unit != offsets::MechanicalUnit::table_table && first != 0.0;
            poses.push_back(pose);
        }
    return poses;
}

/// Tip position and tool.
struct Work {
    const kinematics::Machine& machine;
    Vector3 point_W_mm, tip_S_mm;
};

AxisPositions with_xyz(AxisPositions q, const Vector3& xyz) {
    for (int i = 0; i < 3; ++i) q.value[static_cast<std::size_t>(i)] = xyz[i];
    return q;
}

/// Axis positions with the physical tip on the point and the rotary axes at zero.
AxisPositions home_of(const Work& work) {
    const kinematics::MachinePose pose = work.machine.poses({});
    return with_xyz({}, pose.pose_MW * work.point_W_mm - pose.pose_MS * work.tip_S_mm);
}

double tcp_wander_mm(const Work& work, const offsets::PivotParameters& pivot) {
    const positioning::RotaryTransform transform(pivot);
    const AxisPositions home = home_of(work);
    const Vector3 tool = -work.tip_S_mm;
    const Vector3 believed_W = transform.tip_W(home, tool);
    const Vector3 at_home = work.machine.tip_W(home, work.tip_S_mm);
    double worst = 0.0;
    for (const RotaryPose& pose : rotary_poses(work.machine.chain, pivot)) {
        const AxisPositions q = transform.machine_for_tip(believed_W, pose.q, tool);
        worst = std::max(worst, (work.machine.tip_W(q, work.tip_S_mm) - at_home).norm());
    }
    return worst;
}

/// DPP and G54.2 rotate the point on the table about G54; the head is at zero.
double g54_wander_mm(const Work& work, const RotaryStores& stores) {
    if (!has_table(stores.pivot.unit)) return 0.0;
    offsets::PivotParameters turning = stores.pivot;
    turning.table_point_mm = stores.g54;
    turning.table_offset_mm = Vector3::Zero();
    const positioning::RotaryTransform transform(turning);
    const AxisPositions home = home_of(work);
    const Vector3 tool = -work.tip_S_mm;
    const Vector3 believed_W = transform.tip_W(home, tool);
    const Vector3 at_home = work.machine.tip_W(home, work.tip_S_mm);
    double worst = 0.0;
    for (const RotaryPose& pose : rotary_poses(work.machine.chain, turning)) {
        if (pose.head) continue;
        const AxisPositions q = transform.machine_for_tip(believed_W, pose.q, tool);
        worst = std::max(worst, (work.machine.tip_W(q, work.tip_S_mm) - at_home).norm());
    }
    return worst;
}

/// Sets of G54.2 in use. Their offsets are relative to G54, so they change with it.
std::vector<StoreLine> fixture_lines(const offsets::Stores& stores, const Vector3& g54_change_mm,
                                     double increment_mm) {
    std::vector<StoreLine> lines;
    for (std::size_t n = 0; n < stores.fixture.set.size(); ++n) {
        const Vector3 now = offsets::xyz_of(stores.fixture.set[n].offset);
        if (now.isZero(0.0)) continue;
        for (int i = 0; i < 3; ++i) {
            const double exact = now[i] - g54_change_mm[i];
            lines.push_back({{fmt::format("G54.2 P{} {}", n + 1, "XYZ"[i]), 0, i, 0, now[i]},
                             exact,
                             to_increment(exact, increment_mm)});
        }
    }
    return lines;
}

std::vector<StoreLine> lines_of(const StoresToType& stores) {
    std::vector<StoreLine> lines;
    const auto now = store_numbers(stores.in_force), exact = store_numbers(stores.exact),
               typed = store_numbers(stores.typed);
    for (std::size_t i = 0; i < now.size(); ++i)
        lines.push_back({now[i], exact[i].value_mm, typed[i].value_mm});
    return lines;
}

}  // namespace

std::optional<StoresToType> stores_to_type(const Setup& setup, const kinematics::Machine& known,
                                           const Vector3& point_W_mm, const Vector3& tip_S_mm) {
    const auto in_force = rotary_stores(setup.machine.chain, setup.stores);
    if (!in_force || store_numbers(*in_force).empty()) return std::nullopt;
    StoresToType out;
    out.in_force = *in_force;
    out.exact = right_stores(known, *in_force);
    out.increment_mm = least_increment_mm(setup.stores.parameters);
    out.typed = rounded(out.exact, out.increment_mm);
    out.lines = lines_of(out);
    out.fixture = fixture_lines(setup.stores, out.typed.g54 - out.in_force.g54, out.increment_mm);
    const Work work{known, point_W_mm, tip_S_mm};
    out.now_um = um_from_mm(tcp_wander_mm(work, out.in_force.pivot));
    out.tilts_um = um_from_mm(tcp_wander_mm(work, out.exact.pivot));
    const kinematics::Machine straight = without_tilts(known);
    out.rounding_um = um_from_mm(tcp_wander_mm({straight, point_W_mm, tip_S_mm}, out.typed.pivot));
    out.g54_now_um = um_from_mm(g54_wander_mm(work, out.in_force));
    out.g54_left_um = um_from_mm(g54_wander_mm(work, out.typed));
    out.apart_um = um_from_mm(step_between_axes_mm(out.exact).norm());
    return out;
}

}  // namespace trunnion::setup
