#include "report/pivot_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/units.h"
#include "report/svg.h"

namespace trunnion {

namespace {

std::string um_vector(const Vector3& v_mm) {
    const auto number = [](double mm) {
        const double um = um_from_mm(mm);
        return std::abs(um) < 0.005 ? 0.0 : um;
    };
    return fmt::format("({:9.2f} {:9.2f} {:9.2f})", number(v_mm.x()), number(v_mm.y()),
                       number(v_mm.z()));
}

const PivotPoint* worst_point(const PivotArc& arc) {
    const auto worst = std::max_element(
        arc.points.begin(), arc.points.end(), [](const PivotPoint& a, const PivotPoint& b) {
            return a.error_mm.squaredNorm() < b.error_mm.squaredNorm();
        });
    return worst == arc.points.end() ? nullptr : &*worst;
}

Vector3 mean_error(const PivotArc& arc) {
    Vector3 sum = Vector3::Zero();
    for (const PivotPoint& p : arc.points) sum += p.error_mm;
    return arc.points.empty() ? sum : Vector3(sum / static_cast<double>(arc.points.size()));
}

double moving_deg(const PivotMap& map, const PivotPoint& p) {
    return map.moving == Axis::C ? p.c_deg : p.b_deg;
}

std::string legend_name(const PivotArc& arc) {
    return fmt::format("{} ({})", arc.function, arc.store);
}

void draw_legend(Svg& svg, Point2 at, const PivotMap& map) {
    for (std::size_t k = 0; k < map.arcs.size(); ++k) {
        const double x = at.x + 150.0 * static_cast<double>(k);
        svg.mark({x, at.y - 4}, static_cast<int>(k), plot_colours[k], 4.0);
        svg.text({x + 10, at.y}, legend_name(map.arcs[k]), 12);
    }
}

struct Panels {
    Svg svg{940, 800};
    Point2 corner(std::size_t k) const {
        return {80.0 + 450.0 * static_cast<double>(k % 2),
                90.0 + 360.0 * static_cast<double>(k / 2)};
    }
};

std::string distances_picture(const PivotDemonstration& demo) {
    Panels page;
    page.svg.text({470, 28}, "Distance from each map's mean error", 16, "middle");
    if (!demo.maps.empty()) draw_legend(page.svg, {170, 54}, demo.maps.front());
    double highest = 0.0;
    for (const PivotMap& map : demo.maps)
        for (const PivotArc& arc : map.arcs)
            for (const PivotPoint& p : arc.points)
                highest = std::max(highest, um_from_mm((p.error_mm - mean_error(arc)).norm()));
    for (std::size_t m = 0; m < demo.maps.size() && m < 4; ++m) {
        const PivotMap& map = demo.maps[m];
        const bool full = map.moving == Axis::C;
        Plot plot(page.svg, page.corner(m), 370, 260,
                  full ? PlotRange{0, 360, 60} : PlotRange{-90, 90, 30},
                  round_range(0.0, std::max(highest, 0.1)));
        plot.frame(fmt::format("Map {}: {}", map.number, map.name),
                   fmt::format("{} / deg", letter_of(map.moving)), "distance / µm");
        for (std::size_t k = 0; k < map.arcs.size(); ++k) {
            std::vector<Point2> line;
            for (const PivotPoint& p : map.arcs[k].points)
                line.push_back(plot.at(moving_deg(map, p),
                                       um_from_mm((p.error_mm - mean_error(map.arcs[k])).norm())));
            page.svg.polyline(line, {plot_colours[k], 1.2, "none", k % 2 ? "5 4" : ""});
            // The two functions of a store lie on each other: the second gets smaller marks on top.
            for (const Point2& at : line)
                page.svg.mark(at, static_cast<int>(k), plot_colours[k], k % 2 ? 2.4 : 4.2);
        }
    }
    return page.svg.str();
}

std::string circles_picture(const PivotDemonstration& demo) {
    Panels page;
    page.svg.text({470, 28},
                  "Eccentric circle of each map: error in the plane normal to the moving axis", 16,
                  "middle");
    if (!demo.maps.empty()) draw_legend(page.svg, {170, 54}, demo.maps.front());
    double reach = 0.05;
    for (const PivotMap& map : demo.maps)
        for (const PivotArc& arc : map.arcs)
            reach = std::max(reach, um_from_mm(arc.radius_mm) * 1.12);
    for (std::size_t m = 0; m < demo.maps.size() && m < 4; ++m) {
        const PivotMap& map = demo.maps[m];
        const PlotRange range = round_range(-reach, reach, 4);
        Point2 corner = page.corner(m);
        corner.x += 55;
        Plot plot(page.svg, corner, 260, 260, range, range);
        plot.frame(fmt::format("Map {}: {}", map.number, map.name), "X / µm",
                   map.moving == Axis::C ? "Y / µm" : "Z / µm");
        for (std::size_t k = 0; k < map.arcs.size(); ++k) {
            const PivotArc& arc = map.arcs[k];
            const double radius = um_from_mm(arc.radius_mm);
            page.svg.circle(plot.at(0, 0), radius * plot.scale_x(),
                            {plot_colours[k], k % 2 ? 1.6 : 3.0, "none", k % 2 ? "6 5" : ""});
            const double y = corner.y + 90 + 40.0 * static_cast<double>(k);
            page.svg.text({corner.x + 268, y}, arc.function, 11, "start", plot_colours[k]);
            page.svg.text({corner.x + 268, y + 13}, fmt::format("r {:.1f} µm", radius), 11);
        }
    }
    return page.svg.str();
}

}  // namespace

std::string pivot_table(const PivotDemonstration& demo) {
    const PivotStores& s = demo.stores;
    std::string out = "Pivot stores, µm against the true machine (X Y Z)\n";
    out += "  G54                       " + um_vector(s.g54 - s.p_true) + "\n";
    out += "  P1970x 19700-19702        " + um_vector(s.p - s.p_true) + "\n";
    out += "  P1970x 19703-19705        " + um_vector(s.d - s.d_true) + "\n\n";
    for (const PivotMap& map : demo.maps) {
        out += fmt::format("Map {}: {}, {} indexations\n", map.number, map.name,
                           map.arcs.empty() ? 0 : map.arcs[0].points.size());
        out +=
            "  function  store    circle radius    expected   largest error at                X    "
            "     Y  "
            "       Z / µm\n";
        for (const PivotArc& arc : map.arcs) {
            const PivotPoint* worst = worst_point(arc);
            if (worst == nullptr) continue;
            out += fmt::format("  {:<9} {:<7} {:10.2f} µm {:8.2f} µm   B{:<7g} C{:<7g} {}\n",
                               arc.function, arc.store, um_from_mm(arc.radius_mm),
                               um_from_mm(arc.expected_radius_mm), worst->b_deg, worst->c_deg,
                               um_vector(worst->error_mm));
        }
        out += "\n";
    }
    return out + demo.verdict + "\n";
}

std::string pivot_json(const PivotDemonstration& demo) {
    using Json = nlohmann::ordered_json;
    Json maps = Json::array();
    for (const PivotMap& map : demo.maps) {
        Json functions = Json::object();
        for (const PivotArc& arc : map.arcs) {
            Json points = Json::array();
            for (const PivotPoint& p : arc.points)
                points.push_back({{"B", p.b_deg},
                                  {"C", p.c_deg},
                                  {"error_mm", {p.error_mm.x(), p.error_mm.y(), p.error_mm.z()}}});
            functions[arc.function] = {{"store", arc.store},
                                       {"radius_mm", arc.radius_mm},
                                       {"expected_radius_mm", arc.expected_radius_mm},
                                       {"points", points}};
        }
        maps.push_back({{"name", map.name},
                        {"moving", std::string(1, letter_of(map.moving))},
                        {"fixed", {{std::string(1, letter_of(map.fixed)), map.fixed_deg}}},
                        {"functions", functions}});
    }
    return Json({{"schema", "trunnion.pivot/1"}, {"verdict", demo.verdict}, {"maps", maps}})
               .dump(1) +
           "\n";
}

std::map<std::string, std::string> pivot_pictures(const PivotDemonstration& demo) {
    return {{"distances.svg", distances_picture(demo)}, {"circles.svg", circles_picture(demo)}};
}

}  // namespace trunnion
