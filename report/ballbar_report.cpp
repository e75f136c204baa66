#include "report/ballbar_report.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "geometry/units.h"
#include "report/polar_plot.h"

namespace trunnion {

namespace {

using Json = nlohmann::ordered_json;

double change_percent(const BallbarErrorRow& row) {
    return row.before == 0.0 ? 0.0 : 100.0 * (std::abs(row.after) / std::abs(row.before) - 1.0);
}

const char* unit_of(const ErrorName& name) {
    return name.angular() ? "rad" : "mm";
}

/// um or urad, never "-0.000".
double small(const ErrorName& name, double value) {
    const double out = name.angular() ? urad_from_rad(value) : um_from_mm(value);
    return std::abs(out) < 5e-4 ? 0.0 : out;
}

std::string error_table(const std::vector<BallbarErrorRow>& rows) {
    std::string text =
        fmt::format("{:6} {:>11} {:>10} {:>9} {:>11} {:>9}  {:>9}  {}\n", "error", "before",
                    "u(before)", "after", "change", "u(after)", "published", "unit");
    for (const BallbarErrorRow& row : rows) {
        const auto n = [&](double v) { return small(row.name, v); };
        text += fmt::format(
            "{:6} {:11.3f} {:10.3f} {:9.3f} {:9.2f} % {:9.3f}  {:>9}  {}\n", to_string(row.name),
            n(row.before), n(row.sigma_before), n(row.after), change_percent(row), n(row.sigma),
            row.published_before ? fmt::format("{:.3f}", n(*row.published_before)) : "-",
            row.name.angular() ? "urad" : "um");
    }
    return text;
}

std::string group_text(const InseparableGroup& group) {
    std::string text;
    for (std::size_t i = 0; i < group.names.size(); ++i)
        text += fmt::format("{}{:+.2f} {}", i ? "  " : "", group.direction[i], group.names[i]);
    return text;
}

std::string rank_text(const BallbarResult& r) {
    std::string text = fmt::format(
        "rank {} of {}: with the cup's place unknown these move together and change no reading\n",
        r.open_fit.rank, r.open_fit.parameters.size());
    for (const InseparableGroup& group : r.open_fit.inseparable)
        text += "  " + group_text(group) + "\n";
    return text +
           fmt::format(
               "taken as known: tool length {:.3f} mm (offset H{}) and a cup that runs true; "
               "an error of it in Z\nappears in the first axis's Z position with opposite "
               "sign, 1 um for 1 um\n",
               -r.data.layout.cup_S_mm.z(), r.data.tool_offset);
}

std::string residual_text(const BallbarResult& r) {
    std::string text = fmt::format("residual {:.3f} um rms, noise {:.3f} um",
                                   um_from_mm(r.fit.rms_mm), um_from_mm(r.fit.noise_mm));
    if (!r.verdict.structured) return text + ": nothing but noise is left\n";
    return text + fmt::format(
                      ": {:.3f} um are structure that location errors do not explain (worst in "
                      "{}).\nThe values above carry it. Diagnose it:\n"
                      "  trunnion ballbar --setup {} --readings R.csv\n"
                      "  trunnion diagnose R.csv --setup {}\n",
                      r.verdict.excess_um, r.verdict.worst_test, r.setup_path, r.setup_path);
}

std::string setup_text(const BallbarResult& r) {
    const Vector3& p = r.published.pivot_offset_mm;
    return fmt::format(
        "location check (sphere through the three circles): pivot off by ({:.2f} {:.2f} {:.2f}) "
        "um, readings {:+.2f} um long, rms {:.2f} um\n",
        um_from_mm(p.x()), um_from_mm(p.y()), um_from_mm(p.z()),
        um_from_mm(r.published.length_error_mm), um_from_mm(r.published.setup_rms_mm));
}

std::string planar_text(const PlanarResult& planar) {
    const CircularFigures& f = planar.figures;
    std::string text = fmt::format(
        "{} at {:.0f} mm/min, {:.0f} deg: circularity ccw {:.2f}, cw {:.2f}, bidirectional {:.2f}, "
        "mean radial deviation {:+.2f},\n  hysteresis {:.2f} um at {:.0f} deg\n",
        plane_name(planar.test.plane), planar.test.passes.front().feed_mm_min,
        deg_from_rad(planar.test.arc_rad), f.circularity_ccw_um, f.circularity_cw_um,
        f.bidirectional_circularity_um, f.mean_radial_deviation_um, f.hysteresis_um,
        deg_from_rad(f.hysteresis_at_rad));
    for (const CircularCause& c : planar.diagnosis.causes)
        text += fmt::format("  {:2} {:22} {:9.3f} +- {:6.3f} {:5} {:7.2f} um {:4.0f} % {}{}\n",
                            c.rank, c.name, c.value, c.sigma, c.unit, c.share_um, 100.0 * c.share,
                            c.significant ? "" : "(not significant) ", c.note);
    for (const std::string& name : planar.diagnosis.not_separable)
        text += "     " + name + ": cannot be told apart on this arc\n";
    return text;
}

std::string minutes(double seconds) {
    return fmt::format("{:.1f} min", seconds / 60.0);
}

std::string time_text(const BallbarResult& r) {
    return fmt::format(
        "time: program {}; one set-up {}, two set-ups {} ({:.0f} % saved; assumed: {} for a "
        "set-up, {} to move the bar between tests)\n",
        minutes(r.before.time_s), minutes(r.single_setup_s()), minutes(r.two_setups_s()),
        100.0 * (1.0 - r.single_setup_s() / r.two_setups_s()), minutes(r.times.setup_s),
        minutes(r.times.remount_s));
}

std::string parameters_text(const BallbarResult& r) {
    std::string text = "control parameters with the positions found (tilts have none):";
    for (const auto& [number, value] : r.pivot_parameters)
        text += fmt::format("  {} = {:.4f}", number, value);
    return text + "\n";
}

Json rows_json(const std::vector<BallbarErrorRow>& rows) {
    Json list = Json::array();
    for (const BallbarErrorRow& row : rows) {
        Json entry = {{"name", to_string(row.name)},
                      {"before", row.before},
                      {"after", row.after},
                      {"sigma", row.sigma},
                      {"sigma_before", row.sigma_before},
                      {"unit", unit_of(row.name)},
                      {"change_percent", change_percent(row)}};
        entry["published_before"] = row.published_before ? Json(*row.published_before) : Json();
        list.push_back(entry);
    }
    return list;
}

Json planar_json(const PlanarResult& planar) {
    const CircularFigures& f = planar.figures;
    Json causes = Json::array();
    for (const CircularCause& c : planar.diagnosis.causes)
        causes.push_back({{"name", c.name},
                          {"effect", c.effect},
                          {"value", c.value},
                          {"sigma", c.sigma},
                          {"unit", c.unit},
                          {"share_um", c.share_um},
                          {"share", c.share},
                          {"rank", c.rank},
                          {"significant", c.significant},
                          {"note", c.note}});
    return {{"plane", plane_name(planar.test.plane)},
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

Json groups_json(const std::vector<InseparableGroup>& groups) {
    Json list = Json::array();
    for (const InseparableGroup& group : groups)
        list.push_back({{"names", group.names}, {"direction", group.direction}});
    return list;
}

Json time_json(const BallbarResult& r) {
    return {{"program_s", r.before.time_s},
            {"one_setup_s", r.single_setup_s()},
            {"two_setups_s", r.two_setups_s()},
            {"assumed_setup_s", r.times.setup_s},
            {"assumed_remount_s", r.times.remount_s}};
}

Json residual_json(const BallbarResult& r) {
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

std::string ballbar_table(const BallbarResult& r) {
    std::string text = fmt::format(
        "{}: single-set-up ballbar test, L0 {:g} mm, {} tests both ways, {} readings\n\n",
        r.machine, r.data.layout.length_mm, r.tests(), r.fit.residual_mm.size());
    text += "location errors at point_mm, second axis relative to the first that carries it\n";
    text += error_table(r.errors);
    text += "\nthe same axis lines in M at the nominal intersection (as in the 2015 paper)\n";
    text += error_table(r.at_intersection);
    text +=
        "\npublished: circles, planes and transport of 2015; its bias against `before` is the "
        "cosine error of the bar\n";
    text += "\n" + setup_text(r) + residual_text(r) + "\n" + rank_text(r) + "\n" +
            parameters_text(r) + time_text(r) + "\n";
    for (const PlanarResult& planar : r.planar) text += planar_text(planar);
    return text;
}

std::string ballbar_json(const BallbarResult& r) {
    Json out;
    out["schema"] = "trunnion.ballbar/1";
    out["machine"] = r.machine;
    out["errors"] = rows_json(r.errors);
    out["errors_at_intersection"] = rows_json(r.at_intersection);
    out["time_s"] = r.before.time_s;
    out["time"] = time_json(r);
    out["circularity"] = Json::array();
    for (const PlanarResult& planar : r.planar) out["circularity"].push_back(planar_json(planar));
    out["readings"] = r.fit.residual_mm.size();
    out["rank"] = r.open_fit.rank;
    out["unknowns"] = r.open_fit.parameters.size();
    out["inseparable"] = groups_json(r.open_fit.inseparable);
    out["residual"] = residual_json(r);
    const Vector3& p = r.published.pivot_offset_mm;
    out["location_check"] = {{"pivot_offset_mm", {p.x(), p.y(), p.z()}},
                             {"length_error_mm", r.published.length_error_mm},
                             {"rms_um", um_from_mm(r.published.setup_rms_mm)}};
    out["parameters"] = Json::object();
    for (const auto& [number, value] : r.pivot_parameters)
        out["parameters"][std::to_string(number)] = value;
    out["notes"] = r.notes;
    return out.dump(2) + "\n";
}

namespace {

PolarPlot planar_plot(const PlanarResult& planar) {
    const auto [u, v] = axes_of_plane(planar.test.plane);
    PolarPlot plot;
    plot.title = fmt::format("{} circle, R {:g} mm, {:.0f} mm/min", plane_name(planar.test.plane),
                             planar.test.radius_mm, planar.test.passes.front().feed_mm_min);
    plot.right = letter_of(u);
    plot.top = letter_of(v);
    for (const CircularPass& pass : planar.test.passes) {
        PolarTrace trace{pass.name, pass.angle_rad, {}};
        for (const double mm : centred_radial_mm(pass, planar.test.circle, planar.test.radius_mm))
            trace.radial_um.push_back(um_from_mm(mm));
        plot.traces.push_back(std::move(trace));
    }
    plot.fitted_um = {planar.figures.mean_radial_deviation_um, 0.0, 0.0};
    plot.captions = {
        fmt::format("circularity {:.2f} / {:.2f} um, bidirectional {:.2f} um, "
                    "hysteresis {:.2f} um",
                    planar.figures.circularity_ccw_um, planar.figures.circularity_cw_um,
                    planar.figures.bidirectional_circularity_um, planar.figures.hysteresis_um)};
    for (const CircularCause& c : planar.diagnosis.causes)
        if (c.rank <= 3 && c.significant)
            plot.captions.push_back(fmt::format("{}. {}: {:.2f} {} ({:.0f} %)", c.rank, c.name,
                                                c.value, c.unit, 100.0 * c.share));
    return plot;
}

/// Means over neighbouring readings, less the mean of the pass.
PolarTrace rotary_trace(const std::vector<Reading>& rows, const BallbarPass& pass,
                        const std::string& name) {
    PolarTrace trace{name, {}, {}};
    const std::size_t count = pass.end - pass.begin;
    const std::size_t blocks = std::min<std::size_t>(count, 720);
    double mean = 0.0;
    for (std::size_t b = 0; b < blocks; ++b) {
        const std::size_t begin = pass.begin + count * b / blocks;
        const std::size_t end = pass.begin + count * (b + 1) / blocks;
        double sum = 0.0;
        for (std::size_t i = begin; i < end; ++i) sum += rows[i].value_mm.value_or(0.0);
        trace.angle_rad.push_back(rows[(begin + end - 1) / 2].commanded[*pass.test.rotary]);
        trace.radial_um.push_back(um_from_mm(sum / static_cast<double>(end - begin)));
        mean += trace.radial_um.back() / static_cast<double>(blocks);
    }
    for (double& um : trace.radial_um) um -= mean;
    return trace;
}

void add_rotary_plots(const BallbarResult& r, std::map<std::string, std::string>& out) {
    std::map<std::string, PolarPlot> plots;
    for (const BallbarPass& pass : ballbar_passes(r.before.readings.rows)) {
        if (!pass.test.rotary) continue;
        const std::string name = to_string(pass.test);
        PolarPlot& plot = plots[name];
        plot.title = name + ", bar length about its mean, before compensation and after";
        plot.right = std::string(1, letter_of(*pass.test.rotary)) + "0";
        plot.top = std::string(1, letter_of(*pass.test.rotary)) + "90";
        plot.traces.push_back(rotary_trace(r.before.readings.rows, pass, pass.name + " before"));
    }
    for (auto& [name, plot] : plots) {
        plot.fitted_um = fit_eccentric_circle(plot.traces);
        plot.captions = {
            fmt::format("fitted circle off centre by {:.2f} um (cos) and {:.2f} um (sin)",
                        plot.fitted_um[1], plot.fitted_um[2])};
    }
    for (const BallbarPass& pass : ballbar_passes(r.after.readings.rows))
        if (pass.test.rotary)
            plots[to_string(pass.test)].traces.push_back(
                rotary_trace(r.after.readings.rows, pass, pass.name + " after"));
    for (const auto& [name, plot] : plots) out[name + ".svg"] = polar_svg(plot);
}

}  // namespace

std::map<std::string, std::string> ballbar_pictures(const BallbarResult& r) {
    std::map<std::string, std::string> out;
    for (const PlanarResult& planar : r.planar)
        out[fmt::format("{}_{:.0f}.svg", to_string(BallbarTest{planar.test.plane, std::nullopt}),
                        planar.test.passes.front().feed_mm_min)] = polar_svg(planar_plot(planar));
    add_rotary_plots(r, out);
    return out;
}

}  // namespace trunnion
