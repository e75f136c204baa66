#include "ballbar/test/ballbar_published.h"

#include <cmath>

#include "geometry/fits.h"

namespace trunnion::ballbar::test {
namespace {

/// Measured end of the bar: at the measured length from the commanded cup along the nominal bar.
struct BarPoint {
    Vector3 cup_M_mm, pivot_M_mm;  ///< ideal
    Vector3 direction;             ///< from cup to pivot, unit
    double length_mm = 0.0;        ///< measured

    Vector3 measured_M_mm() const { return cup_M_mm + length_mm * direction; }
};

std::vector<BarPoint> points_of(const kinematics::Machine& nominal, const BallbarLayout& layout,
                                const std::vector<records::Reading>& rows,
                                const BallbarTest& test) {
    std::vector<BarPoint> points;
    for (const BallbarPass& pass : ballbar_passes(rows)) {
        if (!(pass.test == test)) continue;
        for (std::size_t i = pass.begin; i < pass.end; ++i) {
            const kinematics::MachinePose pose = nominal.poses(rows[i].commanded);
            BarPoint point{pose.pose_MS * layout.cup_S_mm, pose.pose_MW * layout.pivot_W_mm, {}, 0};
            point.direction = (point.pivot_M_mm - point.cup_M_mm).normalized();
            point.length_mm = layout.length_mm + rows[i].value_mm.value_or(0.0);
            points.push_back(point);
        }
    }
    return points;
}

/// Location check: tip coordinates from lengths, one sphere through the three circles.
void fit_setup(const kinematics::Machine& nominal, const BallbarLayout& layout,
               const std::vector<records::Reading>& rows, PublishedEvaluation& out) {
    std::vector<Vector3> tips;
    for (const auto kind : {BallbarTestKind::xy, BallbarTestKind::yz, BallbarTestKind::zx})
        for (const BarPoint& p : points_of(nominal, layout, rows, {kind, std::nullopt}))
            tips.push_back(layout.pivot_W_mm - p.length_mm * p.direction);
    const auto sphere = fit_sphere(tips);
    if (!sphere) {
        out.missing.push_back("set-up sphere (xy, yz, zx)");
        return;
    }
    out.pivot_offset_mm = layout.pivot_W_mm - sphere->center_mm;
    out.length_error_mm = sphere->radius_mm - layout.length_mm;
    out.setup_rms_mm = sphere->rms_mm;
}

/// Centre of rotation from the radial test, in the plane through the pivot perpendicular to the
/// axis, and direction of the plane of rotation from the axial test.
bool fit_axis(const kinematics::Machine& nominal, const BallbarLayout& layout,
              const std::vector<records::Reading>& rows, const kinematics::AxisGeometry& axis,
              AxisLine& line) {
    const Vector3 k = axis.direction, u = k.unitOrthogonal(), v = k.cross(u);
    std::vector<Vector2> flat;
    for (const BarPoint& p :
         points_of(nominal, layout, rows, {BallbarTestKind::radial, axis.axis})) {
        const Vector3 measured = p.measured_M_mm();
        flat.emplace_back(u.dot(measured), v.dot(measured));
    }
    std::vector<Vector3> space;
    for (const BarPoint& p :
         points_of(nominal, layout, rows, {BallbarTestKind::axial, axis.axis})) {
        const double along = k.dot(p.measured_M_mm() - p.pivot_M_mm);
        space.push_back(p.pivot_M_mm + along * k);
    }
    const auto circle = fit_circle(flat);
    const auto plane = fit_plane(space);
    if (!circle || !plane) return false;
    line.point_mm =
        circle->center_mm.x() * u + circle->center_mm.y() * v + k.dot(layout.pivot_W_mm) * k;
    line.direction = plane->normal.dot(k) < 0.0 ? Vector3(-plane->normal) : plane->normal;
    return true;
}

/// Motion of the carried body caused by the errors of an axis, all axes at zero.
Pose home_motion(const kinematics::AxisGeometry& axis, const kinematics::AxisErrors& errors) {
    const Vector3 shift(errors.location[0], errors.location[1], errors.location[2]);
    const Vector3 tilt(errors.location[3], errors.location[4], errors.location[5]);
    const Matrix3 e = rotation_of(tilt);
    return {e, axis.point_mm + shift - e * axis.point_mm};
}

kinematics::AxisErrors errors_from(const std::vector<NamedError>& errors) {
    kinematics::GeometricErrors all;
    for (const NamedError& e : errors) all.location(e.name) = e.value;
    return errors.empty() ? kinematics::AxisErrors{} : all.axis[index_of(errors.front().name.axis)];
}

AxisLine operator*(const Pose& pose, const AxisLine& line) {
    return {pose * line.point_mm, pose.rotation * line.direction};
}

}  // namespace

std::pair<Vector3, Vector3> nominal_intersection(const kinematics::AxisGeometry& first,
                                                 const kinematics::AxisGeometry& second) {
    const Vector3 &a = first.direction, &b = second.direction;
    const Vector3 between = second.point_mm - first.point_mm;
    const double cosine = a.dot(b), determinant = 1.0 - cosine * cosine;
    if (determinant < 1e-12) return {first.point_mm, second.point_mm};
    const double s = (between.dot(a) - cosine * between.dot(b)) / determinant;
    const double t = (cosine * between.dot(a) - between.dot(b)) / determinant;
    return {first.point_mm + s * a, second.point_mm + t * b};
}

std::vector<NamedError> errors_of_line(const AxisLine& line,
                                       const kinematics::AxisGeometry& nominal,
                                       const Vector3& point_mm) {
    const Vector3& k = nominal.direction;
    const double along = k.dot(point_mm - line.point_mm) / k.dot(line.direction);
    const Vector3 shift = line.point_mm + along * line.direction - point_mm;
    // The rotation vector perpendicular to k that turns k into the direction of the line.
    const Vector3 cross = k.cross(line.direction);
    const double sine = cross.norm();
    const Vector3 tilt = sine > 0.0
                             ? Vector3(cross * (std::atan2(sine, k.dot(line.direction)) / sine))
                             : Vector3(Vector3::Zero());
    Eigen::Index main = 0;
    k.cwiseAbs().maxCoeff(&main);
    std::vector<NamedError> out;
    for (int i = 0; i < 3; ++i)
        if (i != main) out.push_back({{"XYZ"[i], true, nominal.axis}, shift(i)});
    for (int i = 0; i < 3; ++i)
        if (i != main) out.push_back({{"ABC"[i], true, nominal.axis}, tilt(i)});
    return out;
}

std::pair<AxisLine, AxisLine> axis_lines(const kinematics::Machine& machine) {
    const auto [first, second] = table_axes(machine.chain);
    const Pose one = home_motion(first, machine.errors.axis[index_of(first.axis)]);
    const Pose two = home_motion(second, machine.errors.axis[index_of(second.axis)]);
    return {one * AxisLine{first.point_mm, first.direction},
            one * two * AxisLine{second.point_mm, second.direction}};
}

std::vector<NamedError> chain_errors(const AxisLine& first, const AxisLine& second,
                                     const kinematics::Machine& nominal) {
    const auto [axis_1, axis_2] = table_axes(nominal.chain);
    std::vector<NamedError> out = errors_of_line(first, axis_1, axis_1.point_mm);
    const Pose carried = home_motion(axis_1, errors_from(out)).inverse();
    const auto more = errors_of_line(carried * second, axis_2, axis_2.point_mm);
    out.insert(out.end(), more.begin(), more.end());
    return out;
}

std::vector<NamedError> intersection_errors(const AxisLine& first, const AxisLine& second,
                                            const kinematics::Machine& nominal) {
    const auto [axis_1, axis_2] = table_axes(nominal.chain);
    const auto [point_1, point_2] = nominal_intersection(axis_1, axis_2);
    std::vector<NamedError> out = errors_of_line(first, axis_1, point_1);
    const auto more = errors_of_line(second, axis_2, point_2);
    out.insert(out.end(), more.begin(), more.end());
    return out;
}

PublishedEvaluation evaluate_as_published(const kinematics::Machine& nominal,
                                          const BallbarLayout& layout,
                                          const std::vector<records::Reading>& rows) {
    PublishedEvaluation out;
    const auto [first, second] = table_axes(nominal.chain);
    fit_setup(nominal, layout, rows, out);
    const bool first_ok = fit_axis(nominal, layout, rows, first, out.first);
    const bool second_ok = fit_axis(nominal, layout, rows, second, out.second);
    if (!first_ok) out.missing.push_back(std::string("radial and axial ") + letter_of(first.axis));
    if (!second_ok)
        out.missing.push_back(std::string("radial and axial ") + letter_of(second.axis));
    if (first_ok && second_ok) {
        out.chain = chain_errors(out.first, out.second, nominal);
        out.intersection = intersection_errors(out.first, out.second, nominal);
    }
    return out;
}

}  // namespace trunnion::ballbar::test
