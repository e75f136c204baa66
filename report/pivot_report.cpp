#include "report/pivot_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/rounded.h"
#include "base/units.h"
#include "report/json_values.h"
#include "report/paragraph.h"

namespace trunnion::report {

std::string group_words(const PivotResult& r, pivot::PivotGroup group) {
    return r.hurco && group == pivot::PivotGroup::p1970x ? "set-up" : name_of(group);
}

Rounded store_error(const pivot::StoreVerdict& store) {
    if (store.sigma_mm < 1e-9) return {"–", "–"};
    return rounded(um_from_mm(store.error_mm), um_from_mm(store.sigma_mm));
}

std::string agreement_words(const pivot::PivotVerdict& verdict) {
    return verdict.agree_um < 1e-3 ? "" : " within " + length_words(verdict.agree_um);
}

std::string store_name(const PivotResult& r, const setup::StoreNumber& n) {
    if (n.parameter == 0) return n.name;
    if (!r.hurco) return fmt::format("No.{} ({})", n.name, "XYZ"[n.component]);
    const char axis = letter_of(n.place == 1 ? r.first : r.second);
    return fmt::format("{} centreline {}{}", axis, "XYZ"[n.component],
                       n.place == 2 ? " - first" : "");
}

namespace {

using Json = nlohmann::ordered_json;

std::string um_vector(const Vector3& v_mm, int decimals) {
    const auto number = [&](double mm) { return decimal(um_from_mm(mm), decimals); };
    return fmt::format("{:>8} {:>8} {:>8}", number(v_mm.x()), number(v_mm.y()), number(v_mm.z()));
}

const pivot::PivotPoint* worst_point(const pivot::PivotArc& arc) {
    const auto worst =
        std::max_element(arc.points.begin(), arc.points.end(),
                         [](const pivot::PivotPoint& a, const pivot::PivotPoint& b) {
                             return a.error_mm.squaredNorm() < b.error_mm.squaredNorm();
                         });
    return worst == arc.points.end() ? nullptr : &*worst;
}

std::string map_text(const PivotResult& r, const pivot::PivotMap& map) {
    std::string out =
        fmt::format("Map {}: {}, {} indexations, circle and errors in µm\n", map.number, map.name,
                    map.arcs.empty() ? 0 : map.arcs[0].points.size());
    const int decimals = decimals_of_sigma(r.verdict.fit.noise_um);
    out += fmt::format("  {:<8} {:<6} {:>8} {:>9}  {:<14} {:>8} {:>8} {:>8}\n", "function", "store",
                       "radius", "expected", "largest at", "X", "Y", "Z");
    for (const pivot::PivotArc& arc : map.arcs)
        if (const pivot::PivotPoint* worst = worst_point(arc))
            out += fmt::format("  {:<8} {:<6} {:>8} {:>9}  {}{:<6g} {}{:<6g} {}\n", arc.function,
                               group_words(r, arc.group),
                               decimal(um_from_mm(arc.circle.radius_mm()), decimals),
                               decimal(um_from_mm(arc.expected.radius_mm()), decimals),
                               letter_of(r.first), worst->first_deg, letter_of(r.second),
                               worst->second_deg, um_vector(worst->error_mm, decimals));
    return out + "\n";
}

std::string stores_table(const PivotResult& r) {
    const pivot::PivotVerdict& v = r.verdict;
    std::string out =
        fmt::format("{:<20} {:>11} {:>11} {:>9} {:>7}{}\n", "Pivot stores", "in force/mm",
                    "to type/mm", "error/µm", "u/µm", r.true_right ? "  true/µm" : "");
    std::vector<setup::StoreNumber> right;
    if (r.true_right) right = setup::store_numbers(*r.true_right);
    for (const pivot::StoreVerdict& s : v.stores) {
        const Rounded error = store_error(s);
        out += fmt::format("  {:<18} {:>11} {:>11} {:>9} {:>7}", store_name(r, s.in_force),
                           decimal(s.in_force.value_mm, 4), decimal(s.type_mm, 4), error.value,
                           error.sigma);
        for (const setup::StoreNumber& n : right)
            if (n.name == s.in_force.name)
                out += fmt::format("  {:>7}", decimal(um_from_mm(s.in_force.value_mm - n.value_mm),
                                                      decimals_of_sigma(um_from_mm(s.sigma_mm))));
        out += s.stale ? "  stale\n" : "\n";
    }
    if (r.hurco) out += "  (the field names of the part set-up are assumed)\n";
    return out + "\n";
}

std::string quality_text(const PivotResult& r) {
    const pivot::PivotVerdict& v = r.verdict;
    std::string out = fmt::format(
        "found from these readings: one centre scatters by {} an axis,\n{} zeroings of "
        "the sphere by {}\n",
        length_words(v.fit.noise_um), v.fit.zeroings, length_words(v.fit.zero_scatter_um));
    for (const pivot::GroupVerdict& g : v.groups)
        out +=
            paragraph(fmt::format("with these values entered (in steps of {:g} mm) {} functions "
                                  "are off by up to {}",
                                  v.increment_mm, group_words(r, g.group), length_words(g.left_um)),
                      0);
    const double apart_um = um_from_mm(setup::step_between_axes_mm(v.right).norm());
    if (v.groups.size() > 1 && apart_um > 0.05)
        out += fmt::format("the rotary axes pass each other by {}: G54 holds one point, so {}\n",
                           length_words(apart_um),
                           r.hurco ? "DPP\nkeeps an error" : "DPP\nand G54.2 keep an error");
    if (v.groups.size() > 1) out += "and agree with each other" + agreement_words(v) + "\n";
    out += "not observable from these readings:\n";
    for (const std::string& line : v.unobservable) out += "  " + line + "\n";
    return out;
}

std::string affected_text(const PivotResult& r) {
    std::string out;
    for (const pivot::AffectedPart& part : r.affected)
        if (part.stale)
            out +=
                fmt::format("  {:<24} {:<6} {:<32} {:>9}\n",
                            part.path.empty() ? "parts made with" : part.path, part.function,
                            pivot::codes_of(part.function, r.hurco), length_words(part.error_um));
    return out.empty() ? out : "affected:\n" + out;
}

Vector3 mean_of(const std::vector<pivot::PivotPoint>& points) {
    Vector3 sum = Vector3::Zero();
    for (const pivot::PivotPoint& p : points) sum += p.error_mm;
    return points.empty() ? sum : Vector3(sum / static_cast<double>(points.size()));
}

Vector3 mean_of(const std::vector<Vector3>& points) {
    Vector3 sum = Vector3::Zero();
    for (const Vector3& p : points) sum += p;
    return points.empty() ? sum : Vector3(sum / static_cast<double>(points.size()));
}

Json arc_json(const PivotResult& r, const pivot::PivotArc& arc) {
    Json points = Json::array();
    const Vector3 mean = mean_of(arc.points), expected_mean = mean_of(arc.expected_mm);
    for (std::size_t i = 0; i < arc.points.size(); ++i) {
        const pivot::PivotPoint& p = arc.points[i];
        points.push_back({{std::string(1, letter_of(r.first)), p.first_deg},
                          {std::string(1, letter_of(r.second)), p.second_deg},
                          {"error_mm", vector_json(p.error_mm)},
                          {"distance_mm", (p.error_mm - mean).norm()},
                          {"expected_mm", vector_json(arc.expected_mm[i])},
                          {"expected_distance_mm", (arc.expected_mm[i] - expected_mean).norm()}});
    }
    return {{"store", name_of(arc.group)},
            {"radius_mm", arc.circle.radius_mm()},
            {"expected_radius_mm", arc.expected.radius_mm()},
            {"centre_mm", vector_json(arc.circle.centre_mm)},
            {"points", points}};
}

Json map_json(const PivotResult& r, const pivot::PivotMap& map) {
    Json functions = Json::object();
    for (const pivot::PivotArc& arc : map.arcs) functions[arc.function] = arc_json(r, arc);
    const char moving = letter_of(map.first_moves ? r.first : r.second);
    const char fixed = letter_of(map.first_moves ? r.second : r.first);
    return {{"name", map.name},
            {"moving", std::string(1, moving)},
            {"fixed", {{std::string(1, fixed), map.fixed_deg}}},
            {"functions", functions}};
}

Json stores_json(const PivotResult& r) {
    Json list = Json::array();
    for (const pivot::StoreVerdict& s : r.verdict.stores)
        list.push_back({{"name", s.in_force.parameter == 0 ? "G54" : s.in_force.name},
                        {"axis", std::string(1, "XYZ"[s.in_force.component])},
                        {"in_force_mm", s.in_force.value_mm},
                        {"type_mm", s.type_mm},
                        {"exact_mm", s.exact_mm},
                        {"error_mm", s.error_mm},
                        {"sigma_mm", json_number(s.sigma_mm)},
                        {"stale", s.stale},
                        {"words", store_name(r, s.in_force)}});
    return list;
}

Json affected_json(const PivotResult& r) {
    Json list = Json::array();
    for (const pivot::AffectedPart& part : r.affected)
        list.push_back({{"program", part.path.empty() ? Json() : Json(part.path)},
                        {"function", part.function},
                        {"codes", pivot::codes_of(part.function, r.hurco)},
                        {"store", name_of(part.group)},
                        {"error_um", part.error_um},
                        {"stale", part.stale}});
    return list;
}

}  // namespace

std::string pivot_table(const PivotResult& r) {
    std::string out = fmt::format("{} ({}{})\n\n", r.machine, r.source,
                                  r.date.empty() ? "" : ", measured " + r.date) +
                      stores_table(r);
    for (const pivot::PivotMap& map : r.maps) out += map_text(r, map);
    return out + quality_text(r) + affected_text(r) + "\n" +
           paragraph(pivot::sentence(r.verdict, r.hurco), 0);
}

std::string pivot_json(const PivotResult& r, const std::vector<FileRead>& inputs) {
    Json maps = Json::array();
    for (const pivot::PivotMap& map : r.maps) maps.push_back(map_json(r, map));
    Json groups = Json::array();
    for (const pivot::GroupVerdict& g : r.verdict.groups)
        groups.push_back({{"store", name_of(g.group)},
                          {"measured", g.measured},
                          {"stale", g.stale},
                          {"visible_um", g.visible_um},
                          {"sigma_um", json_number(g.sigma_um)},
                          {"left_after_typing_um", g.left_um}});
    Json json({{"schema", "trunnion.pivot/1"},
               {"verdict", pivot::sentence(r.verdict, r.hurco)},
               {"machine", r.machine},
               {"source", r.source},
               {"date", r.date.empty() ? Json() : Json(r.date)},
               {"maps", maps},
               {"stores", stores_json(r)},
               {"groups", groups},
               {"unobservable", r.verdict.unobservable},
               {"affected", affected_json(r)},
               {"noise_um", r.verdict.fit.noise_um},
               {"zero_scatter_um", r.verdict.fit.zero_scatter_um},
               {"zeroings", r.verdict.fit.zeroings},
               {"agree_after_typing_um", r.verdict.agree_um}});
    add_inputs(json, inputs);
    return json_text(json, 1) + "\n";
}

}  // namespace trunnion::report
