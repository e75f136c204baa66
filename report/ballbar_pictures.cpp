#include <fmt/format.h>

#include <algorithm>

#include "geometry/units.h"
#include "report/ballbar_report.h"
#include "report/polar_plot.h"

namespace trunnion {

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
