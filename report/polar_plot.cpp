#include "report/polar_plot.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "geometry/pose.h"
#include "geometry/units.h"
#include "report/svg.h"

namespace trunnion {

namespace {

constexpr double width_px = 580, middle_px = 280, drop_px = 32, nominal_px = 150;
constexpr double division_px = 24, below_px = 570, line_px = 17;
constexpr int divisions = 4;  ///< drawn each side of the nominal circle
constexpr std::size_t points_drawn = 1440;

Point2 at(double angle_rad, double radius_px) {
    return {middle_px + radius_px * std::cos(angle_rad),
            middle_px + drop_px - radius_px * std::sin(angle_rad)};
}

void draw_grid(Svg& svg, const PolarPlot& plot, double division_um) {
    for (int k = -divisions; k <= divisions; ++k) {
        const double r = nominal_px + k * division_px;
        svg.circle(at(0, 0), r, {k == 0 ? "#444" : "#ddd", k == 0 ? 1.4 : 1.0, "none", ""});
    }
    const double edge = nominal_px + (divisions + 0.3) * division_px;
    for (int i = 0; i < 4; ++i) svg.line(at(0, 0), at(0.5 * pi * i, edge), {"#bbb", 1, "none", ""});
    svg.text(at(-0.03, edge + 4), "+" + plot.right, 12);
    svg.text(at(0.5 * pi, edge + 8), "+" + plot.top, 12, "middle");
    svg.text({middle_px, 22}, plot.title, 15, "middle");
    svg.text({width_px - 12, below_px + line_px}, fmt::format("{:g} um/div", division_um), 13,
             "end");
}

void draw_trace(Svg& svg, const PolarTrace& trace, double px_per_um, const std::string& colour) {
    std::vector<Point2> points;
    const std::size_t count = trace.angle_rad.size(),
                      step = std::max<std::size_t>(1, count / points_drawn);
    for (std::size_t i = 0; i < count; i += step)
        points.push_back(at(trace.angle_rad[i], nominal_px + px_per_um * trace.radial_um[i]));
    svg.polyline(points, {colour, 1.2, "none", ""});
}

/// The magnified eccentric circle over the arc that was run.
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
    svg.polyline(points, {"#222", 1.2, "none", "5 4"});
}

void draw_legend(Svg& svg, const PolarPlot& plot) {
    double y = below_px;
    const auto entry = [&](const std::string& name, const SvgStyle& style) {
        y += line_px;
        svg.line({16, y - 4}, {40, y - 4}, style);
        svg.text({46, y}, name, 12);
    };
    for (std::size_t k = 0; k < plot.traces.size(); ++k)
        entry(plot.traces[k].name, {plot_colours[k % plot_colours.size()], 2, "none", ""});
    if (!plot.fitted_um.empty()) entry("fitted circle", {"#222", 1.2, "none", "5 4"});
    y += 6;
    for (const std::string& caption : plot.captions) svg.text({16, y += line_px}, caption, 12);
}

}  // namespace

double um_per_division(const PolarPlot& plot) {
    double largest = 0.0;
    for (const PolarTrace& trace : plot.traces)
        for (const double um : trace.radial_um) largest = std::max(largest, std::abs(um));
    const double wanted = std::max(largest / divisions, 1e-3);
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
    const double division_um = um_per_division(plot);
    const auto lines = static_cast<double>(plot.traces.size() + 1 + plot.captions.size());
    Svg svg(width_px, below_px + line_px * (lines + 1) + 6);
    draw_grid(svg, plot, division_um);
    for (std::size_t k = 0; k < plot.traces.size(); ++k)
        draw_trace(svg, plot.traces[k], division_px / division_um,
                   plot_colours[k % plot_colours.size()]);
    draw_fitted(svg, plot, division_px / division_um);
    draw_legend(svg, plot);
    return svg.str();
}

}  // namespace trunnion
