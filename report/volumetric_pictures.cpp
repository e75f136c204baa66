#include "report/volumetric_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "base/rounded.h"
#include "base/units.h"
#include "report/svg.h"
#include "report/volumetric_report.h"

namespace trunnion::report {
namespace {

using Points = std::vector<const volumetric::VolumetricPoint*>;

double error_um(const volumetric::VolumetricPoint& point) {
    return um_from_mm(point.error_W_mm.norm());
}

/// Dark to light with increasing error as on the page of a run, monotonic also in grey and for
/// colour-blind readers (viridis, five steps).
std::string heat(double part) {
    constexpr std::array<std::array<double, 3>, 5> steps{
        {{68, 1, 84}, {59, 82, 139}, {33, 145, 140}, {94, 201, 98}, {253, 231, 37}}};
    const double at = 4.0 * std::clamp(part, 0.0, 1.0);
    const auto i = static_cast<std::size_t>(std::min(3.0, std::floor(at)));
    const double f = at - static_cast<double>(i);
    std::array<int, 3> rgb{};
    for (std::size_t k = 0; k < 3; ++k)
        rgb[k] = static_cast<int>(std::lround(steps[i][k] + f * (steps[i + 1][k] - steps[i][k])));
    return fmt::format("#{:02x}{:02x}{:02x}", rgb[0], rgb[1], rgb[2]);
}

/// Positions of the axes other than X Y Z in the slices: the grid positions nearest to zero.
AxisPositions middle_of(const volumetric::VolumetricMap& map) {
    AxisPositions nearest;
    for (const Axis axis : map.axes) {
        double best = INFINITY;
        for (const volumetric::VolumetricPoint& p : map.points)
            if (std::abs(p.at[axis]) < std::abs(best)) best = p.at[axis];
        nearest[axis] = best;
    }
    return nearest;
}

/// Points of the slices by height Z.
std::map<double, Points> slices(const volumetric::VolumetricMap& map, const AxisPositions& middle) {
    std::map<double, Points> out;
    for (const volumetric::VolumetricPoint& p : map.points) {
        bool here = true;
        for (const Axis axis : map.axes)
            here = here && (index_of(axis) < 3 || p.at[axis] == middle[axis]);
        if (here) out[p.at[Axis::Z]].push_back(&p);
    }
    return out;
}

/// The positions of one axis among points, rising.
std::vector<double> places(const Points& points, Axis axis) {
    std::vector<double> out;
    for (const volumetric::VolumetricPoint* p : points) out.push_back(p->at[axis]);
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
}

double spacing(const std::vector<double>& steps) {
    return steps.size() < 2
               ? 1.0
               : (steps.back() - steps.front()) / static_cast<double>(steps.size() - 1);
}

void colour_bar(Svg& svg, Point2 corner, double height, double largest_um) {
    constexpr int bands = 60;
    for (int i = 0; i < bands; ++i)
        svg.rectangle({corner.x, corner.y + height * (bands - 1 - i) / bands}, 20,
                      height / bands + 0.5, {"none", 0.0, heat((i + 0.5) / bands), ""});
    svg.rectangle(corner, 20, height, {"#555", 1.0, "none", ""});
    const PlotRange range = round_range(0.0, largest_um);
    for (double v = 0.0; v <= largest_um * (1 + 1e-9); v += range.tick) {
        const double y = corner.y + height * (1.0 - v / largest_um);
        svg.line({corner.x + 20, y}, {corner.x + 25, y}, {"#555", 1.0, "none", ""});
        svg.text({corner.x + 29, y + 4}, fmt::format("{:.6g}", v), 11);
    }
    svg.text({corner.x - 4, corner.y - 10}, "length of error, µm", 12);
}

/// An arrow with a light edge, visible on any colour.
void arrow(Svg& svg, Point2 a, Point2 b) {
    const double dx = b.x - a.x, dy = b.y - a.y, size = std::hypot(dx, dy);
    if (size < 0.5) return;
    const double head = std::min(7.0, 0.5 * size), ux = dx / size, uy = dy / size;
    const auto barb = [&](double side) {
        return Point2{b.x - head * ux + side * 0.5 * head * uy,
                      b.y - head * uy - side * 0.5 * head * ux};
    };
    for (const SvgStyle& style :
         {SvgStyle{"white", 4.0, "none", ""}, SvgStyle{"black", 1.6, "none", ""}}) {
        svg.line(a, b, style);
        svg.polyline({barb(1), b, barb(-1)}, style);
    }
}

/// The eight causes with the largest rms, as bars.
void cause_bars(Svg& svg, Point2 corner, double width, const volumetric::VolumetricMap& map) {
    svg.text({corner.x, corner.y - 8}, "what contributes, over the whole grid (rms, µm)", 13);
    if (map.causes.empty()) return svg.text({corner.x, corner.y + 14}, "no error is set", 12);
    const std::size_t count = std::min<std::size_t>(8, map.causes.size());
    const double largest = std::max(map.causes[0].rms_mm.value(), 1e-12);
    for (std::size_t i = 0; i < count; ++i) {
        const volumetric::VolumetricCause& cause = map.causes[i];
        const double y = corner.y + 20.0 * static_cast<double>(i);
        const double bar = (width - 270) * cause.rms_mm / largest;
        svg.text({corner.x + 120, y + 13}, cause.name, {12, "end"});
        svg.rectangle({corner.x + 128, y + 2}, std::max(bar, 0.5), 14,
                      {"none", 0.0, plot_colours[0], ""});
        svg.text({corner.x + 134 + bar, y + 13},
                 fmt::format("{}  ({:.1f} %)", three_digits(um_from_mm(cause.rms_mm), 3),
                             100.0 * cause.share),
                 11);
    }
}

std::string rotary_text(const volumetric::VolumetricMap& map, const AxisPositions& middle) {
    std::vector<Axis> others;
    for (const Axis axis : map.axes)
        if (index_of(axis) >= 3) others.push_back(axis);
    return others.empty() ? "" : ", " + place_text(map.names, others, middle);
}

/// The grid at one height, and the data for drawing its cells.
struct Slice {
    const Points& points;
    std::vector<double> xs, ys;  ///< rising
    double largest_um;           ///< of the whole grid
    double arrow_px = 0.0;       ///< length of an arrow of `largest_um`

    double dx() const { return spacing(xs); }
    double dy() const { return spacing(ys); }
    /// True when a cell has room for numbers.
    bool roomy() const { return xs.size() <= 9 && ys.size() <= 9; }
};

void draw_cells(Svg& svg, const Plot& plot, const Slice& slice) {
    for (const volumetric::VolumetricPoint* p : slice.points) {
        const double x = p->at[Axis::X], y = p->at[Axis::Y];
        const Point2 low = plot.at(x - 0.5 * slice.dx(), y + 0.5 * slice.dy());
        const Point2 high = plot.at(x + 0.5 * slice.dx(), y - 0.5 * slice.dy());
        svg.rectangle(low, high.x - low.x, high.y - low.y,
                      {"white", 0.5, heat(error_um(*p) / slice.largest_um), ""});
    }
}

void draw_arrows(Svg& svg, const Plot& plot, const Slice& slice) {
    for (const volumetric::VolumetricPoint* p : slice.points) {
        const Point2 at = plot.at(p->at[Axis::X], p->at[Axis::Y]);
        const double scale = slice.arrow_px / slice.largest_um;
        const std::string ink = error_um(*p) / slice.largest_um < 0.55 ? "white" : "#222";
        svg.circle(at, 2.0, {"none", 0.0, ink, ""});
        arrow(svg, at,
              {at.x + scale * um_from_mm(p->error_W_mm.x()),
               at.y - scale * um_from_mm(p->error_W_mm.y())});
        if (!slice.roomy()) continue;
        const Point2 corner =
            plot.at(p->at[Axis::X] + 0.5 * slice.dx(), p->at[Axis::Y] + 0.5 * slice.dy());
        svg.text({corner.x - 4, corner.y + 12}, fmt::format("{:.1f}", error_um(*p)),
                 {10, "end", ink});
        svg.text({corner.x - 4, corner.y + 23},
                 fmt::format("z {:+.1f}", um_from_mm(p->error_W_mm.z())), {9, "end", ink});
    }
}

void draw_slice_legend(Svg& svg, const Slice& slice) {
    colour_bar(svg, {810, 110}, 300, slice.largest_um);
    const double key_um = round_range(0.0, 0.6 * slice.largest_um, 2).tick;
    arrow(svg, {800, 470}, {800 + slice.arrow_px * key_um / slice.largest_um, 470});
    svg.text({800, 490}, fmt::format("{:.6g} µm in X Y", key_um), 12);
    svg.circle({808, 520}, 8, {"#D55E00", 2.5, "none", ""});
    svg.text({824, 524}, "worst here", 12);
    if (slice.roomy()) svg.text({800, 552}, "numbers: length, and Z", 11);
}

std::string slice_picture(const volumetric::VolumetricMap& map, const AxisPositions& middle,
                          double z, const Points& points) {
    Slice slice{points, places(points, Axis::X), places(points, Axis::Y),
                std::max(error_um(map.points[map.worst]), 1e-6)};
    const double dx = slice.dx(), dy = slice.dy();
    Svg svg(960, 870);
    svg.describe("Error of the tool point at one height",
                 "Colour is the length of the error in µm, arrows are its X and Y.");
    svg.text({90, 30}, "Error of the tool point: " + map.machine, 17);
    svg.text({90, 52},
             fmt::format("Z {:.6g} mm{}; tool {:.6g} mm; actual - nominal, in the table's frame", z,
                         rotary_text(map, middle), map.length_mm),
             12);
    Plot plot(svg, {{90, 80}, 680, 500},
              round_range(slice.xs.front() - 0.5 * dx, slice.xs.back() + 0.5 * dx),
              round_range(slice.ys.front() - 0.5 * dy, slice.ys.back() + 0.5 * dy));
    plot.frame("", "X, mm", "Y, mm");
    slice.arrow_px =
        0.8 * std::min(plot.at(dx, 0).x - plot.at(0, 0).x, plot.at(0, 0).y - plot.at(0, dy).y);
    draw_cells(svg, plot, slice);
    draw_arrows(svg, plot, slice);
    const volumetric::VolumetricPoint& worst = **std::max_element(
        points.begin(), points.end(),
        [](const auto* a, const auto* b) { return error_um(*a) < error_um(*b); });
    for (const SvgStyle& ring :
         {SvgStyle{"white", 4.5, "none", ""}, SvgStyle{"#D55E00", 2.5, "none", ""}})
        svg.circle(plot.at(worst.at[Axis::X], worst.at[Axis::Y]), 11, ring);
    draw_slice_legend(svg, slice);
    const auto worst_line = [&](const char* where, const volumetric::VolumetricPoint& p) {
        return fmt::format("{}: {} at {}, mostly {}", where, length_words(error_um(p)),
                           place_text(map.names, map.axes, p.at), cause_name(map, p));
    };
    svg.text({90, 634}, worst_line("Worst at this height", worst), 12);
    svg.text({90, 652}, worst_line("Worst in the whole grid", map.points[map.worst]), 12);
    cause_bars(svg, {90, 695}, 780, map);
    return svg.str();
}

/// Largest and rms error of all points at each position of one axis.
void axis_plot(Svg& svg, Point2 corner, const volumetric::VolumetricMap& map, Axis axis) {
    struct Column {
        double worst = 0.0, squares = 0.0;
        int count = 0;
    };
    std::map<double, Column> columns;
    for (const volumetric::VolumetricPoint& p : map.points) {
        Column& column = columns[map.names.is_rotary(axis) ? deg_from_rad(p.at[axis]) : p.at[axis]];
        column.worst = std::max(column.worst, error_um(p));
        column.squares += error_um(p) * error_um(p);
        ++column.count;
    }
    const double largest = std::max(error_um(map.points[map.worst]), 1e-6);
    Plot plot(svg, {corner, 340, 170}, round_range(columns.begin()->first, columns.rbegin()->first),
              round_range(0, largest));
    plot.frame("", fmt::format("{}, {}", map.names[axis], map.names.is_rotary(axis) ? "deg" : "mm"),
               "µm");
    std::vector<Point2> worst, rms;
    for (const auto& [place, column] : columns) {
        worst.push_back(plot.at(place, column.worst));
        rms.push_back(plot.at(place, std::sqrt(column.squares / column.count)));
    }
    svg.polyline(worst, {plot_colours[4], 2.0, "none", ""});
    svg.polyline(rms, {plot_colours[0], 2.0, "none", "6 3"});
    for (const Point2& p : worst) svg.mark(p, 0, plot_colours[4], 2.5);
    for (const Point2& p : rms) svg.mark(p, 1, plot_colours[0], 2.2);
}

std::string axes_picture(const volumetric::VolumetricMap& map) {
    const std::size_t rows = (map.axes.size() + 1) / 2;
    const double plots = 240.0 * static_cast<double>(rows);
    Svg svg(900, 90 + plots + 210);
    const volumetric::VolumetricPoint& worst = map.points[map.worst];
    svg.describe("Error of the tool point along each axis",
                 "Worst and rms error in µm over the position of each axis, and the causes.");
    svg.text({70, 30}, "Error of the tool point along each axis: " + map.machine, 17);
    svg.text({70, 52},
             fmt::format("{} poses, tool {:.6g} mm; rms {}, worst {} at {}", map.points.size(),
                         map.length_mm, length_words(um_from_mm(map.rms_mm)),
                         length_words(error_um(worst)), place_text(map.names, map.axes, worst.at)),
             12);
    svg.line({640, 28}, {670, 28}, {plot_colours[4], 2.0, "none", ""});
    svg.text({676, 32}, "worst", 12);
    svg.line({730, 28}, {760, 28}, {plot_colours[0], 2.0, "none", "6 3"});
    svg.text({766, 32}, "rms", 12);
    for (std::size_t i = 0; i < map.axes.size(); ++i) {
        const std::size_t column = i % 2, row = i / 2;
        axis_plot(
            svg,
            {90.0 + 420.0 * static_cast<double>(column), 80.0 + 240.0 * static_cast<double>(row)},
            map, map.axes[i]);
    }
    cause_bars(svg, {90, 105 + plots}, 780, map);
    return svg.str();
}

}  // namespace

std::vector<std::pair<std::string, std::string>> volumetric_pictures(
    const volumetric::VolumetricMap& map) {
    std::vector<std::pair<std::string, std::string>> files;
    const AxisPositions middle = middle_of(map);
    for (const auto& [z, points] : slices(map, middle))
        files.emplace_back(fmt::format("volumetric_z{}.svg", files.size() + 1),
                           slice_picture(map, middle, z, points));
    files.emplace_back("volumetric_axes.svg", axes_picture(map));
    return files;
}

}  // namespace trunnion::report
