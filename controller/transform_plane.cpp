#include "controller/transform_plane.h"

#include <cmath>

#include "controller/alarms.h"
#include "controller/tilted_plane_codes.h"

namespace trunnion::controller {

namespace {

constexpr double square_enough = 0.01;  ///< maximum cosine of the angle between the directions
constexpr std::uint32_t y_letters =
    SortedWords::bit('U') | SortedWords::bit('V') | SortedWords::bit('W');

Matrix3 by_angles(const SortedWords& words, bool about_moved_axes) {
    const auto turn = [&](char letter, int axis) {
        const double angle_deg = words.has(letter) ? words.angle_deg(letter) : 0.0;
        return rotation_about(Vector3::Unit(axis), rad_from_deg(angle_deg));
    };
    const Matrix3 a = turn('A', 0), b = turn('B', 1), c = turn('C', 2);
    return about_moved_axes ? Matrix3(a * b * c) : Matrix3(c * b * a);
}

Matrix3 by_directions(const SortedWords& words) {
    const Vector3 x = tool_vector(words);
    const Vector3 y(words.get('U', 0.0), words.get('V', 0.0), words.get('W', 0.0));
    const int column = words.column_of_first(y_letters);
    if (y.norm() < 1e-9) raise_alarm(5457, "(U V W is no direction)", column);
    if (std::abs(x.dot(y)) > square_enough * x.norm() * y.norm())
        raise_alarm(5457, "(I J K and U V W are not at right angles)", column);
    Matrix3 out;
    out.col(0) = x.normalized();
    out.col(2) = x.cross(y).normalized();
    out.col(1) = out.col(2).cross(out.col(0));
    return out;
}

Matrix3 rotation_of(const SortedWords& words, bool about_moved_axes) {
    const bool directions = (words.present & (tool_vector_letters | y_letters)) != 0;
    const int column = words.column_of_first(rotary_letters);
    if (directions && column != 0) raise_alarm(5457, "(A B C beside I J K U V W)", column);
    return directions ? by_directions(words) : by_angles(words, about_moved_axes);
}

}  // namespace

void set_transform_plane(const SortedWords& words, Modal& modal, Frames& frames, Mover& mover,
                         int code10) {
    check_plane_may_start(modal, frames);
    const HurcoChoices& choices = modal.settings.hurco;
    if (frames.plane && !choices.planes_stack) raise_alarm(5456);
    const bool moved_axes = (code10 == 683) != choices.g68_2_moved_axes;
    const auto origin = [&](char letter) {
        return words.has(letter) ? words.length_mm(letter) : 0.0;
    };
    const Pose pose{rotation_of(words, moved_axes), {origin('X'), origin('Y'), origin('Z')}};
    TiltedPlaneState plane;
    plane.pose_PF = pose;
    if (frames.plane) {
        plane = *frames.plane;
        plane.below_PF.push_back(plane.pose_PF);
        plane.pose_PF = plane.pose_PF * pose;
    }
    set_plane(plane, modal, frames, mover);
}

}  // namespace trunnion::controller
