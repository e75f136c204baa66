#include "positioning/rotary_transform.h"

#include <cmath>

#include "base/units.h"
#include "positioning/rotation_pair.h"

namespace trunnion::positioning {

RotaryTransform::RotaryTransform(const offsets::PivotParameters& pivot) : pivot_(pivot) {
    first_.u = pivot.first.direction();
    second_.u = pivot.second.direction();
    if (pivot.unit == offsets::MechanicalUnit::tool_tool ||
        pivot.unit == offsets::MechanicalUnit::mixed)
        place_tool_lines();
    if (pivot.unit == offsets::MechanicalUnit::table_table ||
        pivot.unit == offsets::MechanicalUnit::mixed)
        place_table_lines();
}

/// A hypothetical first table axis tilts the second axis by a constant angle; W still coincides
/// with M at zero.
void RotaryTransform::place_table_lines() {
    if (pivot_.unit == offsets::MechanicalUnit::mixed) {
        second_.point_mm = pivot_.table_point_mm;
        return;
    }
    first_.point_mm = pivot_.table_point_mm;
    Vector3 offset_mm = pivot_.table_offset_mm;
    if (pivot_.first.hypothetical) {
        const Matrix3 wedge = rotation_about(first_.u, pivot_.first.hypothetical_rad);
        second_.u = wedge * second_.u;
        offset_mm = wedge * offset_mm;
    }
    second_.point_mm = first_.point_mm + offset_mm;
}

void RotaryTransform::place_tool_lines() {
    first_.point_mm = pivot_.holder_offset_mm * pivot_.tool_direction + pivot_.tool_offset_mm;
    if (pivot_.first.hypothetical) first_fixed_rad_ = pivot_.first.hypothetical_rad;
    if (pivot_.unit == offsets::MechanicalUnit::mixed) return;
    second_.point_mm = first_.point_mm - pivot_.tool_second_offset_mm;
    if (pivot_.second.hypothetical) second_fixed_rad_ = pivot_.second.hypothetical_rad;
}

/// Rodrigues' formula without a matrix: this is the inner loop of G43.4.
inline Vector3 RotaryTransform::turned(const Line& line, const Turn& turn, const Vector3& v) {
    return turn.c * v + turn.s * line.u.cross(v) + ((1.0 - turn.c) * line.u.dot(v)) * line.u;
}

inline Vector3 RotaryTransform::moved(const Line& line, const Turn& turn, const Vector3& p) {
    return line.point_mm + turned(line, turn, p - line.point_mm);
}

inline RotaryTransform::Turn RotaryTransform::turn_of(const AxisPositions& machine,
                                                      const offsets::PivotAxis& axis,
                                                      double fixed_rad) {
    const double angle_rad = axis.hypothetical ? fixed_rad : machine[axis.axis];
    return {std::sin(angle_rad), std::cos(angle_rad)};
}

inline RotaryTransform::Turns RotaryTransform::turns(const AxisPositions& machine) const {
    return {turn_of(machine, pivot_.first, first_fixed_rad_),
            turn_of(machine, pivot_.second, second_fixed_rad_)};
}

inline Vector3 RotaryTransform::from_W(const Turns& q, const Vector3& p_W) const {
    switch (pivot_.unit) {
        case offsets::MechanicalUnit::table_table:
            return moved(first_, q.first, moved(second_, q.second, p_W));
        case offsets::MechanicalUnit::mixed: return moved(second_, q.second, p_W);
        default: return p_W;
    }
}

inline Vector3 RotaryTransform::to_W(const Turns& q, const Vector3& p_M) const {
    switch (pivot_.unit) {
        case offsets::MechanicalUnit::table_table:
            return moved(second_, q.second.inverse(), moved(first_, q.first.inverse(), p_M));
        case offsets::MechanicalUnit::mixed: return moved(second_, q.second.inverse(), p_M);
        default: return p_M;
    }
}

inline Vector3 RotaryTransform::direction_to_W(const Turns& q, const Vector3& v_M) const {
    switch (pivot_.unit) {
        case offsets::MechanicalUnit::table_table:
            return turned(second_, q.second.inverse(), turned(first_, q.first.inverse(), v_M));
        case offsets::MechanicalUnit::mixed: return turned(second_, q.second.inverse(), v_M);
        default: return v_M;
    }
}

/// Position of a point of the spindle frame S relative to (X, Y, Z), along the axes of M.
inline Vector3 RotaryTransform::swing(const Turns& q, const Vector3& p_S) const {
    switch (pivot_.unit) {
        case offsets::MechanicalUnit::tool_tool:
            return moved(first_, q.first, moved(second_, q.second, p_S));
        case offsets::MechanicalUnit::mixed: return moved(first_, q.first, p_S);
        default: return p_S;
    }
}

inline Vector3 RotaryTransform::tool_direction_M(const Turns& q) const {
    switch (pivot_.unit) {
        case offsets::MechanicalUnit::tool_tool:
            return turned(first_, q.first, turned(second_, q.second, pivot_.tool_direction));
        case offsets::MechanicalUnit::mixed: return turned(first_, q.first, pivot_.tool_direction);
        default: return pivot_.tool_direction;
    }
}

Pose RotaryTransform::pose_MW(const AxisPositions& machine) const {
    const Turns q = turns(machine);
    Pose pose;
    pose.translation_mm = from_W(q, Vector3::Zero());
    for (int i = 0; i < 3; ++i)
        pose.rotation.row(i) = direction_to_W(q, Vector3::Unit(i)).transpose();
    return pose;
}

Vector3 RotaryTransform::tip_W(const AxisPositions& machine, const Vector3& tool_vector_mm) const {
    const Turns q = turns(machine);
    return to_W(q, pivot_.parallel.linear(machine) + swing(q, -tool_vector_mm));
}

Vector3 RotaryTransform::tool_direction_W(const AxisPositions& machine) const {
    const Turns q = turns(machine);
    return direction_to_W(q, tool_direction_M(q));
}

AxisPositions RotaryTransform::machine_for_tip(const Vector3& p_W, const AxisPositions& machine,
                                               const Vector3& tool_vector_mm) const {
    const Turns q = turns(machine);
    const Vector3 gauge_mm = from_W(q, p_W) - swing(q, -tool_vector_mm);
    AxisPositions out = machine;
    const Vector3 missing_mm = gauge_mm - pivot_.parallel.linear(machine);
    for (std::size_t i = 0; i < 3; ++i) out.value[i] += missing_mm[static_cast<Eigen::Index>(i)];
    return out;
}

TipDerivative RotaryTransform::derivative(const AxisPositions& machine,
                                          const Vector3& tool_vector_mm) const {
    const Turns q = turns(machine);
    const Vector3 gauge_M = pivot_.parallel.linear(machine);
    const Vector3 tip_M = gauge_M + swing(q, -tool_vector_mm);
    const Vector3 tool_M = tool_direction_M(q);
    const bool tool_first = pivot_.unit != offsets::MechanicalUnit::table_table;
    const bool tool_second = pivot_.unit == offsets::MechanicalUnit::tool_tool;
    const bool carried = pivot_.unit != offsets::MechanicalUnit::mixed;

    const Vector3 u1 = first_.u;
    const Vector3 u2 = carried ? turned(first_, q.first, second_.u) : second_.u;
    const Vector3 point1_M = first_.point_mm + (tool_first ? gauge_M : Vector3::Zero());
    const Vector3 point2_S = carried ? moved(first_, q.first, second_.point_mm) : second_.point_mm;
    const Vector3 point2_M = point2_S + (tool_second ? gauge_M : Vector3::Zero());
    const double sign1 = pivot_.first.hypothetical ? 0.0 : (tool_first ? 1.0 : -1.0);
    const double sign2 = pivot_.second.hypothetical ? 0.0 : (tool_second ? 1.0 : -1.0);

    TipDerivative out;
    for (int i = 0; i < 3; ++i) out.tip.col(i) = direction_to_W(q, Vector3::Unit(i));
    out.tip.col(3) = sign1 * direction_to_W(q, u1.cross(tip_M - point1_M));
    out.tip.col(4) = sign2 * direction_to_W(q, u2.cross(tip_M - point2_M));
    out.direction.col(0) = sign1 * direction_to_W(q, u1.cross(tool_M));
    out.direction.col(1) = sign2 * direction_to_W(q, u2.cross(tool_M));
    return out;
}

RotarySolution RotaryTransform::rotaries(const AxisPositions& machine) const {
    return {pivot_.first.hypothetical ? first_fixed_rad_ : machine[pivot_.first.axis],
            pivot_.second.hypothetical ? second_fixed_rad_ : machine[pivot_.second.axis]};
}

AxisPositions RotaryTransform::with_rotaries(AxisPositions machine,
                                             const RotarySolution& angles) const {
    if (!pivot_.first.hypothetical) machine[pivot_.first.axis] = angles.first_rad;
    if (!pivot_.second.hypothetical) machine[pivot_.second.axis] = angles.second_rad;
    return machine;
}

bool RotaryTransform::first_tilts() const {
    if (pivot_.second.hypothetical) return true;
    return !pivot_.first.hypothetical && first_.u.cross(pivot_.tool_direction).norm() > 1e-9;
}

namespace {

bool same_angle(double a_rad, double b_rad) {
    return std::abs(std::remainder(a_rad - b_rad, 2.0 * pi)) < 1e-9;
}

/// The two directions that the rotations must align, and the sign with which the first angle
/// enters.
struct OrientProblem {
    Vector3 x, y;
    double first_sign;
};

OrientProblem orient_problem(const offsets::PivotParameters& pivot, const Vector3& n_W) {
    const Vector3& t = pivot.tool_direction;
    switch (pivot.unit) {
        case offsets::MechanicalUnit::tool_tool: return {n_W, t, -1.0};  // Rot1(-q1) n = Rot2(q2) t
        case offsets::MechanicalUnit::mixed: return {t, n_W, 1.0};       // Rot1(q1) t = Rot2(q2) n
        default: return {t, n_W, -1.0};                                  // Rot1(-q1) t = Rot2(q2) n
    }
}

}  // namespace

std::vector<RotarySolution> RotaryTransform::orient(const Vector3& n_W,
                                                    const RotarySolution& keep) const {
    const OrientProblem problem = orient_problem(pivot_, n_W);
    const PairSolutions pairs = solve_rotation_pair(first_.u, problem.x, second_.u, problem.y);
    std::vector<RotarySolution> solutions;
    for (int i = 0; i < pairs.count; ++i) {
        const PairSolution& pair = pairs.at[i];
        RotarySolution found = keep;
        if (pair.alpha_rad) found.first_rad = problem.first_sign * *pair.alpha_rad + 0.0;
        if (pair.beta_rad) found.second_rad = *pair.beta_rad + 0.0;
        if (found.first_rad <= -pi) found.first_rad += 2.0 * pi;
        const bool first_fits =
            !pivot_.first.hypothetical || same_angle(found.first_rad, first_fixed_rad_);
        const bool second_fits =
            !pivot_.second.hypothetical || same_angle(found.second_rad, second_fixed_rad_);
        if (first_fits && second_fits) solutions.push_back(found);
    }
    return solutions;
}

}  // namespace trunnion::positioning
