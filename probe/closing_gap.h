// First contact of a moving point with a surface; one search for spheres and solids.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "geometry/pose.h"

namespace trunnion::probe {

namespace closing_gap {

constexpr double root_mm = 1e-10;          ///< well below the specified 1e-9 mm
constexpr double shortest_step_mm = 2e-4;  ///< a contact that fits inside such a step is less than
                                           ///< 1e-6 mm deep

/// Maximum of |d way / ds| in mm over the samples, with a margin for the points between them.
template <class Way>
double speed_bound(const Way& way) {
    constexpr int samples = 32;
    double most = 0.0;
    auto last = way(0.0);
    for (int i = 1; i <= samples; ++i) {
        const auto next = way(static_cast<double>(i) / samples);
        most = std::max(most, (next - last).norm() * samples);
        last = next;
    }
    return 1.5 * most;
}

/// An interval with a zero of a decreasing function: its value is positive at a, not at b.
struct Bracket {
    double a, gap_a, b, gap_b;
};

/// Root of a decreasing function by the Illinois method, to `width`.
template <class Gap>
double root(const Gap& gap, const Bracket& bracket, double width) {
    auto [a, gap_a, b, gap_b] = bracket;
    int side = 0;
    for (int i = 0; i < 200 && b - a > width; ++i) {
        double s = (a * gap_b - b * gap_a) / (gap_b - gap_a);
        if (!(s > a && s < b)) s = 0.5 * (a + b);
        const double g = gap(s);
        if (std::abs(g) < root_mm / 10) return s;
        if (g > 0.0) {
            a = s, gap_a = g;
            if (side == 1) gap_b *= 0.5;
            side = 1;
        } else {
            b = s, gap_b = g;
            if (side == -1) gap_a *= 0.5;
            side = -1;
        }
    }
    return b;
}

}  // namespace closing_gap

/// The first s in [0, 1] at which `clearance_mm(way(s))` is zero, accurate to 1e-9 mm of path; 0
/// when it is not positive at the start; empty when it remains positive. `way` returns a point in
/// mm, or several below one another. `clearance_mm` must change by no more than the point moves
/// (true for a distance minus a radius), or all of them together. Contacts less than 1e-6 mm deep
/// may be missed.
template <class Way, class Clearance>
std::optional<double> first_closing(const Way& way, const Clearance& clearance_mm) {
    const auto gap = [&](double s) { return clearance_mm(way(s)); };
    double s = 0.0, g = gap(s);
    if (g <= 0.0) return 0.0;
    const double speed_mm = closing_gap::speed_bound(way);
    if (speed_mm == 0.0) return std::nullopt;
    while (s < 1.0) {  // the clearance cannot close faster than the point moves
        const double next =
            std::min(1.0, s + std::max(g, closing_gap::shortest_step_mm) / speed_mm);
        const double g_next = gap(next);
        if (g_next <= 0.0)
            return closing_gap::root(gap, {s, g, next, g_next}, closing_gap::root_mm / speed_mm);
        s = next, g = g_next;
    }
    return std::nullopt;
}

}  // namespace trunnion::probe
