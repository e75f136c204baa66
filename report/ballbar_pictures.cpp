#include "report/ballbar_pictures.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/rounded.h"
#include "base/units.h"
#include "report/polar_plot.h"

namespace trunnion::report {

namespace {

constexpr std::size_t lines_shown = 6;  ///< of the diagnosis

std::string set_up_line(const ballbar::test::BallbarResult& r) {
    return fmt::format("{}  ·  single set-up, L0 {:g} mm", r.machine, r.data.layout.length_mm);
}

PolarSection figures_section(const ballbar::test::CircularFigures& f) {
    return {"ISO 230-4",
            {{"circularity, ccw", length_words(f.circularity_ccw_um)},
             {"circularity, cw", length_words(f.circularity_cw_um)},
             {"bidirectional circularity", length_words(f.bidirectional_circularity_um)},
             {"mean radial deviation", length_words(f.mean_radial_deviation_um)},
             {"radial deviation, largest", length_words(f.radial_deviation_max_um)},
             {"radial deviation, smallest", length_words(f.radial_deviation_min_um)},
             {"hysteresis", length_words(f.hysteresis_um)}}};
}

PolarSection diagnosis_section(const ballbar::test::CircularDiagnosis& diagnosis) {
    PolarSection section{"Diagnosis (share of all traces)", {}};
    for (const ballbar::test::CircularCause& c : diagnosis.causes) {
        if (!c.significant || section.rows.size() == lines_shown) continue;
        section.rows.emplace_back(fmt::format("{}. {}", c.rank, c.name),
                                  fmt::format("{} {}  {:.0f} %", rounded(c.value, c.sigma).value,
                                              shown_unit(c.unit), 100.0 * c.share));
    }
    if (section.rows.empty()) section.rows.emplace_back("nothing significant", "");
    return section;
}

PolarPlot planar_plot(const ballbar::test::BallbarResult& r,
                      const ballbar::test::PlanarResult& planar) {
    const auto [u, v] = ballbar::test::axes_of_plane(planar.test.plane);
    const double feed = planar.test.passes.front().feed_mm_min;
    PolarPlot plot;
    plot.title = fmt::format("{} circle, radius {:g} mm, {:.0f}°, {:.0f} mm/min",
                             ballbar::test::plane_name(planar.test.plane), planar.test.radius_mm,
                             deg_from_rad(planar.test.arc_rad), feed);
    plot.subtitle = set_up_line(r);
    plot.right = std::string("+") + letter_of(u);
    plot.top = std::string("+") + letter_of(v);
    plot.left = std::string("-") + letter_of(u);
    plot.bottom = std::string("-") + letter_of(v);
    for (const ballbar::test::CircularPass& pass : planar.test.passes) {
        PolarTrace trace{pass.ccw ? "counter-clockwise" : "clockwise",
                         pass.angle_rad,
                         {},
                         rad_from_deg(r.data.overshoot_deg)};
        for (const double mm :
             ballbar::test::centred_radial_mm(pass, planar.test.circle, planar.test.radius_mm))
            trace.radial_um.push_back(um_from_mm(mm));
        plot.traces.push_back(std::move(trace));
    }
    plot.fitted_um = {planar.figures.mean_radial_deviation_um, 0.0, 0.0};
    plot.sections = {figures_section(planar.figures), diagnosis_section(planar.diagnosis)};
    return plot;
}

/// Means of neighbouring readings, minus the mean of the pass.
PolarTrace rotary_trace(const std::vector<records::Reading>& rows,
                        const ballbar::test::BallbarPass& pass, const std::string& name,
                        double feed_in_rad) {
    PolarTrace trace{name, {}, {}, feed_in_rad};
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

std::string direction_of(const ballbar::test::BallbarPass& pass) {
    return pass.travel > 0.0 ? "angle rising" : "angle falling";
}

PolarPlot rotary_plot(const ballbar::test::BallbarResult& r,
                      const ballbar::test::BallbarPass& pass) {
    const char axis = letter_of(*pass.test.rotary);
    PolarPlot plot;
    plot.title =
        fmt::format("{} test of {}, {:.0f}°, TCP on",
                    pass.test.kind == ballbar::test::BallbarTestKind::radial ? "Radial" : "Axial",
                    axis, std::abs(deg_from_rad(pass.travel)));
    plot.subtitle = set_up_line(r) + ", bar length about its mean";
    plot.right = fmt::format("{} 0°", axis);
    plot.top = fmt::format("{} 90°", axis);
    plot.left = fmt::format("{} 180°", axis);
    plot.bottom = fmt::format("{} 270°", axis);
    return plot;
}

double largest_um(const std::vector<PolarTrace>& traces, std::size_t from, std::size_t to) {
    double out = 0.0;
    for (std::size_t k = from; k < std::min(to, traces.size()); ++k) {
        const auto [low, high] =
            std::minmax_element(traces[k].radial_um.begin(), traces[k].radial_um.end());
        out = std::max(out, *high - *low);
    }
    return out;
}

void add_rotary_plots(const ballbar::test::BallbarResult& r,
                      std::map<std::string, std::string>& out) {
    std::map<std::string, PolarPlot> plots;
    for (const ballbar::test::BallbarPass& pass :
         ballbar::test::ballbar_passes(r.before.readings.rows)) {
        if (!pass.test.rotary) continue;
        const auto [at, added] = plots.try_emplace(to_string(pass.test));
        if (added) at->second = rotary_plot(r, pass);
        at->second.traces.push_back(rotary_trace(r.before.readings.rows, pass,
                                                 "before, " + direction_of(pass),
                                                 rad_from_deg(r.data.overshoot_deg)));
    }
    std::map<std::string, std::size_t> before;
    for (auto& [name, plot] : plots) {
        plot.fitted_um = fit_eccentric_circle(plot.traces);
        before[name] = plot.traces.size();
    }
    for (const ballbar::test::BallbarPass& pass :
         ballbar::test::ballbar_passes(r.after.readings.rows))
        if (pass.test.rotary)
            plots[to_string(pass.test)].traces.push_back(
                rotary_trace(r.after.readings.rows, pass, "after, " + direction_of(pass), 0.0));
    for (auto& [name, plot] : plots) {
        const std::size_t n = before[name];
        plot.sections = {{"Peak to peak",
                          {{"before compensation", length_words(largest_um(plot.traces, 0, n))},
                           {"after compensation",
                            length_words(largest_um(plot.traces, n, plot.traces.size()))}}},
                         {"Fitted circle, before",
                          {{"off centre towards 0°", length_words(plot.fitted_um[1])},
                           {"off centre towards 90°", length_words(plot.fitted_um[2])}}}};
        out[name + ".svg"] = polar_svg(plot);
    }
}

}  // namespace

std::map<std::string, std::string> ballbar_pictures(const ballbar::test::BallbarResult& r) {
    std::map<std::string, std::string> out;
    for (const ballbar::test::PlanarResult& planar : r.planar)
        out[fmt::format(
            "{}_{:.0f}.svg", to_string(ballbar::test::BallbarTest{planar.test.plane, std::nullopt}),
            planar.test.passes.front().feed_mm_min)] = polar_svg(planar_plot(r, planar));
    add_rotary_plots(r, out);
    return out;
}

}  // namespace trunnion::report
