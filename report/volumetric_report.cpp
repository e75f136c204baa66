#include "report/volumetric_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "geometry/numbers.h"
#include "geometry/units.h"
#include "report/svg.h"

namespace trunnion {
namespace {

std::string axis_column(Axis axis) {
    const char lower = static_cast<char>(letter_of(axis) + ('a' - 'A'));
    return std::string(1, lower) + (is_rotary(axis) ? "_deg" : "_mm");
}

std::string cause_name(const VolumetricMap& map, const VolumetricPoint& point) {
    return map.causes.empty() ? "" : map.causes[point.worst].name;
}

std::string place_text(const VolumetricMap& map, const AxisPositions& q) {
    std::string out;
    for (const Axis axis : map.axes)
        out += fmt::format("{}{}{:.3f}", out.empty() ? "" : " ", letter_of(axis),
                           is_rotary(axis) ? deg_from_rad(q[axis]) : q[axis]);
    return out;
}

/// Points with the rotary axes (and axes beyond X Y Z) nearest to zero, by height Z.
std::map<double, std::vector<const VolumetricPoint*>> slices(const VolumetricMap& map) {
    AxisPositions nearest;
    for (const Axis axis : map.axes) {
        double best = INFINITY;
        for (const VolumetricPoint& p : map.points)
            if (std::abs(p.at[axis]) < std::abs(best)) best = p.at[axis];
        nearest[axis] = best;
    }
    std::map<double, std::vector<const VolumetricPoint*>> out;
    for (const VolumetricPoint& p : map.points) {
        bool here = true;
        for (const Axis axis : map.axes)
            here = here && (index_of(axis) < 3 || p.at[axis] == nearest[axis]);
        if (here) out[p.at[Axis::Z]].push_back(&p);
    }
    return out;
}

std::string picture(const VolumetricMap& map, double z,
                    const std::vector<const VolumetricPoint*>& points, double largest_mm) {
    double low_x = INFINITY, high_x = -INFINITY, low_y = INFINITY, high_y = -INFINITY;
    for (const VolumetricPoint* p : points) {
        low_x = std::min(low_x, p->at[Axis::X]), high_x = std::max(high_x, p->at[Axis::X]);
        low_y = std::min(low_y, p->at[Axis::Y]), high_y = std::max(high_y, p->at[Axis::Y]);
    }
    const double margin = 0.12 * std::max(high_x - low_x, high_y - low_y) + 1.0;
    Svg svg(760, 640);
    Plot plot(svg, {80, 50}, 560, 500, round_range(low_x - margin, high_x + margin),
              round_range(low_y - margin, high_y + margin));
    plot.frame(fmt::format("error of the tool point at Z {:.1f} mm (arrows: X Y, discs: Z)", z),
               "X mm", "Y mm");
    const double scale =
        largest_mm > 0.0 ? 0.9 * margin / largest_mm : 0.0;  // mm drawn per mm of error
    for (const VolumetricPoint* p : points) {
        const Vector3& e = p->error_W_mm;
        const Point2 at = plot.at(p->at[Axis::X], p->at[Axis::Y]);
        svg.circle(at, 2.0 + 12.0 * (largest_mm > 0.0 ? std::abs(e.z()) / largest_mm : 0.0),
                   {plot_colours[e.z() < 0.0 ? 1 : 2], 1.5, "none", ""});
        svg.line(at, plot.at(p->at[Axis::X] + scale * e.x(), p->at[Axis::Y] + scale * e.y()),
                 {plot_colours[0], 2.0, "none", ""});
        svg.text({at.x + 6, at.y - 6}, cause_name(map, *p), 8);
    }
    svg.text(
        {80, 625},
        fmt::format("longest error in the volume {:.2f} um; names: the largest single cause there",
                    um_from_mm(largest_mm)));
    return svg.str();
}

}  // namespace

std::string volumetric_csv(const VolumetricMap& map) {
    std::string out;
    for (const Axis axis : map.axes) out += axis_column(axis) + ',';
    out += "tip_x_mm,tip_y_mm,tip_z_mm,error_x_mm,error_y_mm,error_z_mm,error_mm,cause\n";
    for (const VolumetricPoint& point : map.points) {
        for (const Axis axis : map.axes)
            out += (is_rotary(axis) ? shortest_degrees(point.at[axis]) : shortest(point.at[axis])) +
                   ',';
        for (const double v : point.tip_W_mm) out += shortest(v) + ',';
        for (const double v : point.error_W_mm) out += shortest(v) + ',';
        out += shortest(point.error_W_mm.norm()) + ',' + cause_name(map, point) + '\n';
    }
    return out;
}

std::string volumetric_text(const VolumetricMap& map) {
    const VolumetricPoint& worst = map.points[map.worst];
    std::string out = fmt::format("{} poses: rms {:.2f} um, largest {:.2f} um at {} (mostly {})\n",
                                  map.points.size(), um_from_mm(map.rms_mm),
                                  um_from_mm(worst.error_W_mm.norm()), place_text(map, worst.at),
                                  map.causes.empty() ? "nothing" : cause_name(map, worst));
    if (!map.causes.empty()) out += "cause                rms um  largest um   share\n";
    for (const VolumetricCause& cause : map.causes)
        out +=
            fmt::format("{:18} {:8.2f} {:11.2f} {:6.1f} %\n", cause.name, um_from_mm(cause.rms_mm),
                        um_from_mm(cause.largest_mm), 100.0 * cause.share);
    return out;
}

std::vector<std::pair<std::string, std::string>> volumetric_pictures(const VolumetricMap& map) {
    std::vector<std::pair<std::string, std::string>> files;
    const double largest_mm = map.points[map.worst].error_W_mm.norm();
    for (const auto& [z, points] : slices(map))
        files.emplace_back(fmt::format("volumetric_z{}.svg", files.size() + 1),
                           picture(map, z, points, largest_mm));
    return files;
}

}  // namespace trunnion
