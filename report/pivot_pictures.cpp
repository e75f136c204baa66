// Figures of the four-function test: distances from the mean of each map, and eccentric circles.
#include "report/pivot_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/units.h"
#include "report/svg.h"

namespace trunnion::report {

namespace {

std::vector<Vector3> measured_of(const pivot::PivotArc& arc) {
    std::vector<Vector3> errors;
    for (const pivot::PivotPoint& p : arc.points) errors.push_back(p.error_mm);
    return errors;
}

/// Distance of each error from their mean, µm.
std::vector<double> distances_um(const std::vector<Vector3>& errors_mm) {
    Vector3 mean = Vector3::Zero();
    for (const Vector3& e : errors_mm) mean += e / static_cast<double>(errors_mm.size());
    std::vector<double> distances;
    for (const Vector3& e : errors_mm) distances.push_back(um_from_mm((e - mean).norm()));
    return distances;
}

struct Panels {
    std::size_t count, rows = (count + 1) / 2;
    Svg svg{940, 80.0 + 360.0 * static_cast<double>(rows)};
    Point2 corner(std::size_t k) const {
        const std::size_t column = k % 2, row = k / 2;
        return {80.0 + 450.0 * static_cast<double>(column),
                90.0 + 360.0 * static_cast<double>(row)};
    }
};

std::size_t style_of(const pivot::PivotArc& arc) {
    const auto& all = pivot::pivot_functions();
    const auto at = std::find_if(all.begin(), all.end(), [&](const pivot::PivotFunction& f) {
        return f.name == arc.function;
    });
    return static_cast<std::size_t>(at - all.begin());
}

void draw_legend(Svg& svg, Point2 at, const PivotResult& r) {
    std::vector<pivot::PivotArc> named;
    for (const pivot::PivotMap& map : r.maps)
        if (map.arcs.size() > named.size()) named = map.arcs;
    for (std::size_t k = 0; k < named.size(); ++k) {
        const double x = at.x + 150.0 * static_cast<double>(k);
        const std::size_t style = style_of(named[k]);
        svg.mark({x, at.y - 4}, static_cast<int>(style), plot_colours[style], 4.0);
        svg.text({x + 10, at.y},
                 fmt::format("{} ({})", named[k].function, group_words(r, named[k].group)), 12);
    }
}

std::string moving_letter(const PivotResult& r, const pivot::PivotMap& map) {
    return std::string(1, letter_of(map.first_moves ? r.first : r.second));
}

void draw_distances(Plot& plot, Svg& svg, const pivot::PivotMap& map, const pivot::PivotArc& arc) {
    const std::size_t k = style_of(arc);
    const auto measured = distances_um(measured_of(arc)), expected = distances_um(arc.expected_mm);
    std::vector<Point2> line;
    for (std::size_t i = 0; i < arc.points.size(); ++i)
        line.push_back(plot.at(map.moving_deg(arc.points[i]), expected[i]));
    svg.polyline(line, {plot_colours[k], 1.2, "none", k % 2 ? "5 4" : ""});
    // The two functions of a store coincide: the second gets smaller marks on top.
    for (std::size_t i = 0; i < arc.points.size(); ++i)
        svg.mark(plot.at(map.moving_deg(arc.points[i]), measured[i]), static_cast<int>(k),
                 plot_colours[k], k % 2 ? 2.4 : 4.2);
}

std::string distances_picture(const PivotResult& r) {
    Panels page{r.maps.size()};
    page.svg.describe("Distance of each found sphere from its map's mean error",
                      "One panel a map: angle of the moving axis in degrees, distance in µm, for "
                      "each positioning function. Marks are measured, lines expected.");
    page.svg.text({470, 28}, "Distance from each map's mean error: marks measured, lines expected",
                  {16, "middle"});
    draw_legend(page.svg, {170, 54}, r);
    double highest = 0.1;
    for (const pivot::PivotMap& map : r.maps)
        for (const pivot::PivotArc& arc : map.arcs)
            for (const double d : distances_um(measured_of(arc))) highest = std::max(highest, d);
    for (std::size_t m = 0; m < r.maps.size(); ++m) {
        const pivot::PivotMap& map = r.maps[m];
        double last = 90.0;
        for (const pivot::PivotArc& arc : map.arcs)
            for (const pivot::PivotPoint& p : arc.points) last = std::max(last, map.moving_deg(p));
        Plot plot(page.svg, {page.corner(m), 370, 260},
                  last > 180.0 ? PlotRange{0, 360, 60} : PlotRange{-90, 90, 30},
                  round_range(0.0, highest));
        plot.frame(fmt::format("Map {}: {}", map.number, map.name),
                   moving_letter(r, map) + " / deg", "distance / µm");
        for (const pivot::PivotArc& arc : map.arcs) draw_distances(plot, page.svg, map, arc);
    }
    return page.svg.str();
}

/// The plane perpendicular to the moving axis, in which its circles lie.
struct CirclePlane {
    Vector3 a = Vector3::UnitX(), b = Vector3::UnitY();
    std::string a_name = "X", b_name = "Y";

    Point2 um(const Vector3& v_mm) const {
        return {um_from_mm(a.dot(v_mm)), um_from_mm(b.dot(v_mm))};
    }
};

CirclePlane plane_across(const Vector3& axis_M) {
    Eigen::Index along = 0;
    const bool square = axis_M.cwiseAbs().maxCoeff(&along) > 1.0 - 1e-6;
    const int first = along == 0 ? 1 : 0, second = along == 2 ? 1 : 2;
    CirclePlane plane;
    plane.a = Vector3::Unit(first);
    plane.b = Vector3::Unit(second);
    plane.a_name = std::string(1, "XYZ"[first]);
    plane.b_name = std::string(1, "XYZ"[second]);
    if (square) return plane;
    plane.a = (plane.a - plane.a.dot(axis_M) * axis_M).normalized();
    plane.b = axis_M.cross(plane.a);
    plane.a_name = "across the axis";
    plane.b_name = "across both";
    return plane;
}

void draw_circle(const Plot& plot, Svg& svg, const CirclePlane& plane, const pivot::PivotArc& arc) {
    const std::size_t k = style_of(arc);
    const Point2 centre = plane.um(arc.circle.centre_mm),
                 expected = plane.um(arc.expected.centre_mm);
    svg.circle(plot.at(centre.x, centre.y), um_from_mm(arc.circle.radius_mm()) * plot.scale_x(),
               {plot_colours[k], k % 2 ? 1.2 : 5.0, "none", ""});
    svg.circle(plot.at(expected.x, expected.y),
               um_from_mm(arc.expected.radius_mm()) * plot.scale_x(),
               {plot_colours[k], 0.8, "none", "6 5"});
    for (const pivot::PivotPoint& p : arc.points) {
        const Point2 at = plane.um(p.error_mm);
        svg.mark(plot.at(at.x, at.y), static_cast<int>(k), plot_colours[k], k % 2 ? 1.8 : 4.5);
    }
    const Point2 at = plot.at(centre.x, centre.y);
    // Functions with one store have one circle: the wider one shows behind the other.
    const double arm = k % 2 ? 5.0 : 8.0, width = k % 2 ? 1.2 : 4.0;
    svg.line({at.x - arm, at.y}, {at.x + arm, at.y}, {plot_colours[k], width, "none", ""});
    svg.line({at.x, at.y - arm}, {at.x, at.y + arm}, {plot_colours[k], width, "none", ""});
}

double reach_um(const std::vector<pivot::PivotMap>& maps) {
    double reach = 0.05;
    for (const pivot::PivotMap& map : maps)
        for (const pivot::PivotArc& arc : map.arcs)
            reach = std::max(
                reach, 1.12 * um_from_mm(arc.circle.centre_mm.norm() + arc.circle.radius_mm()));
    return reach;
}

std::string circles_picture(const PivotResult& r) {
    Panels page{r.maps.size()};
    page.svg.describe("Eccentric circle of each map",
                      "One panel a map, in the plane across the moving axis, µm. Measured points, "
                      "fitted circle and centre of each positioning function; dashed circles are "
                      "expected.");
    page.svg.text({470, 28}, "Eccentric circle of each map: measured points, circle and centre",
                  {16, "middle"});
    draw_legend(page.svg, {170, 54}, r);
    const double reach = reach_um(r.maps);
    for (std::size_t m = 0; m < r.maps.size(); ++m) {
        const pivot::PivotMap& map = r.maps[m];
        const CirclePlane plane =
            plane_across(pivot::moving_axis_M(r.verdict.in_force.pivot, map).normalized());
        Point2 corner = page.corner(m);
        corner.x += 55;
        const PlotRange range = round_range(-reach, reach, 4);
        Plot plot(page.svg, {corner, 260, 260}, range, range);
        plot.frame(fmt::format("Map {}: {}", map.number, map.name), plane.a_name + " / µm",
                   plane.b_name + " / µm");
        double y = corner.y + 60;
        for (const pivot::PivotArc& arc : map.arcs) {
            draw_circle(plot, page.svg, plane, arc);
            page.svg.text({corner.x + 268, y}, arc.function,
                          {11, "start", plot_colours[style_of(arc)]});
            page.svg.text({corner.x + 268, y + 13},
                          fmt::format("r {:.1f} µm", um_from_mm(arc.circle.radius_mm())), 11);
            y += 40;
        }
    }
    return page.svg.str();
}

}  // namespace

std::map<std::string, std::string> pivot_pictures(const PivotResult& result) {
    return {{"distances.svg", distances_picture(result)}, {"circles.svg", circles_picture(result)}};
}

}  // namespace trunnion::report
