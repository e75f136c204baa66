#include "emulator/follow_move.h"

#include <algorithm>
#include <cmath>

#include "base/units.h"
#include "motion/tool_centre_point.h"

namespace trunnion::emulator {
namespace {

/// True when no axis has components both of the circle and of the motion along its normal.
bool turns_in_plane(const motion::AxisMove& move) {
    const Vector3& n = move.arc->normal;
    const double rise = (xyz_of(move.to) - xyz_of(move.from)).dot(n);
    return std::abs(rise) < records::path_rounding.mm || n.cwiseAbs().maxCoeff() == 1.0;
}

/// Advances each axis through its last two reversal points on the arc. An axis reverses every half
/// circle, so the number of reversals follows from its directions at start and end: the direction
/// just after the start and just before the end, because either may be a reversal point.
void follow_turns(records::TravelHistory& history, const motion::AxisMove& move) {
    constexpr double little = 1e-9;
    const motion::ArcPath& arc = *move.arc;
    const double sense = arc.sweep_rad < 0.0 ? -1.0 : 1.0, sweep_rad = std::abs(arc.sweep_rad);
    const Vector3 at_start = xyz_of(move.from) - arc.centre_mm,
                  at_end = xyz_of(move.to) - arc.centre_mm;
    const Vector3 way_start = sense * arc.normal.cross(at_start),
                  way_end = sense * arc.normal.cross(at_end);
    const double radius_mm = way_end.norm(), little_mm = little * radius_mm;
    for (Eigen::Index i = 0; i < 3; ++i) {
        const double largest_mm =
            radius_mm * std::sqrt(std::max(0.0, 1.0 - arc.normal[i] * arc.normal[i]));
        if (largest_mm <= records::path_rounding.mm) continue;
        const double begins = std::abs(way_start[i]) > little_mm ? way_start[i] : -at_start[i];
        const double ends = std::abs(way_end[i]) > little_mm ? way_end[i] : at_end[i];
        const bool same = begins * ends > 0.0, half = sweep_rad > pi + little;
        const auto axis = static_cast<std::size_t>(i);
        const double turn_mm = std::copysign(largest_mm, ends);
        if ((same && half) || sweep_rad > 2.0 * pi - little)
            history.advance(axis, arc.centre_mm[i] + turn_mm);
        if (!same || half) history.advance(axis, arc.centre_mm[i] - turn_mm);
    }
}

}  // namespace

void follow(records::TravelHistory& history, const motion::AxisMove& move) {
    constexpr double last_step = 1e-3;
    if (!history.placed()) history.place(move.from);
    if (move.arc && turns_in_plane(move)) {
        follow_turns(history, move);
    } else if (move.arc || move.curve) {
        const int steps = move.curve
                              ? 4 * motion::curve_parts(move.from, move.to)
                              : std::max(2, static_cast<int>(16.0 * std::abs(move.arc->turns)));
        const bool hardly_turns = move.curve && steps == 4;  // inner loop of G43.4
        for (int k = 1; k < steps && !hardly_turns; ++k)
            history.advance(move.at(static_cast<double>(k) / steps));
        if (!hardly_turns) history.advance(move.at(1.0 - last_step));
    }
    history.advance(move.to);
}

}  // namespace trunnion::emulator
