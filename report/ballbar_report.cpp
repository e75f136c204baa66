#include "report/ballbar_report.h"

#include <fmt/format.h>

#include <cmath>

#include "base/numbers.h"
#include "base/rounded.h"
#include "base/units.h"
#include "report/stores_text.h"

namespace trunnion::report {

namespace {

/// µm or µrad.
double small(const kinematics::ErrorName& name, double value) {
    return name.angular() ? urad_from_rad(value) : um_from_mm(value);
}

std::string table_of_errors(const std::vector<ballbar::test::BallbarErrorRow>& rows, bool after) {
    std::string text =
        after ? fmt::format("{:6} {:>10} {:>9} {:>10} {:>9} {:>11} {:>10}  {}\n", "error", "before",
                            "u(before)", "after", "u(after)", "truly left", "published", "unit")
              : fmt::format("{:6} {:>10} {:>9} {:>10}  {}\n", "error", "found", "u(found)",
                            "published", "unit");
    for (const ballbar::test::BallbarErrorRow& row : rows) {
        const auto n = [&](double v) { return small(row.name, v); };
        const auto known = [&](const std::optional<double>& v, double sigma) {
            return v ? decimal(n(*v), decimals_of_sigma(n(sigma))) : std::string("–");
        };
        const char* unit = row.name.angular() ? "µrad" : "µm";
        const Rounded found = rounded(n(row.before), n(row.sigma_before));
        text += fmt::format("{:6} {:>10} {:>9} ", to_string(row.name), found.value, found.sigma);
        if (after) {
            const Rounded left = rounded(n(row.after), n(row.sigma));
            text += fmt::format("{:>10} {:>9} {:>11} ", left.value, left.sigma,
                                known(row.truly_left, row.sigma));
        }
        text += fmt::format("{:>10}  {}\n", known(row.published_before, row.sigma_before), unit);
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
        "rank {} of {}: with an unknown cup position these combinations change no reading\n",
        r.open_fit.rank, r.open_fit.parameters.size());
    for (const ballbar::test::InseparableGroup& group : r.open_fit.inseparable)
        text += "  " + group_text(group) + "\n";
    return text + fmt::format(
                      "assumed as known: tool length {:.3f} mm (offset H{}) and a cup without "
                      "runout;\na tool longer by 1 µm reads as +1 µm of EZ0{}\n",
                      -r.data.layout.cup_S_mm.z(), r.data.tool_offset, first_axis(r));
}

std::string residual_text(const ballbar::test::BallbarResult& r) {
    std::string text =
        fmt::format("residual {} rms, noise {}", length_words(um_from_mm(r.fit.rms_mm)),
                    length_words(um_from_mm(r.fit.noise_mm)));
    if (!r.verdict.structured) return text + ": only noise remains\n";
    return text + fmt::format(
                      ": {} are structure that location errors do not explain\n(worst in {}). It "
                      "biases the values above. To diagnose it:\n  trunnion ballbar --setup {} "
                      "--write-readings R.csv\n  trunnion diagnose R.csv --setup {}\n",
                      length_words(r.verdict.excess_um), r.verdict.worst_test, r.setup_path,
                      r.setup_path);
}

std::string setup_text(const ballbar::test::BallbarResult& r) {
    const Vector3& p = r.published.pivot_offset_mm;
    const ballbar::test::BarLength bar = ballbar::test::bar_length(r);
    const auto place = [](const Vector3& mm) {
        return fmt::format("({} {} {}) µm", decimal(um_from_mm(mm.x()), 2),
                           decimal(um_from_mm(mm.y()), 2), decimal(um_from_mm(mm.z()), 2));
    };
    return fmt::format(
               "exact fit of the set-up: bar {:.4f} mm, longer by {} µm,\n  pivot {} from its "
               "stated "
               "place on the table\n",
               r.reference_mm, with_sigma(um_from_mm(bar.error_mm), um_from_mm(bar.sigma_mm)),
               place(ballbar::test::pivot_found_mm(r))) +
           fmt::format(
               "location check (sphere through the three circles):\n  pivot off by {}, readings {} "
               "long, rms {}\n",
               place(p), length_words(um_from_mm(r.published.length_error_mm)),
               length_words(um_from_mm(r.published.setup_rms_mm)));
}

std::string planar_text(const ballbar::test::PlanarResult& planar) {
    const ballbar::test::CircularFigures& f = planar.figures;
    std::string text = fmt::format(
        "{} at {:.0f} mm/min, {:.0f} deg: circularity ccw {}, cw {},\n"
        "  bidirectional {}, mean radial {}, hysteresis {} at {:.0f} deg\n",
        ballbar::test::plane_name(planar.test.plane), planar.test.passes.front().feed_mm_min,
        deg_from_rad(planar.test.arc_rad), length_words(f.circularity_ccw_um),
        length_words(f.circularity_cw_um), length_words(f.bidirectional_circularity_um),
        length_words(f.mean_radial_deviation_um), length_words(f.hysteresis_um),
        deg_from_rad(f.hysteresis_at_rad));
    for (const ballbar::test::CircularCause& c : planar.diagnosis.causes) {
        const Rounded shown = rounded(c.value, c.sigma);
        text += fmt::format(
            "  {:2} {:18} {:>8} ± {:<7} {:5}{:>7} µm{:4.0f} %{}{}\n", c.rank, c.name, shown.value,
            shown.sigma, shown_unit(c.unit), three_digits(c.share_um, 3), 100.0 * c.share,
            c.significant ? "" : " not significant", c.note.empty() ? "" : "  " + c.note);
    }
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
            "true error of the tip after compensation (the simulator knows it): {} with\n"
            "a tool as long as its offset says, {} at the cup as it hangs\n",
            length_words(r.true_tip->stated_um), length_words(r.true_tip->cup_um));
    if (r.sphere_check)
        text += fmt::format(
            "second check, sphere and probe, independent of the fit: {} poses off by up to\n{} "
            "before, {} after\n",
            r.sphere_check->poses, length_words(r.sphere_check->before_um),
            length_words(r.sphere_check->after_um));
    if (r.true_tip)
        text +=
            "\"after\" comes from the same cup: a cup that is not where its offset says shows\n"
            "in \"truly left\" and in the true error alone, and in the sphere unless its\n"
            "stylus is off alike\n";
    return text;
}

std::string location_text(const ballbar::test::BallbarResult& r) {
    if (r.errors.empty())
        return "no passes of the rotary axes: location errors are not evaluated\n\n";
    std::string text =
        "location errors at point_mm, second axis relative to the first that carries it\n" +
        table_of_errors(r.errors, r.has_after);
    if (!r.at_intersection.empty())
        text += "\nthe same axis lines in M at the nominal intersection (as in the 2015 paper)\n" +
                table_of_errors(r.at_intersection, r.has_after);
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
        "{}: {}, L0 {:g} mm,\n{} tests, {} readings\n\n", r.machine,
        r.simulated ? "single-set-up ballbar test, simulated" : "measured ballbar passes",
        r.data.layout.length_mm, r.tests(), r.before.readings.rows.size());
    text += location_text(r) + proof_text(r);
    if (r.simulated) text += time_text(r);
    text += "\n";
    for (const ballbar::test::PlanarResult& planar : r.planar) text += planar_text(planar);
    return text;
}

}  // namespace trunnion::report
