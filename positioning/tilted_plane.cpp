#include "positioning/tilted_plane.h"

#include <cmath>

#include "base/units.h"

namespace trunnion::positioning {

namespace {

constexpr double shortest_mm = 1e-6;  ///< points closer than this count as one point
constexpr double most_off_square_rad = rad_from_deg(5.0);

[[noreturn]] void format_error(char letter, const char* what_is_wrong) {
    throw PlaneFormatError(letter, what_is_wrong);
}

int whole(char letter, double value) {
    if (value != std::floor(value) || std::abs(value) > 999.0)
        format_error(letter, letter == 'P' ? "P is a whole number" : "Q is a whole number");
    return static_cast<int>(value);
}

Vector3 shift_of(const PlaneWords& w) {
    return {w.x.value_or(0), w.y.value_or(0), w.z.value_or(0)};
}

Vector3 point_of(const PlaneWords& w) {
    if (!w.x || !w.y || !w.z) format_error(0, "a point needs X, Y and Z");
    return shift_of(w);
}

Vector3 vector_of(const PlaneWords& w) {
    const Vector3 v(w.i.value_or(0), w.j.value_or(0), w.k.value_or(0));
    if (v.norm() < 1e-9) format_error('I', "I J K is no direction");
    return v.normalized();
}

std::array<double, 3> angles_rad(const PlaneWords& w) {
    if (!w.i && !w.j && !w.k) format_error(0, "I, J and K are missing");
    return {rad_from_deg(w.i.value_or(0)), rad_from_deg(w.j.value_or(0)),
            rad_from_deg(w.k.value_or(0))};
}

Matrix3 about(int axis, double angle_rad) {
    return rotation_about(Vector3::Unit(axis), angle_rad);
}

/// The three digits of Q as axis indices: 0 X, 1 Y, 2 Z.
std::array<int, 3> axis_digits(const PlaneWords& w, int otherwise) {
    const int q = w.q ? whole('Q', *w.q) : otherwise;
    const std::array<int, 3> axis{q / 100 - 1, q / 10 % 10 - 1, q % 10 - 1};
    for (const int index : axis)
        if (index < 0 || index > 2) format_error('Q', "Q has three digits 1 to 3, the axes");
    if (axis[0] == axis[1] || axis[1] == axis[2])
        format_error('Q', "Q names one axis twice in a row");
    return axis;
}

Matrix3 euler_rotation(const PlaneWords& w) {
    const auto axis = axis_digits(w, 313);
    const auto angle = angles_rad(w);
    return about(axis[0], angle[0]) * about(axis[1], angle[1]) * about(axis[2], angle[2]);
}

Matrix3 roll_pitch_yaw_rotation(const PlaneWords& w) {
    const auto axis = axis_digits(w, 123);
    if (axis[0] == axis[2]) format_error('Q', "Q of P1 names each axis once");
    const auto angle = angles_rad(w);
    Matrix3 rotation = Matrix3::Identity();
    for (const int index : axis)
        rotation = about(index, angle[static_cast<std::size_t>(index)]) * rotation;
    return rotation;
}

Matrix3 from_x_and_z(const Vector3& x, const Vector3& z) {
    Matrix3 rotation;
    rotation << x, z.cross(x), z;
    return rotation;
}

Matrix3 projection_rotation(const PlaneWords& w) {
    const auto angle = angles_rad(w);
    const Vector3 a(std::cos(angle[0]), 0, -std::sin(angle[0]));
    const Vector3 b(0, std::cos(angle[1]), std::sin(angle[1]));
    const Vector3 normal = a.cross(b);
    if (normal.norm() < 1e-9) format_error('I', "I and J span no plane");
    const Vector3 z = normal.normalized();
    return from_x_and_z(rotation_about(z, angle[2]) * a, z);
}

Pose turned_about_z(const Pose& frame, const std::optional<double>& r_deg) {
    if (!r_deg || *r_deg == 0.0) return frame;
    return {frame.rotation * about(2, rad_from_deg(*r_deg)), frame.translation_mm};
}

}  // namespace

std::optional<Pose> PlaneDefinition::add(const PlaneWords& words) {
    const int form = words.p ? whole('P', *words.p) : 0;
    if (form_ != 0 && form != form_) format_error('P', "P is not that of the block before");
    switch (form) {
        case 0: return turned_about_z({euler_rotation(words), shift_of(words)}, words.r);
        case 1: return turned_about_z({roll_pitch_yaw_rotation(words), shift_of(words)}, words.r);
        case 4: return turned_about_z({projection_rotation(words), shift_of(words)}, words.r);
        case 2:
        case 3: break;
        default: format_error('P', "P is 0 to 4");
    }
    if (!words.q) format_error(0, "Q is missing");
    const int q = whole('Q', *words.q);
    const int first = form == 2 ? 0 : 1, last = form == 2 ? 3 : 2;
    if (q < first || q > last)
        format_error('Q', form == 2 ? "Q of P2 is 0 to 3" : "Q of P3 is 1 or 2");
    if (block_[static_cast<std::size_t>(q)]) format_error('Q', "this Q was there before");
    form_ = form;
    return form == 2 ? add_point(words, q) : add_vector(words, q);
}

std::optional<Pose> PlaneDefinition::add_point(const PlaneWords& words, int q) {
    if (q > 0) point_of(words);
    block_[static_cast<std::size_t>(q)] = words;
    if (!block_[1] || !block_[2] || !block_[3]) return std::nullopt;
    const Pose frame = from_points();
    reset();
    return frame;
}

std::optional<Pose> PlaneDefinition::add_vector(const PlaneWords& words, int q) {
    vector_of(words);
    block_[static_cast<std::size_t>(q)] = words;
    if (!block_[1] || !block_[2]) return std::nullopt;
    const Pose frame = from_vectors();
    reset();
    return frame;
}

Pose PlaneDefinition::from_points() const {
    const Vector3 origin = point_of(*block_[1]);
    const Vector3 along = point_of(*block_[2]) - origin;
    const Vector3 aside = point_of(*block_[3]) - origin;
    if (along.norm() < shortest_mm || aside.norm() < shortest_mm)
        format_error(0, "two of the three points are one");
    const Vector3 x = along.normalized();
    const Vector3 normal = x.cross(aside);
    if (normal.norm() < shortest_mm) format_error(0, "the three points are on one line");
    Pose frame{from_x_and_z(x, normal.normalized()), origin};
    if (!block_[0]) return frame;
    frame.translation_mm = frame * shift_of(*block_[0]);
    return turned_about_z(frame, block_[0]->r);
}

Pose PlaneDefinition::from_vectors() const {
    const Vector3 x = vector_of(*block_[1]);
    const Vector3 z = vector_of(*block_[2]);
    if (std::abs(std::asin(std::fmin(1.0, std::fmax(-1.0, x.dot(z))))) >= most_off_square_rad)
        format_error(0, "the two vectors are 5 degrees or more off square");
    const Vector3 square = (z - z.dot(x) * x).normalized();
    return turned_about_z({from_x_and_z(x, square), shift_of(*block_[1])}, block_[1]->r);
}

Pose plane_of_tool(const Vector3& tool_direction_P, const Vector3& origin_P_mm, double r_deg,
                   const VerticalAxis& vertical) {
    const Vector3& z = tool_direction_P;
    const Vector3 across = vertical.direction_P.cross(z);
    const double least = std::fmax(1e-9, std::sin(vertical.threshold_rad));
    Vector3 x = across;
    if (across.norm() <= least) {
        const Vector3 reference = std::abs(z.x()) < 0.9 ? Vector3::UnitX() : Vector3::UnitY();
        x = reference - reference.dot(z) * z;
    }
    return turned_about_z({from_x_and_z(x.normalized(), z), origin_P_mm}, r_deg);
}

}  // namespace trunnion::positioning
