#include "report/pivot_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/rounded.h"
#include "base/units.h"
#include "report/pivot_pictures.h"

namespace trunnion::report {
namespace {

std::string stores_section(const PivotResult& r) {
    PageTable table{"",
                    {"number", "in force / mm", "to type / mm", "error / µm", "u / µm", "state"},
                    "lrrrrl",
                    {}};
    for (const pivot::StoreVerdict& s : r.verdict.stores) {
        const Rounded error = store_error(s);
        table.rows.push_back({store_name(r, s.in_force), decimal(s.in_force.value_mm, 4),
                              decimal(s.type_mm, 4), error.value, error.sigma,
                              s.stale ? "stale" : "right"});
    }
    std::string body = table_html(table);
    for (const pivot::GroupVerdict& g : r.verdict.groups)
        body += paragraph_html(fmt::format(
            "With these values entered (in steps of {:g} mm), {} functions are off by up to {}.",
            r.verdict.increment_mm, group_words(r, g.group), length_words(g.left_um)));
    if (r.verdict.groups.size() > 1)
        body += paragraph_html("All functions then agree" + agreement_words(r.verdict) + ".");
    if (r.hurco) body += paragraph_html("The field names of the part set-up are assumed.");
    return section_html("What to type", body);
}

double largest_error_mm(const pivot::PivotArc& arc) {
    double largest = 0.0;
    for (const pivot::PivotPoint& p : arc.points) largest = std::max(largest, p.error_mm.norm());
    return largest;
}

double largest_miss_mm(const pivot::PivotArc& arc) {
    double largest = 0.0;
    for (std::size_t i = 0; i < arc.points.size(); ++i)
        largest = std::max(largest, (arc.points[i].error_mm - arc.expected_mm[i]).norm());
    return largest;
}

PageTable maps_table(const PivotResult& r) {
    PageTable table{"Circle of each map, measured beside expected / µm",
                    {"map", "function", "store", "radius", "expected", "largest error",
                     "largest measured - expected"},
                    "lllrrrr",
                    {}};
    const int decimals = decimals_of_sigma(r.verdict.fit.noise_um);
    const auto um = [&](double value_mm) { return decimal(um_from_mm(value_mm), decimals); };
    for (const pivot::PivotMap& map : r.maps)
        for (const pivot::PivotArc& arc : map.arcs)
            table.rows.push_back({map.name, arc.function, group_words(r, arc.group),
                                  um(arc.circle.radius_mm()), um(arc.expected.radius_mm()),
                                  um(largest_error_mm(arc)), um(largest_miss_mm(arc))});
    return table;
}

std::string maps_section(const PivotResult& r) {
    const auto pictures = pivot_pictures(r);
    return section_html(
        "Maps: measured beside expected",
        figure_html(pictures.at("distances.svg"),
                    "Marks: measured distance from each map's mean. Lines: expected.") +
            figure_html(pictures.at("circles.svg"),
                        "Measured points with their circle and its centre. Dashed: expected.") +
            table_html(maps_table(r)));
}

std::string affected_section(const PivotResult& r) {
    PageTable table{"", {"what", "function", "codes", "off by up to / µm", "state"}, "lllrl", {}};
    for (const pivot::AffectedPart& part : r.affected)
        table.rows.push_back({part.path.empty() ? "all parts" : part.path, part.function,
                              pivot::codes_of(part.function, r.hurco),
                              three_digits(part.error_um, 3), part.stale ? "affected" : "right"});
    return section_html("Who is affected", table_html(table));
}

std::string unseen_section(const PivotResult& r) {
    std::string list;
    for (const std::string& line : r.verdict.unobservable) list += paragraph_html(line);
    return section_html("Not observable from these readings", list);
}

std::string reading_section(const PivotResult& r) {
    const pivot::PivotFit& fit = r.verdict.fit;
    return section_html(
        "How to read this",
        paragraph_html("The same sphere is found at many positions of the rotary axes, with each "
                       "positioning function. Found minus expected centre is the error. Functions "
                       "of one store have the same error; two stores that agree with the machine "
                       "give the same error too.") +
            paragraph_html(
                "The error of a store is the number in force minus the number with which "
                "its functions keep the tip on its point. u is its standard "
                "uncertainty.") +
            paragraph_html(fmt::format(
                "From these readings: one centre scatters by {} along an axis, {} zeroings "
                "of the sphere by {}. Expected is what the machine found from all readings "
                "leads to{}.",
                length_words(fit.noise_um), fit.zeroings, length_words(fit.zero_scatter_um),
                r.true_right ? "; in this simulation, what the machine of the setup leads to"
                             : "")));
}

}  // namespace

Page pivot_page(const PivotResult& r) {
    Page page;
    page.title = "Pivot stores";
    page.subject = r.machine + ", " + r.source;
    if (!r.date.empty()) page.subject += ", measured " + r.date;
    const bool stale = std::any_of(r.verdict.groups.begin(), r.verdict.groups.end(),
                                   [](const pivot::GroupVerdict& g) { return g.stale; });
    page.tone = stale ? Tone::bad : Tone::good;
    page.verdict = pivot::sentence(r.verdict, r.hurco);
    page.body_html = stores_section(r) + maps_section(r) + affected_section(r) + unseen_section(r) +
                     reading_section(r);
    return page;
}

}  // namespace trunnion::report
