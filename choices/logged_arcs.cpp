#include "choices/logged_arcs.h"

#include <algorithm>
#include <cmath>

#include "base/units.h"
#include "choices/control_path.h"
#include "motion/motion.h"

namespace trunnion::choices {

namespace {

constexpr double circle_sigmas = 6.0;
constexpr double median_sigma = 1.4826;  ///< sigma for a median of absolute values of 1
constexpr double printed_steps = 2.0;
constexpr double most_closed_mm = 0.05;  ///< (assumed): radii farther apart are meant so
constexpr double same_radius_mm = 0.05;  ///< more than controls allow without an alarm (assumed)

Vector3 xyz(const AxisPositions& q) {
    return {q[Axis::X], q[Axis::Y], q[Axis::Z]};
}

/// Of the radii at end and start, mm.
double radii_apart(const records::LoggedArc& arc, const AxisPositions& from,
                   const AxisPositions& to) {
    const Vector3 n = arc.normal.normalized();
    const auto radius = [&](const AxisPositions& q) {
        return n.cross(xyz(q) - arc.centre_mm).norm();
    };
    return std::abs(radius(to) - radius(from));
}

/// Angle from start to end, in the direction of the arc.
double sweep_of(const records::LoggedArc& arc, const Vector3& from, const Vector3& to,
                double closed_mm) {
    const Vector3 n = arc.normal.normalized(), a = from - arc.centre_mm, b = to - arc.centre_mm;
    double sweep = std::atan2(n.dot(a.cross(b)), a.dot(b) - n.dot(a) * n.dot(b));
    const double way = arc.turns < 0 ? -1.0 : 1.0, radius_mm = n.cross(a).norm();
    if (way * sweep <= std::max(1e-9, radius_mm > 0.0 ? closed_mm / radius_mm : 0.0))
        sweep += way * 2.0 * pi;
    return sweep + way * 2.0 * pi * (std::abs(arc.turns) - 1.0);
}

}  // namespace

LoggedArcs::LoggedArcs(const records::PositionLog& log) {
    std::vector<double> apart_mm;
    double stated_mm = 0.0;
    for (std::size_t i = 1; i < log.rows.size(); ++i) {
        const records::LoggedPosition& row = log.rows[i];
        stated_mm = std::max(stated_mm, row.sigma_mm);
        if (row.arc) apart_mm.push_back(radii_apart(*row.arc, log.rows[i - 1].at, row.at));
    }
    if (apart_mm.empty()) return;
    const auto middle = apart_mm.begin() + static_cast<std::ptrdiff_t>(apart_mm.size() / 2);
    std::nth_element(apart_mm.begin(), middle, apart_mm.end());
    const double noise_mm =
        circle_sigmas * std::max(median_sigma * *middle, std::sqrt(2.0) * stated_mm);
    closed_mm_ = std::min(most_closed_mm, printed_steps * log.step + noise_mm);
}

std::vector<AxisPositions> LoggedArcs::quarters(const records::LoggedPosition* before,
                                                const records::LoggedPosition& row) const {
    const AxisPositions from = before != nullptr ? before->at : AxisPositions{};
    const records::LoggedArc& arc = *row.arc;
    if (before == nullptr && radii_apart(arc, from, row.at) > same_radius_mm) return {};
    const double sweep = sweep_of(arc, xyz(from), xyz(row.at), closed_mm_);
    const motion::ArcPath way{arc.centre_mm, arc.normal.normalized(), arc.turns, sweep};
    std::vector<AxisPositions> out;
    for (int k = 1; k < arc_parts; ++k) {
        const double part = static_cast<double>(k) / arc_parts;
        AxisPositions at;
        for (std::size_t i = 0; i < axis_count; ++i)
            at.value[i] = from.value[i] + part * (row.at.value[i] - from.value[i]);
        const Vector3 p = motion::point_on_arc(way, xyz(from), xyz(row.at), part);
        for (int i = 0; i < 3; ++i) at.value[static_cast<std::size_t>(i)] = p[i];
        out.push_back(at);
    }
    return out;
}

}  // namespace trunnion::choices
