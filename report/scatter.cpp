#include "report/scatter.h"

#include <fmt/format.h>

#include <algorithm>

namespace trunnion::report {
namespace {

constexpr std::size_t most_marks = 1500;
constexpr double left_px = 80, top_px = 60, plot_width_px = 620, plot_height_px = 260;

struct Extent {
    double low = 0.0, high = 0.0;
    bool empty = true;
    void include(double v) {
        low = empty ? v : std::min(low, v);
        high = empty ? v : std::max(high, v);
        empty = false;
    }
};

/// Distance of the points that get a mark.
std::size_t stride_of(const ScatterSeries& series) {
    return (series.points.size() + most_marks - 1) / most_marks;
}

std::string legend_text(const ScatterSeries& series) {
    const std::size_t stride = stride_of(series);
    return stride > 1 ? fmt::format("{} (one of {})", series.name, stride) : series.name;
}

}  // namespace

std::string scatter_svg(const Scatter& scatter) {
    Extent x, y;
    for (const ScatterSeries& series : scatter.series)
        for (const Point2& p : series.points) x.include(p.x), y.include(p.y);
    Svg svg(left_px + plot_width_px + 30, top_px + plot_height_px + 60);
    svg.describe(scatter.title, scatter.description);
    Plot plot(svg, {{left_px, top_px}, plot_width_px, plot_height_px},
              round_range(x.low, x.high, 8), round_range(y.low, y.high));
    plot.frame(scatter.title, scatter.x_label, scatter.y_label);
    double legend_px = left_px;
    for (std::size_t k = 0; k < scatter.series.size(); ++k) {
        const ScatterSeries& series = scatter.series[k];
        const std::string& colour = plot_colours[k % plot_colours.size()];
        const int shape = static_cast<int>(k % 4);
        for (std::size_t i = 0; i < series.points.size(); i += stride_of(series))
            svg.mark(plot.at(series.points[i].x, series.points[i].y), shape, colour, 2.4);
        if (series.name.empty()) continue;
        const std::string text = legend_text(series);
        svg.mark({legend_px, 22}, shape, colour, 4.0);
        svg.text({legend_px + 10, 26}, text, 12);
        legend_px += 30.0 + 7.0 * static_cast<double>(text.size());
    }
    return svg.str();
}

}  // namespace trunnion::report
