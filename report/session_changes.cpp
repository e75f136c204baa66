#include "report/session_changes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/rounded.h"
#include "report/diagnosis_words.h"
#include "report/page.h"
#include "report/paragraph.h"
#include "report/svg.h"

namespace trunnion::report {
namespace {

/// A change in workshop units and digits.
struct ShopChange {
    std::string name, before, after, change, sigma, unit;
};

ShopChange shop_change(const diagnosis::SessionChange& c) {
    const bool mm = c.parameter.unit == "mm", rad = c.parameter.unit == "rad";
    const double factor = mm ? 1e3 : rad ? 1e6 : 1.0;
    const bool seen = std::isfinite(c.parameter.sigma) && c.parameter.sigma > 0.0;
    const int decimals = decimals_of_sigma(factor * c.parameter.sigma);
    const auto number = [&](double value) { return decimal(factor * value, decimals); };
    ShopChange s{c.parameter.effect + " " + shop_value(c.parameter).name,
                 number(c.before),
                 "–",
                 "–",
                 "not seen",
                 mm    ? "µm"
                 : rad ? "µrad"
                       : c.parameter.unit};
    if (!seen) return s;
    s.after = number(c.before + c.parameter.value);
    s.change = (c.parameter.value > 0.0 ? "+" : "") + number(c.parameter.value);
    s.sigma = number(c.parameter.sigma);
    return s;
}

double in_sigma(const diagnosis::SessionChange& c) {
    const double sigma = c.parameter.sigma;
    return std::isfinite(sigma) && sigma > 0.0 ? c.parameter.value / sigma : 0.0;
}

/// 0: a claimed change, 1: part of a cause that is not claimed, 2: of none.
std::size_t rank_of(const diagnosis::SessionChange& c) {
    return c.claimed ? 0 : c.probability > 0.0 ? 1 : 2;
}

/// Causes first, then in the given order.
std::vector<const diagnosis::SessionChange*> in_order(const diagnosis::Diagnosis& d) {
    std::vector<const diagnosis::SessionChange*> list;
    for (const diagnosis::SessionChange& c : d.changes) list.push_back(&c);
    std::stable_sort(list.begin(), list.end(),
                     [](const auto* a, const auto* b) { return rank_of(*a) < rank_of(*b); });
    return list;
}

/// The changes among the causes, with their probability: the claimed ones, or the others.
std::string names_of(const diagnosis::Diagnosis& d, bool claimed) {
    std::string names;
    for (const diagnosis::Cause& cause : d.causes)
        if (!cause.since.empty() && is_claimed(cause) == claimed)
            names += fmt::format("{}{} (probability {})", names.empty() ? "" : ", ",
                                 cause_name(d, cause), probability_words(cause.probability));
    return names;
}

std::string sentence(const diagnosis::Diagnosis& d) {
    const std::string claimed = names_of(d, true), others = names_of(d, false);
    if (!claimed.empty()) return "Between the sessions the machine changed: " + claimed + ".";
    if (!others.empty())
        return "No single change of the machine between the sessions is certain: perhaps it is " +
               others +
               ", perhaps something else; the uncertainty of such a change holds only if it is the "
               "cause.";
    if (d.verdict == diagnosis::Verdict::unexplained)
        return "No change of the catalogue's effects between the sessions is found; part of the "
               "gap has no explanation.";
    return "No change of the machine between the sessions is found.";
}

/// Every observable change, divided by its sigma.
std::string picture(const std::vector<const diagnosis::SessionChange*>& list) {
    double most = 4.0;
    for (const diagnosis::SessionChange* c : list) most = std::max(most, std::abs(in_sigma(*c)));
    const PlotRange x = round_range(-most, most, 6);
    constexpr double left = 270.0, width = 400.0, line = 20.0, top = 10.0;
    const double bottom = top + line * static_cast<double>(list.size());
    Svg svg(left + width + 30.0, bottom + 44.0);
    svg.describe("Change of each parameter over its uncertainty",
                 "One mark for each line of the table; the band is two sigma.");
    const auto at = [&](double value) { return left + width * (value - x.low) / (x.high - x.low); };
    svg.rectangle({at(-2.0), top}, at(2.0) - at(-2.0), bottom - top, {"none", 0.0, "#e8e8e8", ""});
    for (double tick = x.low; tick <= x.high + 0.01 * x.tick; tick += x.tick) {
        svg.line({at(tick), top}, {at(tick), bottom}, {"#dddddd", 1.0, "none", ""});
        svg.text({at(tick), bottom + 16.0}, fmt::format("{:.4g}", tick), {11, "middle", "#555"});
    }
    svg.text({left + 0.5 * width, bottom + 34.0}, "change over its sigma", {12, "middle", "#555"});
    double y = top + 0.5 * line;
    for (const diagnosis::SessionChange* c : list) {
        svg.text({left - 10.0, y + 4.0}, shop_change(*c).name, {12, "end"});
        svg.mark({at(in_sigma(*c)), y}, c->claimed ? 1 : 0, c->claimed ? "#d55e00" : "#0072b2");
        y += line;
    }
    return svg.str();
}

}  // namespace

std::string changes_text(const diagnosis::Diagnosis& d) {
    if (d.sessions.empty()) return {};
    std::string text = "\n" + paragraph(sentence(d), 0);
    for (const diagnosis::SessionFit& s : d.sessions)
        text += fmt::format("  {:<12} {} readings, rms {} -> {}\n", s.name, s.readings,
                            size_words(d, s.rms_before_um), size_words(d, s.rms_after_um));
    text += fmt::format("  {:<24} {:<8} {:>8} {:>8} {:>8} {:>7}\n", "parameter", "since", "before",
                        "after", "change", "sigma");
    for (const diagnosis::SessionChange* c : in_order(d)) {
        const ShopChange s = shop_change(*c);
        text += fmt::format("{} {:<24} {:<8} {:>8} {:>8} {:>8} {:>7} {}\n", "*? "[rank_of(*c)],
                            s.name, c->since, s.before, s.after, s.change, s.sigma, s.unit);
    }
    return text;
}

std::string changes_section(const diagnosis::Diagnosis& d) {
    if (d.sessions.empty()) return {};
    PageTable sessions{"The sessions, in the order taken",
                       {"Session", "Readings", "rms as it is, µm", "rms with the causes, µm"},
                       "lrrr",
                       {}};
    for (const diagnosis::SessionFit& s : d.sessions)
        sessions.rows.push_back({s.name, std::to_string(s.readings),
                                 three_digits(s.rms_before_um, 3),
                                 three_digits(s.rms_after_um, 3)});
    PageTable changes{
        "Each parameter from one session to the next; claimed changes first",
        {"Parameter", "Since", "Before", "After", "Change", "1 sigma", "Unit", "Claim"},
        "llrrrrll",
        {}};
    const auto list = in_order(d);
    for (const diagnosis::SessionChange* c : list) {
        const ShopChange s = shop_change(*c);
        changes.rows.push_back({s.name, c->since, s.before, s.after, s.change, s.sigma, s.unit,
                                std::array{"changed", "perhaps", "none"}[rank_of(*c)]});
    }
    return section_html(
        "What changed between the sessions",
        paragraph_html(sentence(d)) + table_html(sessions) +
            (list.empty() ? "" : figure_html(picture(list), "Change over its uncertainty")) +
            table_html(changes));
}

}  // namespace trunnion::report
