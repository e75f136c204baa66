#include "motion/path_rates.h"

#include <algorithm>
#include <cmath>

#include "motion/tool_centre_point.h"

namespace trunnion::motion {

namespace {

using PerAxis = std::array<double, axis_count>;

/// Maximum of |rate| * weight over the axes.
double largest(const AxisPositions& rate, const PerAxis& weight) {
    double worst = 0.0;
    for (std::size_t i = 0; i < axis_count; ++i)
        worst = std::max(worst, std::abs(rate.value[i]) * weight[i]);
    return worst;
}

AxisPositions difference(const AxisPositions& a, const AxisPositions& b, double scale) {
    AxisPositions out;
    for (std::size_t i = 0; i < axis_count; ++i) out.value[i] = scale * (b.value[i] - a.value[i]);
    return out;
}

void set_xyz(AxisPositions& q, const Vector3& v) {
    for (std::size_t i = 0; i < 3; ++i) q.value[i] = v[static_cast<Eigen::Index>(i)];
}

void limit(PathRates& out, const AxisPositions& rate, const AxisPositions& bend,
           const AxisLimits& limits) {
    out.least_s = std::max(out.least_s, largest(rate, limits.seconds_per_unit));
    out.least_bend_s =
        std::max(out.least_bend_s, std::sqrt(largest(bend, limits.per_acceleration)));
    out.least_acceleration =
        std::max(out.least_acceleration, largest(rate, limits.per_acceleration));
}

PathRates rates_of_line(const AxisMove& m, const AxisLimits& limits) {
    PathRates out;
    out.start = out.end = difference(m.from, m.to, 1.0);
    out.least_s = largest(out.start, limits.seconds_per_unit);
    out.least_acceleration = largest(out.start, limits.per_acceleration);
    return out;
}

/// On a full circle every axis reaches its maximum share of the path speed once.
PathRates rates_of_arc(const AxisMove& m, const AxisLimits& limits) {
    const ArcPath& arc = *m.arc;
    const auto xyz = [](const AxisPositions& q) {
        return Vector3(q.value[0], q.value[1], q.value[2]);
    };
    const Vector3 from = xyz(m.from) - arc.centre_mm, to = xyz(m.to) - arc.centre_mm;
    const Vector3 turn = arc.sweep_rad * arc.normal;
    const Vector3 rise = arc.normal * arc.normal.dot(to - from);
    PathRates out;
    out.start = out.end = difference(m.from, m.to, 1.0);
    AxisPositions rate = out.start, bend;
    set_xyz(out.start, turn.cross(from) + rise);
    set_xyz(out.end, turn.cross(to) + rise);
    const double bow = from.cross(turn).norm();
    for (std::size_t i = 0; i < 3; ++i) {
        const double n = arc.normal[static_cast<Eigen::Index>(i)];
        const double share = std::sqrt(std::max(0.0, 1.0 - n * n));
        rate.value[i] = bow * share + std::abs(rise[static_cast<Eigen::Index>(i)]);
        bend.value[i] = bow * std::abs(arc.sweep_rad) * share;
    }
    limit(out, rate, bend, limits);
    return out;
}

/// A curve with little rotation is treated as its chord: this is the inner loop of G43.4.
PathRates rates_of_curve(const AxisMove& m, const AxisLimits& limits) {
    constexpr double step = 1e-4;  // step of s for the tangents at the ends
    const int parts = curve_parts(m.from, m.to);
    if (parts == 1) return rates_of_line(m, limits);
    PathRates out;
    if (limits.accelerates) {
        out.start = difference(m.from, m.curve->at(step), 1.0 / step);
        out.end = difference(m.curve->at(1.0 - step), m.to, 1.0 / step);
    }
    AxisPositions at = m.from, rate;
    for (int k = 1; k <= parts; ++k) {
        const AxisPositions next = k == parts ? m.to : m.curve->at(static_cast<double>(k) / parts);
        const AxisPositions run = difference(at, next, parts);
        limit(out, run, k == 1 ? AxisPositions{} : difference(rate, run, parts), limits);
        at = next;
        rate = run;
    }
    return out;
}

}  // namespace

PathRates path_rates(const AxisMove& move, const AxisLimits& limits) {
    if (move.curve) return rates_of_curve(move, limits);
    return move.arc ? rates_of_arc(move, limits) : rates_of_line(move, limits);
}

}  // namespace trunnion::motion
