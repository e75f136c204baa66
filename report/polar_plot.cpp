#include "report/polar_plot.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "base/units.h"
#include "geometry/pose.h"
#include "report/svg.h"

namespace trunnion::report {

namespace {

constexpr double width_px = 980, height_px = 720, middle_x_px = 340, middle_y_px = 365;
constexpr double nominal_px = 150, division_px = 24;
constexpr int divisions = 4;  ///< on each side of the nominal circle
constexpr double edge_px = nominal_px + divisions * division_px;
constexpr double ring_px = 12;  ///< distance of the rings outside the edge that mark the starts
constexpr double panel_x_px = 685, panel_right_px = 962, line_px = 19;
constexpr double smallest_division_um = 0.5;
constexpr std::size_t points_drawn = 1440;
const SvgStyle fitted_style{"#222", 1.4, "none", "3 6"};

Point2 at(double angle_rad, double radius_px) {
    return {middle_x_px + radius_px * std::cos(angle_rad),
            middle_y_px - radius_px * std::sin(angle_rad)};
}

/// The first direction is drawn wide, the second narrow on top, so that both are visible where they
/// coincide.
SvgStyle trace_style(std::size_t k) {
    return {plot_colours[k % plot_colours.size()], k % 2 == 0 ? 2.8 : 1.2, "none", ""};
}

void draw_grid(Svg& svg, const PolarPlot& plot) {
    for (int k = -divisions; k <= divisions; ++k)
        svg.circle(at(0, 0), nominal_px + k * division_px,
                   {k == 0 ? "#666" : "#d8d8d8", k == 0 ? 1.4 : 1.0, "none", ""});
    for (int i = 0; i < 8; ++i)
        svg.line(at(0.25 * pi * i, i % 2 == 0 ? 0.0 : nominal_px - divisions * division_px),
                 at(0.25 * pi * i, edge_px), {i % 2 == 0 ? "#bbb" : "#e6e6e6", 1, "none", ""});
    const double label_px = edge_px + 3 * ring_px;
    const Point2 down(at(-0.5 * pi, label_px + 8)), right(at(0, label_px)), left(at(pi, label_px));
    svg.text({right.x, right.y + 4}, plot.right, 14);
    svg.text(at(0.5 * pi, label_px), plot.top, {14, "middle"});
    svg.text({left.x, left.y + 4}, plot.left, {14, "end"});
    svg.text(down, plot.bottom, {14, "middle"});
}

/// Scale of the circles, below the right half of the plot.
void draw_ruler(Svg& svg, double division_um) {
    const double y = middle_y_px + edge_px + 4 * ring_px + 12;
    const auto x = [](int k) { return middle_x_px + nominal_px + k * division_px; };
    svg.line({x(-divisions), y}, {x(divisions), y}, {"#666", 1, "none", ""});
    for (int k = -divisions; k <= divisions; ++k) {
        svg.line({x(k), y}, {x(k), y + (k % 2 == 0 ? 6.0 : 3.0)}, {"#666", 1, "none", ""});
        if (k % 2 == 0)
            svg.text({x(k), y + 19}, k == 0 ? "0" : fmt::format("{:+g}", k * division_um),
                     {11, "middle", "#444"});
    }
    svg.text({x(-divisions) - 10, y + 4}, "deviation from the nominal circle, µm",
             {11, "end", "#444"});
}

void draw_trace(Svg& svg, const PolarTrace& trace, double px_per_um, const SvgStyle& style) {
    std::vector<Point2> points;
    const std::size_t count = trace.angle_rad.size(),
                      step = std::max<std::size_t>(1, count / points_drawn);
    for (std::size_t i = 0; i < count; i += step)
        points.push_back(at(trace.angle_rad[i], nominal_px + px_per_um * trace.radial_um[i]));
    svg.polyline(points, style);
}

std::vector<Point2> arc_points(double from_rad, double to_rad, double radius_px) {
    std::vector<Point2> points;
    for (int i = 0; i <= 24; ++i)
        points.push_back(at(from_rad + (to_rad - from_rad) * i / 24.0, radius_px));
    return points;
}

/// Outside the grid: the feed-in as an arc ending with an arrow at the first reading, and a bar at
/// the last one.
void draw_start(Svg& svg, const PolarTrace& trace, std::size_t k) {
    if (trace.feed_in_rad <= 0.0 || trace.angle_rad.size() < 2) return;
    const double radius = edge_px + ring_px * (1.0 + static_cast<double>(k));
    const double start = trace.angle_rad.front(), end = trace.angle_rad.back();
    const double way = end > start ? 1.0 : -1.0, tip = 11.0 / radius;
    const std::string colour = trace_style(k).stroke;
    svg.polyline(arc_points(start - way * trace.feed_in_rad, start, radius),
                 {colour, 2.2, "none", ""});
    svg.polyline({at(start, radius - 5), at(start + way * tip, radius), at(start, radius + 5)},
                 {colour, 0.5, colour, ""});
    svg.line(at(end, radius - 5), at(end, radius + 5), {colour, 2.2, "none", ""});
}

/// The magnified eccentric circle over the measured arc.
void draw_fitted(Svg& svg, const PolarPlot& plot, double px_per_um) {
    if (plot.fitted_um.size() != 3 || plot.traces.empty()) return;
    const auto& angles = plot.traces.front().angle_rad;
    const auto [low, high] = std::minmax_element(angles.begin(), angles.end());
    std::vector<Point2> points;
    for (int i = 0; i <= 180; ++i) {
        const double a = *low + (*high - *low) * i / 180.0;
        const double um =
            plot.fitted_um[0] + plot.fitted_um[1] * std::cos(a) + plot.fitted_um[2] * std::sin(a);
        points.push_back(at(a, nominal_px + px_per_um * um));
    }
    svg.polyline(points, fitted_style);
}

/// Scale, legend and lists, from the top.
void draw_panel(Svg& svg, const PolarPlot& plot, double division_um) {
    double y = 84;
    svg.text({panel_x_px, y}, fmt::format("{:g} µm/div", division_um), 20);
    svg.line({panel_x_px + 150, y - 6}, {panel_x_px + 150 + division_px, y - 6},
             {"#222", 2, "none", ""});
    for (const double x : {0.0, division_px})
        svg.line({panel_x_px + 150 + x, y - 11}, {panel_x_px + 150 + x, y - 1},
                 {"#222", 2, "none", ""});
    y += 12;
    const auto entry = [&](const std::string& name, const SvgStyle& style) {
        y += line_px;
        svg.line({panel_x_px, y - 4}, {panel_x_px + 30, y - 4}, style);
        svg.text({panel_x_px + 40, y}, name, 13);
    };
    bool starts = false;
    for (std::size_t k = 0; k < plot.traces.size(); ++k) {
        entry(plot.traces[k].name, trace_style(k));
        starts |= plot.traces[k].feed_in_rad > 0.0;
    }
    if (!plot.fitted_um.empty()) entry("fitted circle", fitted_style);
    if (starts) {
        y += line_px;
        const double x = panel_x_px;
        svg.line({x, y - 4}, {x + 22, y - 4}, {"#888", 2.2, "none", ""});
        svg.polyline({{x + 20, y - 9}, {x + 31, y - 4}, {x + 20, y + 1}},
                     {"#888", 0.5, "#888", ""});
        svg.text({x + 40, y}, "feed-in and start, bar: end", 13);
    }
    for (const PolarSection& section : plot.sections) {
        y += line_px + 14;
        svg.text({panel_x_px, y}, section.head, 14);
        svg.line({panel_x_px, y + 5}, {panel_right_px, y + 5}, {"#999", 1, "none", ""});
        y += 5;
        for (const auto& [name, value] : section.rows) {
            y += line_px;
            svg.text({panel_x_px, y}, name, 13);
            svg.text({panel_right_px, y}, value, {13, "end"});
        }
    }
}

}  // namespace

double um_per_division(const PolarPlot& plot) {
    double largest = 0.0;
    for (const PolarTrace& trace : plot.traces)
        for (const double um : trace.radial_um) largest = std::max(largest, std::abs(um));
    const double wanted = std::max(largest / divisions, smallest_division_um);
    const double power = std::pow(10.0, std::floor(std::log10(wanted)));
    for (const double step : {1.0, 2.0, 5.0})
        if (step * power >= wanted * (1.0 - 1e-9)) return step * power;
    return 10.0 * power;
}

std::vector<double> fit_eccentric_circle(const std::vector<PolarTrace>& traces) {
    Matrix3 normal = Matrix3::Zero();
    Vector3 right = Vector3::Zero();
    for (const PolarTrace& trace : traces)
        for (std::size_t i = 0; i < trace.angle_rad.size(); ++i) {
            const Vector3 row(1.0, std::cos(trace.angle_rad[i]), std::sin(trace.angle_rad[i]));
            normal += row * row.transpose();
            right += row * trace.radial_um[i];
        }
    if (normal.trace() == 0.0) return {};
    const Vector3 x = normal.ldlt().solve(right);
    return {x.x(), x.y(), x.z()};
}

std::string polar_svg(const PolarPlot& plot) {
    const double division_um = um_per_division(plot), px_per_um = division_px / division_um;
    Svg svg(width_px, height_px);
    svg.describe(plot.title, plot.subtitle + ". Deviation from the nominal circle, magnified.");
    svg.text({30, 36}, plot.title, 20);
    svg.text({30, 58}, plot.subtitle, {13, "start", "#555"});
    draw_grid(svg, plot);
    for (std::size_t k = 0; k < plot.traces.size(); ++k)
        draw_trace(svg, plot.traces[k], px_per_um, trace_style(k));
    draw_fitted(svg, plot, px_per_um);
    for (std::size_t k = 0; k < plot.traces.size(); ++k) draw_start(svg, plot.traces[k], k);
    draw_ruler(svg, division_um);
    draw_panel(svg, plot, division_um);
    return svg.str();
}

}  // namespace trunnion::report
