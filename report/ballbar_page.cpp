#include "report/ballbar_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/rounded.h"
#include "base/units.h"
#include "report/ballbar_pictures.h"
#include "report/ballbar_report.h"

namespace trunnion::report {
namespace {

using ballbar::test::BallbarErrorRow;
using ballbar::test::BallbarResult;

double shop(const BallbarErrorRow& row, double value) {
    return row.name.angular() ? urad_from_rad(value) : um_from_mm(value);
}

const char* unit_of(const BallbarErrorRow& row) {
    return row.name.angular() ? "µrad" : "µm";
}

const BallbarErrorRow* largest(const BallbarResult& r, bool angular) {
    const BallbarErrorRow* out = nullptr;
    for (const BallbarErrorRow& row : r.errors)
        if (row.name.angular() == angular && (!out || std::abs(row.before) > std::abs(out->before)))
            out = &row;
    return out;
}

std::string size_text(const BallbarErrorRow& row) {
    return fmt::format("{} {} {}", to_string(row.name),
                       with_sigma(shop(row, row.before), shop(row, row.sigma_before)),
                       unit_of(row));
}

std::string verdict(const BallbarResult& r) {
    const BallbarErrorRow *place = largest(r, false), *tilt = largest(r, true);
    if (!place || !tilt)
        return "No passes of the rotary axes: the circles have their figures, location errors are "
               "not evaluated.";
    std::string text =
        fmt::format("Largest errors found: {} and {}.", size_text(*place), size_text(*tilt));
    if (r.true_tip)
        text += fmt::format(
            " After compensation a tool as long as its offset says is truly off by up to {}.",
            length_words(r.true_tip->stated_um));
    if (r.verdict.structured)
        text += fmt::format(
            " The readings contain {} that location errors and noise do not explain: run diagnose.",
            length_words(r.verdict.excess_um));
    return text;
}

PageTable errors_table(const BallbarResult& r, const std::vector<BallbarErrorRow>& rows,
                       const std::string& caption) {
    PageTable table{caption, {"error", "found", "u"}, "lrrrrrrl", {}};
    if (r.has_after) table.header.insert(table.header.end(), {"re-test", "u of it"});
    if (r.simulated) table.header.emplace_back("truly left");
    table.header.insert(table.header.end(), {"as published", "unit"});
    for (const BallbarErrorRow& row : rows) {
        const Rounded found = rounded(shop(row, row.before), shop(row, row.sigma_before));
        std::vector<std::string> cells{to_string(row.name), found.value, found.sigma};
        if (r.has_after) {
            const Rounded left = rounded(shop(row, row.after), shop(row, row.sigma));
            cells.push_back(left.value);
            cells.push_back(left.sigma);
        }
        const auto known = [&](const std::optional<double>& v, double sigma) {
            return v ? decimal(shop(row, *v), decimals_of_sigma(shop(row, sigma)))
                     : std::string("–");
        };
        if (r.simulated) cells.push_back(known(row.truly_left, row.sigma));
        cells.push_back(known(row.published_before, row.sigma_before));
        cells.emplace_back(unit_of(row));
        table.rows.push_back(std::move(cells));
    }
    table.alignment = "l" + std::string(table.header.size() - 2, 'r') + "l";
    return table;
}

std::string errors_section(const BallbarResult& r) {
    if (r.errors.empty()) return {};
    std::string body = table_html(errors_table(
        r, r.errors,
        "At the points of the setup (point_mm), the second axis relative to the first"));
    if (!r.at_intersection.empty())
        body += table_html(errors_table(r, r.at_intersection,
                                        "Axis lines in M at the nominal intersection (2015)"));
    return section_html("Location errors", body);
}

std::string stores_section(const BallbarResult& r) {
    if (!r.stores) return {};
    PageTable table{"", {"number", "in force / mm", "to type / mm", "change / µm"}, "lrrr", {}};
    for (const setup::StoreLine& line : r.stores->lines)
        table.rows.push_back({line.in_force.name, decimal(line.in_force.value_mm, 4),
                              decimal(line.type_mm, 4),
                              decimal(um_from_mm(line.type_mm - line.in_force.value_mm), 1)});
    return section_html(
        "What to type",
        table_html(table) +
            paragraph_html(
                fmt::format("The tip error on the table is up to {} with the values in force. "
                            "After the new values are entered, tilts of the axes leave {}, which "
                            "these values cannot express, and the increment of {:g} mm leaves {}.",
                            length_words(r.stores->now_um), length_words(r.stores->tilts_um),
                            r.stores->increment_mm, length_words(r.stores->rounding_um))));
}

std::string plots_section(const BallbarResult& r) {
    std::string body;
    for (const auto& [name, svg] : ballbar_pictures(r))
        body += figure_html(svg, "Deviation from the nominal circle, magnified");
    return section_html("Polar plots", body);
}

std::string circles_section(const BallbarResult& r) {
    PageTable table{
        "ISO 230-4, means over half a degree, µm",
        {"plane", "mm/min", "G ccw", "G cw", "G(b)", "D", "H", "first in the diagnosis"},
        "lrrrrrrl",
        {}};
    for (const ballbar::test::PlanarResult& planar : r.planar) {
        const ballbar::test::CircularFigures& f = planar.figures;
        const auto& causes = planar.diagnosis.causes;
        const bool shown = !causes.empty() && causes.front().significant;
        table.rows.push_back(
            {std::string(ballbar::test::plane_name(planar.test.plane)),
             decimal(planar.test.passes.front().feed_mm_min, 0),
             three_digits(f.circularity_ccw_um, 3), three_digits(f.circularity_cw_um, 3),
             three_digits(f.bidirectional_circularity_um, 3),
             three_digits(f.mean_radial_deviation_um, 3), three_digits(f.hysteresis_um, 3),
             shown ? fmt::format("{} {:.3g} {}", causes.front().name, causes.front().value,
                                 causes.front().unit)
                   : "nothing beyond noise"});
    }
    return r.planar.empty() ? std::string() : section_html("Circles", table_html(table));
}

std::string proof_section(const BallbarResult& r) {
    std::string body;
    if (r.true_tip)
        body += paragraph_html(fmt::format(
            "True error of the tip after compensation, which a simulator knows: {} µm with a tool "
            "as long as its offset says, {} µm at the cup as it hangs.",
            three_digits(r.true_tip->stated_um, 3), three_digits(r.true_tip->cup_um, 3)));
    if (r.sphere_check)
        body += paragraph_html(fmt::format(
            "A sphere and its probe took no part in the fit: {} poses are off by up to {} µm "
            "before and {} µm after.",
            r.sphere_check->poses, three_digits(r.sphere_check->before_um, 3),
            three_digits(r.sphere_check->after_um, 3)));
    body += paragraph_html(
        "The re-test uses the same bar and cup. A cup that is not where its offset says biases "
        "errors and re-test alike: a tool longer by 1 µm reads as 1 µm of the tilting axis's Z.");
    return section_html("Proof", body);
}

std::string reading_section(const BallbarResult& r) {
    return section_html(
        "How to read this",
        paragraph_html("u is one standard uncertainty, from the noise that the readings show. "
                       "\"As published\" is the evaluation of the 2015 paper; its difference is "
                       "the cosine error of the bar.") +
            paragraph_html("E, then X Y Z for a place or A B C for a tilt, then 0 and the axis: "
                           "EY0A is the place of the A axis along Y.") +
            paragraph_html(fmt::format(
                "Residual of the fit {} µm rms, noise {} µm.{}",
                three_digits(um_from_mm(r.fit.rms_mm), 3),
                three_digits(um_from_mm(r.fit.noise_mm), 3),
                r.simulated ? fmt::format(" The program takes {:.1f} min.", r.before.time_s / 60.0)
                            : "")));
}

}  // namespace

Page ballbar_page(const BallbarResult& r) {
    Page page;
    page.title = "Single-set-up ballbar test";
    page.subject =
        fmt::format("{}, {}, bar {:g} mm", r.machine, r.simulated ? "simulated" : "measured passes",
                    r.data.layout.length_mm);
    page.verdict = verdict(r);
    page.tone = r.verdict.structured ? Tone::bad : Tone::neutral;
    page.body_html = errors_section(r) + stores_section(r) + proof_section(r) + circles_section(r) +
                     plots_section(r) + reading_section(r);
    return page;
}

}  // namespace trunnion::report
