#include "report/ballbar_report.h"

#include <fmt/format.h>

#include <cmath>

#include "base/numbers.h"
#include "base/units.h"
#include "report/stores_text.h"

namespace trunnion::report {

namespace {

/// um or urad, never "-0.000".
double small(const kinematics::ErrorName& name, double value) {
    const double out = name.angular() ? urad_from_rad(value) : um_from_mm(value);
    return std::abs(out) < 5e-4 ? 0.0 : out;
}

std::string error_table(const std::vector<ballbar::test::BallbarErrorRow>& rows, bool after) {
    std::string text =
        after ? fmt::format("{:6} {:>10} {:>9} {:>10} {:>9} {:>11} {:>10}  {}\n", "error", "before",
                            "u(before)", "after", "u(after)", "truly left", "published", "unit")
              : fmt::format("{:6} {:>10} {:>9} {:>10}  {}\n", "error", "found", "u(found)",
                            "published", "unit");
    for (const ballbar::test::BallbarErrorRow& row : rows) {
        const auto n = [&](double v) { return small(row.name, v); };
        const auto known = [&](const std::optional<double>& v) {
            return v ? fmt::format("{:.3f}", n(*v)) : std::string("-");
        };
        const char* unit = row.name.angular() ? "urad" : "um";
        text += fmt::format("{:6} {:10.3f} {:9.3f} ", to_string(row.name), n(row.before),
                            n(row.sigma_before));
        if (after)
            text += fmt::format("{:10.3f} {:9.3f} {:>11} ", n(row.after), n(row.sigma),
                                known(row.truly_left));
        text += fmt::format("{:>10}  {}\n", known(row.published_before), unit);
    }
    return text;
}

std::string group_text(const ballbar::test::InseparableGroup& group) {
    std::string text;
    for (std::size_t i = 0; i < group.names.size(); ++i)
        text += fmt::format("{}{:+.2f} {}", i ? "  " : "", group.direction[i], group.names[i]);
    return text;
}

/// Letter of the axis nearest the bed.
char first_axis(const ballbar::test::BallbarResult& r) {
    return r.errors.empty() ? '?' : letter_of(r.errors.front().name.axis);
}

std::string rank_text(const ballbar::test::BallbarResult& r) {
    std::string text = fmt::format(
        "rank {} of {}: with the cup's place unknown these move together and change no\nreading\n",
        r.open_fit.rank, r.open_fit.parameters.size());
    for (const ballbar::test::InseparableGroup& group : r.open_fit.inseparable)
        text += "  " + group_text(group) + "\n";
    return text + fmt::format(
                      "taken as known: tool length {:.3f} mm (offset H{}) and a cup that runs "
                      "true;\na tool longer by 1 um reads as +1 um of EZ0{}\n",
                      -r.data.layout.cup_S_mm.z(), r.data.tool_offset, first_axis(r));
}

std::string residual_text(const ballbar::test::BallbarResult& r) {
    std::string text = fmt::format("residual {:.3f} um rms, noise {:.3f} um",
                                   um_from_mm(r.fit.rms_mm), um_from_mm(r.fit.noise_mm));
    if (!r.verdict.structured) return text + ": nothing but noise is left\n";
    return text + fmt::format(
                      ": {:.3f} um are structure that location errors do not explain (worst in "
                      "{}).\nThe values above carry it. Diagnose it:\n"
                      "  trunnion ballbar --setup {} --write-readings R.csv\n"
                      "  trunnion diagnose R.csv --setup {}\n",
                      r.verdict.excess_um, r.verdict.worst_test, r.setup_path, r.setup_path);
}

std::string setup_text(const ballbar::test::BallbarResult& r) {
    const Vector3& p = r.published.pivot_offset_mm;
    const ballbar::test::BarLength bar = ballbar::test::bar_length(r);
    const Vector3 pivot = ballbar::test::pivot_found_mm(r);
    return fmt::format(
               "exact fit of the set-up: bar {:.4f} mm {:+.3f} +- {:.3f} um,\n  pivot ({:.2f} "
               "{:.2f} "
               "{:.2f}) um from its stated place on the table\n",
               r.reference_mm, um_from_mm(bar.error_mm), um_from_mm(bar.sigma_mm),
               um_from_mm(pivot.x()), um_from_mm(pivot.y()), um_from_mm(pivot.z())) +
           fmt::format(
               "location check (sphere through the three circles): pivot off by ({:.2f} {:.2f} "
               "{:.2f}) um,\n"
               "  readings {:+.2f} um long, rms {:.2f} um\n",
               um_from_mm(p.x()), um_from_mm(p.y()), um_from_mm(p.z()),
               um_from_mm(r.published.length_error_mm), um_from_mm(r.published.setup_rms_mm));
}

std::string planar_text(const ballbar::test::PlanarResult& planar) {
    const ballbar::test::CircularFigures& f = planar.figures;
    std::string text = fmt::format(
        "{} at {:.0f} mm/min, {:.0f} deg: circularity ccw {:.2f}, cw {:.2f}, bidirectional "
        "{:.2f},\n"
        "  mean radial deviation {:+.2f}, hysteresis {:.2f} um at {:.0f} deg\n",
        ballbar::test::plane_name(planar.test.plane), planar.test.passes.front().feed_mm_min,
        deg_from_rad(planar.test.arc_rad), f.circularity_ccw_um, f.circularity_cw_um,
        f.bidirectional_circularity_um, f.mean_radial_deviation_um, f.hysteresis_um,
        deg_from_rad(f.hysteresis_at_rad));
    for (const ballbar::test::CircularCause& c : planar.diagnosis.causes)
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

std::string time_text(const ballbar::test::BallbarResult& r) {
    return fmt::format(
        "time: program {}; one set-up {}, two set-ups {} ({:.0f} % saved;\n"
        "  assumed: {} for a set-up, {} to move the bar between tests)\n",
        minutes(r.before.time_s), minutes(r.single_setup_s()), minutes(r.two_setups_s()),
        100.0 * (1.0 - r.single_setup_s() / r.two_setups_s()), minutes(r.times.setup_s),
        minutes(r.times.remount_s));
}

/// Empty for a value that is not finite: an unobservable parameter has no sigma.
std::string cell(double value) {
    return std::isfinite(value) ? shortest(value) : std::string();
}

std::string csv_rows(const char* where, const std::vector<ballbar::test::BallbarErrorRow>& rows) {
    std::string text;
    for (const ballbar::test::BallbarErrorRow& row : rows)
        text +=
            fmt::format("{},{},{},{},{},{},{},{},{},{}\n", where, to_string(row.name),
                        cell(row.before), cell(row.sigma_before), cell(row.after), cell(row.sigma),
                        cell(row.change_percent()), row.truly_left ? cell(*row.truly_left) : "",
                        row.published_before ? shortest(*row.published_before) : "",
                        row.name.angular() ? "rad" : "mm");
    return text;
}

}  // namespace

std::string ballbar_csv(const ballbar::test::BallbarResult& r) {
    return "where,name,before,u_before,after,u_after,change_percent,truly_left,published_before,"
           "unit\n" +
           csv_rows("point_mm", r.errors) + csv_rows("intersection", r.at_intersection);
}

namespace {

std::string proof_text(const ballbar::test::BallbarResult& r) {
    std::string text;
    if (r.true_tip)
        text += fmt::format(
            "true error of the tip after compensation (the simulator knows it): {:.2f} um with a "
            "tool\nas long as its offset says, {:.2f} um at the cup as it hangs\n",
            r.true_tip->stated_um, r.true_tip->cup_um);
    if (r.sphere_check)
        text += fmt::format(
            "second check, sphere and probe, no part of the fit: {} poses off by up to {:.2f} um\n"
            "before, {:.2f} um after\n",
            r.sphere_check->poses, r.sphere_check->before_um, r.sphere_check->after_um);
    if (r.true_tip)
        text +=
            "\"after\" comes from the same cup: a cup that is not where its offset says shows in\n"
            "\"truly left\" and in the true error alone, and in the sphere unless its stylus is "
            "off alike\n";
    return text;
}

std::string location_text(const ballbar::test::BallbarResult& r) {
    if (r.errors.empty())
        return "no passes of the rotary axes: location errors are not evaluated\n\n";
    std::string text =
        "location errors at point_mm, second axis relative to the first that carries it\n" +
        error_table(r.errors, r.has_after);
    if (!r.at_intersection.empty())
        text += "\nthe same axis lines in M at the nominal intersection (as in the 2015 paper)\n" +
                error_table(r.at_intersection, r.has_after);
    text +=
        "\npublished: circles, planes and transport of 2015; its bias against the exact fit\n"
        "is the cosine error of the bar\n";
    text += "\n" + setup_text(r) + residual_text(r) + "\n" + rank_text(r) + "\n";
    if (r.stores) text += stores_text(*r.stores, r.dialect) + "\n";
    return text;
}

}  // namespace

std::string ballbar_table(const ballbar::test::BallbarResult& r) {
    std::string text = fmt::format(
        "{}: {}, L0 {:g} mm, {} tests, {} readings\n\n", r.machine,
        r.simulated ? "single-set-up ballbar test, simulated" : "measured ballbar passes",
        r.data.layout.length_mm, r.tests(), r.before.readings.rows.size());
    text += location_text(r) + proof_text(r);
    if (r.simulated) text += time_text(r);
    text += "\n";
    for (const ballbar::test::PlanarResult& planar : r.planar) text += planar_text(planar);
    return text;
}

}  // namespace trunnion::report
