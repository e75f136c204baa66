#include "pivot/pivot_maps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include "base/units.h"

namespace trunnion::pivot {

void name_map(PivotMap& map, Axis first, Axis second) {
    const auto arc = std::find_if(map.arcs.begin(), map.arcs.end(),
                                  [](const PivotArc& a) { return a.points.size() > 1; });
    if (arc == map.arcs.end()) return;
    const PivotPoint& start = arc->points.front();
    map.first_moves = std::any_of(arc->points.begin(), arc->points.end(), [&](const PivotPoint& p) {
        return p.first_deg != start.first_deg;
    });
    map.fixed_deg = map.first_moves ? start.second_deg : start.first_deg;
    map.name = fmt::format("{} arc at {}{:g}", letter_of(map.first_moves ? first : second),
                           letter_of(map.first_moves ? second : first), map.fixed_deg);
}

ErrorCircle fit_circle(const PivotMap& map, const std::vector<PivotPoint>& points,
                       const Vector3& axis_M) {
    // Perpendicular to the axis a rotating error is z = c + v exp(i theta): two complex unknowns.
    using Complex = std::complex<double>;
    const Vector3 a = axis_M.unitOrthogonal(), b = axis_M.cross(a);
    const auto n = static_cast<double>(points.size());
    Complex sum_z, sum_w, sum_wz;
    for (const PivotPoint& p : points) {
        const Complex z(a.dot(p.error_mm), b.dot(p.error_mm));
        const Complex w = std::polar(1.0, rad_from_deg(map.moving_deg(p)));
        sum_z += z;
        sum_w += w;
        sum_wz += std::conj(w) * z;
    }
    const double determinant = n - std::norm(sum_w) / n;
    if (points.size() < 3 || determinant < 1e-9) return {};
    const Complex v = (sum_wz - std::conj(sum_w) * sum_z / n) / determinant;
    const Complex c = (sum_z - v * sum_w) / n;
    return {c.real() * a + c.imag() * b, v.real() * a + v.imag() * b};
}

Vector3 moving_axis_M(const offsets::PivotParameters& pivot, const PivotMap& map) {
    if (map.first_moves) return pivot.first.direction();
    if (pivot.unit == offsets::MechanicalUnit::mixed) return pivot.second.direction();
    return rotation_about(pivot.first.direction(), rad_from_deg(map.fixed_deg)) *
           pivot.second.direction();
}

namespace {

/// DPP and G54.2: both table axes intersect at G54.
offsets::PivotParameters about_g54(const setup::RotaryStores& stores) {
    offsets::PivotParameters pivot = stores.pivot;
    pivot.table_point_mm = stores.g54;
    pivot.table_offset_mm = Vector3::Zero();
    return pivot;
}

Vector3 linear(const AxisPositions& q) {
    return {q[Axis::X], q[Axis::Y], q[Axis::Z]};
}

void add_linear(AxisPositions& q, const Vector3& way) {
    for (int i = 0; i < 3; ++i) q.value[static_cast<std::size_t>(i)] += way[i];
}

}  // namespace

PivotModel::PivotModel(const kinematics::Machine& machine, const setup::RotaryStores& in_force,
                       const Vector3& sphere_mm, const Vector3& tip_S_mm)
    : machine_(machine),
      by_parameters_(in_force.pivot),
      by_g54_(about_g54(in_force)),
      sphere_mm_(sphere_mm),
      tip_S_mm_(tip_S_mm) {
    AxisPositions home;
    add_linear(home, sphere_mm - tip_S_mm);
    sphere_W_mm_ = machine_.tip_W(home, tip_S_mm);
}

Vector3 PivotModel::reached_mm(const AxisPositions& turned) const {
    AxisPositions q = turned;
    add_linear(q, sphere_mm_ - tip_S_mm_);
    // The linear axes are nearly orthogonal: each iteration reduces the remainder by the factor of
    // their errors.
    for (int pass = 0; pass < 8; ++pass) {
        const kinematics::MachinePose pose = machine_.poses(q);
        const Vector3 missing = pose.pose_MW * sphere_W_mm_ - pose.pose_MS * tip_S_mm_;
        add_linear(q, missing);
        if (missing.norm() < 1e-12) break;
    }
    return linear(q);
}

Vector3 PivotModel::commanded_mm(PivotGroup group, const AxisPositions& turned,
                                 const Vector3& sphere_mm) const {
    const positioning::RotaryTransform& by = group == PivotGroup::g54 ? by_g54_ : by_parameters_;
    return linear(by.machine_for_tip(sphere_mm, turned, -tip_S_mm_));
}

Vector3 PivotModel::error_mm(PivotGroup group, double first_deg, double second_deg,
                             const Vector3& zero_mm) const {
    AxisPositions turned;
    turned[by_parameters_.pivot().first.axis] = rad_from_deg(first_deg);
    turned[by_parameters_.pivot().second.axis] = rad_from_deg(second_deg);
    return reached_mm(turned) - commanded_mm(group, turned, sphere_mm_ + zero_mm);
}

}  // namespace trunnion::pivot
