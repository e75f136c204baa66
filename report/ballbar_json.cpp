#include "report/ballbar_json.h"

#include <nlohmann/json.hpp>

#include "base/units.h"
#include "report/json_values.h"

namespace trunnion::report {

namespace {

using Json = nlohmann::ordered_json;

Json stores_json(const setup::StoresToType& stores) {
    Json list = Json::array();
    for (const setup::StoreLine& line : stores.lines)
        list.push_back({{"name", line.in_force.name},
                        {"in_force_mm", line.in_force.value_mm},
                        {"exact_mm", line.exact_mm},
                        {"type_mm", line.type_mm}});
    return list;
}

const char* unit_of(const kinematics::ErrorName& name) {
    return name.angular() ? "rad" : "mm";
}

Json rows_json(const std::vector<ballbar::test::BallbarErrorRow>& rows, bool after) {
    Json list = Json::array();
    for (const ballbar::test::BallbarErrorRow& row : rows) {
        Json entry = {{"name", to_string(row.name)},
                      {"before", row.before},
                      {"after", after ? Json(row.after) : Json()},
                      {"sigma", json_number(row.sigma)},
                      {"sigma_before", json_number(row.sigma_before)},
                      {"unit", unit_of(row.name)},
                      {"change_percent", after ? json_number(row.change_percent()) : Json()}};
        entry["truly_left"] = row.truly_left ? Json(*row.truly_left) : Json();
        entry["published_before"] = row.published_before ? Json(*row.published_before) : Json();
        list.push_back(entry);
    }
    return list;
}

Json planar_json(const ballbar::test::PlanarResult& planar) {
    const ballbar::test::CircularFigures& f = planar.figures;
    Json causes = Json::array();
    for (const ballbar::test::CircularCause& c : planar.diagnosis.causes)
        causes.push_back({{"name", c.name},
                          {"effect", c.effect},
                          {"value", c.value},
                          {"sigma", json_number(c.sigma)},
                          {"unit", c.unit},
                          {"share_um", c.share_um},
                          {"share", c.share},
                          {"rank", c.rank},
                          {"significant", c.significant},
                          {"note", c.note}});
    return {{"plane", ballbar::test::plane_name(planar.test.plane)},
            {"feed_mm_min", planar.test.passes.front().feed_mm_min},
            {"arc_deg", deg_from_rad(planar.test.arc_rad)},
            {"circularity_ccw_um", f.circularity_ccw_um},
            {"circularity_cw_um", f.circularity_cw_um},
            {"bidirectional_circularity_um", f.bidirectional_circularity_um},
            {"mean_radial_deviation_um", f.mean_radial_deviation_um},
            {"radial_deviation_max_um", f.radial_deviation_max_um},
            {"radial_deviation_min_um", f.radial_deviation_min_um},
            {"hysteresis_um", f.hysteresis_um},
            {"hysteresis_at_deg", deg_from_rad(f.hysteresis_at_rad)},
            {"diagnosis", causes},
            {"not_separable", planar.diagnosis.not_separable},
            {"residual_um", planar.diagnosis.residual_um}};
}

Json groups_json(const std::vector<ballbar::test::InseparableGroup>& groups) {
    Json list = Json::array();
    for (const ballbar::test::InseparableGroup& group : groups)
        list.push_back({{"names", group.names}, {"direction", group.direction}});
    return list;
}

Json time_json(const ballbar::test::BallbarResult& r) {
    return {{"program_s", r.before.time_s},
            {"one_setup_s", r.single_setup_s()},
            {"two_setups_s", r.two_setups_s()},
            {"assumed_setup_s", r.times.setup_s},
            {"assumed_remount_s", r.times.remount_s}};
}

Json residual_json(const ballbar::test::BallbarResult& r) {
    return {
        {"rms_um", um_from_mm(r.fit.rms_mm)},
        {"noise_um", um_from_mm(r.fit.noise_mm)},
        {"structured", r.verdict.structured},
        {"excess_um", r.verdict.excess_um},
        {"worst_test", r.verdict.worst_test},
        {"remedy", r.verdict.structured ? Json("trunnion diagnose READINGS --setup " + r.setup_path)
                                        : Json()}};
}

}  // namespace

std::string ballbar_json(const ballbar::test::BallbarResult& r,
                         const std::vector<FileRead>& inputs) {
    Json out;
    out["schema"] = "trunnion.ballbar/1";
    out["machine"] = r.machine;
    out["errors"] = rows_json(r.errors, r.has_after);
    out["errors_at_intersection"] = rows_json(r.at_intersection, r.has_after);
    out["time_s"] = r.before.time_s;
    out["time"] = time_json(r);
    out["circularity"] = Json::array();
    for (const ballbar::test::PlanarResult& planar : r.planar)
        out["circularity"].push_back(planar_json(planar));
    out["readings"] = r.fit.residual_mm.size();
    out["rank"] = r.open_fit.rank;
    out["unknowns"] = r.open_fit.parameters.size();
    out["inseparable"] = groups_json(r.open_fit.inseparable);
    out["residual"] = residual_json(r);
    const Vector3& p = r.published.pivot_offset_mm;
    out["location_check"] = {{"pivot_offset_mm", {p.x(), p.y(), p.z()}},
                             {"length_error_mm", r.published.length_error_mm},
                             {"rms_um", um_from_mm(r.published.setup_rms_mm)}};
    const ballbar::test::BarLength bar = ballbar::test::bar_length(r);
    out["bar_length"] = {{"reference_mm", r.reference_mm},
                         {"error_mm", bar.error_mm},
                         {"sigma_mm", json_number(bar.sigma_mm)}};
    const Vector3 pivot = ballbar::test::pivot_found_mm(r);
    out["pivot_found_mm"] = {pivot.x(), pivot.y(), pivot.z()};
    out["true_tip_um"] = r.true_tip ? Json(r.true_tip->stated_um) : Json();
    out["true_cup_um"] = r.true_tip ? Json(r.true_tip->cup_um) : Json();
    out["sphere_check"] = r.sphere_check ? Json{{"poses", r.sphere_check->poses},
                                                {"before_um", r.sphere_check->before_um},
                                                {"after_um", r.sphere_check->after_um}}
                                         : Json();
    out["simulated"] = r.simulated;
    out["stores"] = r.stores ? stores_json(*r.stores) : Json::array();
    out["notes"] = r.notes;
    add_inputs(out, inputs);
    return json_text(out, 2) + "\n";
}

}  // namespace trunnion::report
