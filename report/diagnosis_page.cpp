#include "report/diagnosis_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/rounded.h"
#include "report/diagnosis_words.h"
#include "report/error_table.h"
#include "report/next_words.h"
#include "report/session_changes.h"
#include "report/svg.h"
#include "report/xml.h"

namespace trunnion::report {
namespace {

struct Bar {
    std::string name, value;
    double part = 0.0;  ///< fraction of the full width
    std::string colour;
};

constexpr double least_left = 190.0, bar_width = 420.0, bar_line = 26.0;

/// Width of the names in front of the bars.
double left_of(const std::vector<Bar>& list) {
    constexpr double letter = 7.2, margin = 20.0;
    double left = least_left;
    for (const Bar& bar : list)
        left = std::max(left, margin + letter * static_cast<double>(bar.name.size()));
    return left;
}

/// Horizontal bars, one a line, on an axis from 0 to `full` in `unit`.
std::string bars(const std::vector<Bar>& list, double full, const std::string& unit,
                 double dashed_at = -1.0, const std::string& dashed_text = "") {
    const bool dashed = dashed_at >= 0.0;
    const double bar_left = left_of(list);
    const double top = dashed ? 26.0 : 8.0;
    const double bottom = top + bar_line * static_cast<double>(list.size());
    Svg svg(bar_left + bar_width + 110.0, bottom + 44.0);
    svg.describe(upper_first(unit), "One bar for each line of the table.");
    const PlotRange range = round_range(0.0, full, 5);
    const double scale = bar_width / range.high;
    for (double tick = 0.0; tick <= range.high * 1.0001; tick += range.tick) {
        const double x = bar_left + tick * scale;
        svg.line({x, top}, {x, bottom}, {"#dddddd", 1.0, "none", ""});
        svg.text({x, bottom + 16.0}, fmt::format("{:.3g}", tick), {11, "middle", "#555"});
    }
    svg.text({bar_left + 0.5 * bar_width, bottom + 34.0}, unit, {12, "middle", "#555"});
    double y = top + 4.0;
    for (const Bar& bar : list) {
        const double length =
            std::max(1.0, scale * range.high * std::clamp(bar.part, 0.0, 1.0) * full / range.high);
        SvgStyle fill;
        fill.stroke = "none";
        fill.fill = bar.colour;
        svg.text({bar_left - 10.0, y + 13.0}, bar.name, {13, "end"});
        svg.rectangle({bar_left, y}, length, bar_line - 8.0, fill);
        svg.text({bar_left + length + 6.0, y + 13.0}, bar.value, 12);
        y += bar_line;
    }
    if (dashed) {
        const double x = bar_left + dashed_at * scale;
        svg.line({x, top - 8.0}, {x, bottom}, {"#444444", 1.2, "none", "4 3"});
        svg.text({x + 4.0, top - 12.0}, dashed_text, {11, "start", "#444"});
    }
    return svg.str();
}

/// Colour only for what is claimed.
std::string share_bars(const diagnosis::Diagnosis& d) {
    std::vector<Bar> list;
    for (std::size_t k = 0; k < d.causes.size(); ++k) {
        const diagnosis::Cause& cause = d.causes[k];
        const char* grey = cause.known ? "#d5d5d5" : "#999999";
        list.push_back(
            {cause_name(d, cause),
             fmt::format("{} %{}", percent(cause.share), is_claimed(cause) ? "" : ", not claimed"),
             cause.share,
             cause.known && is_claimed(cause) ? plot_colours[k % plot_colours.size()]
                                              : std::string(grey)});
    }
    return bars(list, 100.0, "share of the gap in %");
}

const char* unit_of(const diagnosis::Diagnosis& d) {
    return d.angles ? "µrad" : "µm";
}

std::string before_after(const diagnosis::Diagnosis& d, const diagnosis::HeldOut& h) {
    if (h.rms_before_um <= 0.0) return "";
    const std::vector<Bar> list{
        {"simulation as it is", size_words(d, h.rms_before_um), 1.0, "#d55e00"},
        {"with the written setup", size_words(d, h.rms_after_um), h.rms_after_um / h.rms_before_um,
         "#0072b2"}};
    return bars(list, h.rms_before_um,
                fmt::format("difference between machine and simulation, {} rms", unit_of(d)),
                h.noise_um, "noise " + size_words(d, h.noise_um));
}

/// Machine minus simulation of each reading, without and with what was found; the noise as a band.
std::string residual_plot(const diagnosis::Diagnosis& d) {
    const std::size_t n = d.before_um.size();
    if (n < 2) return "";
    std::vector<double> size;
    for (const double v : d.before_um) size.push_back(std::abs(v));
    std::sort(size.begin(), size.end());
    // A few outliers must not compress the picture; they are drawn at its edge.
    const double top = std::max(1.2 * size[(n - 1) * 995 / 1000], 3.0 * d.noise_um);
    const PlotRange x = round_range(0.0, static_cast<double>(n), 6), y = round_range(-top, top, 6);
    Svg svg(740.0, 330.0);
    svg.describe(
        "Machine minus simulation of each reading",
        fmt::format("In the order taken, in {}, without and with what was found; the noise as "
                    "a band.",
                    unit_of(d)));
    Plot plot(svg, {{64.0, 34.0}, 650.0, 230.0}, x, y);
    const Point2 high = plot.at(0.0, 2.0 * d.noise_um), low = plot.at(x.high, -2.0 * d.noise_um);
    svg.rectangle(high, low.x - high.x, low.y - high.y, {"none", 0.0, "#e8e8e8", ""});
    plot.frame("", "reading, in the order taken",
               fmt::format("machine - simulation, {}", unit_of(d)));
    const std::size_t step = std::max<std::size_t>(1, n / 1200);
    for (const bool after : {false, true})
        for (std::size_t i = 0; i < n; i += step) {
            const double v = after ? d.after_um[i] : d.before_um[i];
            svg.circle(plot.at(static_cast<double>(i), std::clamp(v, y.low, y.high)), 1.6,
                       {"none", 0.0, after ? "#0072b2" : "#d55e00", ""});
        }
    const auto key = [&](double at, const char* colour, const char* text) {
        svg.rectangle({at, 10.0}, 12.0, 12.0, {"none", 0.0, colour, ""});
        svg.text({at + 17.0, 20.0}, text, 12);
    };
    key(64.0, "#d55e00", "simulation as it is");
    key(230.0, "#0072b2", "with what was found");
    key(420.0, "#e8e8e8", "plus and minus two sigma of noise");
    return svg.str();
}

std::string row(const std::vector<std::string>& cells, const char* tag = "td") {
    std::string text = "<tr>";
    for (const std::string& cell : cells) text += fmt::format("<{0}>{1}</{0}>", tag, cell);
    return text + "</tr>\n";
}

std::string rivals_text(const diagnosis::Cause& cause) {
    return cause.rivals.empty() ? "none"
                                : escape_xml(fmt::format("{}", fmt::join(cause.rivals, ", ")));
}

/// A negative shrink says by no number how far the gap grows.
std::string alone_html(const diagnosis::HeldOut& heldout) {
    const std::string size =
        heldout.shrink < 0.0 ? "nothing alone" : percent(heldout.shrink) + " %";
    return size + "<br><span class=\"note\">95 %: " + interval_words(heldout, " %") + "</span>";
}

std::string cause_table(const diagnosis::Diagnosis& d) {
    std::string text = "<div class=\"scroll\" tabindex=\"0\"><table>\n" +
                       row({"Cause", "Probability", "Share of the gap", "Size", "Could also be",
                            "Alone it shrinks the gap by"},
                           "th");
    for (const diagnosis::Cause& cause : d.causes) {
        const bool known = cause.known;
        text += row({"<b>" + escape_xml(cause_name(d, cause)) + "</b><br><span class=\"note\">" +
                         escape_xml(cause.what) + "</span>",
                     escape_xml(probability_words(cause.probability)) +
                         (is_claimed(cause) ? "" : "<br><span class=\"note\">not claimed</span>"),
                     fmt::format("{} %", percent(cause.share)),
                     known ? escape_xml(main_size(cause)) : "&ndash;",
                     known ? rivals_text(cause) : "&ndash;",
                     known ? alone_html(cause.heldout) : "&ndash;"});
    }
    return text + "</table></div>\n";
}

/// "probability 0.11, not claimed"
std::string claim_words(const diagnosis::Cause& cause) {
    return "probability " + probability_words(cause.probability) +
           (is_claimed(cause) ? "" : ", not claimed");
}

std::string cause_heading(const diagnosis::Diagnosis& d, const diagnosis::Cause& cause) {
    const std::string missing = missing_in_setup(d, cause);
    return "<h3>" + escape_xml(cause_name(d, cause)) + "</h3>\n<p class=\"note\">" +
           escape_xml(upper_first(claim_words(cause))) + "." +
           (missing.empty() ? "" : " " + escape_xml(upper_first(missing)) + ".") + "</p>\n";
}

/// What the cause is, where it usually comes from, what to do, and what else it may be.
std::string cause_words(const diagnosis::Diagnosis& d, const diagnosis::Cause& cause) {
    std::string text = cause_heading(d, cause) + "<p>" + escape_xml(cause.what) + ".";
    if (!cause.usual_cause.empty() && !is_improbable(cause))
        text += " <b>Usual cause:</b> " + escape_xml(cause.usual_cause) + ".";
    if (!is_improbable(cause)) text += " <b>What to do:</b> " + escape_xml(cause.remedy) + ".";
    if (!cause.points.empty() && !cause.holds_between)
        text += " It holds at the measured places only.";
    text += "</p>\n";
    if (!cause.rivals.empty())
        text += fmt::format("<p class=\"bad-text\">{}: {}.</p>\n", upper_first(rivals_words(cause)),
                            rivals_text(cause));
    return text;
}

std::string free_form_section(const diagnosis::Diagnosis& d, const diagnosis::Cause& cause) {
    return fmt::format(
        "{}{}<details><summary>Table</summary><pre tabindex=\"0\">{}</pre></details>\n",
        cause_words(d, cause), error_curves(cause), escape_xml(error_table(cause)));
}

std::string cause_section(const diagnosis::Diagnosis& d, const diagnosis::Cause& cause) {
    if (!cause.points.empty()) return free_form_section(d, cause);
    if (!cause.known) return cause_heading(d, cause) + "<p>" + escape_xml(cause.what) + ".</p>\n";
    if (cause.parameters.empty()) return "";
    std::string text = cause_words(d, cause);
    text += "<div class=\"scroll\" tabindex=\"0\"><table>" +
            row({"Parameter", "Value", "&plusmn; 1 sigma", "Unit"}, "th");
    for (const identification::FitParameter& p : cause.parameters) {
        const ShopValue v = shop_value(p);
        text += row({escape_xml(v.name), v.value, v.sigma, escape_xml(v.unit)});
    }
    text += "</table></div>\n";
    if (const std::string data = pitch_error_text(cause); !data.empty())
        text += "<pre tabindex=\"0\">" + escape_xml(data) + "</pre>\n";
    for (const identification::Inseparable& group : cause.unseen)
        text += "<p class=\"note\">Not observable from these readings: " +
                escape_xml(to_string(group)) + ".</p>\n";
    return text;
}

std::string where_section(const diagnosis::Diagnosis& d) {
    if (d.where.empty()) return "";
    std::string text =
        "<h2>Where it shows</h2>\n<p>Each line is evaluated on its own. The lines overlap, because "
        "one cause appears in several of them. Only significant ones (p below 0.0001) are "
        "listed.</p>\n<ul>\n";
    for (const diagnosis::DriverShare& w : d.where)
        text += "<li>" + escape_xml(w.text) + ".</li>\n";
    return text + "</ul>\n";
}

std::string set_up_section(const diagnosis::Diagnosis& d) {
    if (d.set_up_words.empty()) return "";
    std::string text =
        "<h2>Set-up</h2>\n<p>Fitted beside the causes, no part of the gap.</p>\n<ul>\n";
    for (const std::string& sentence : d.set_up_words)
        text += "<li>" + escape_xml(upper_first(sentence)) + ".</li>\n";
    return text + "</ul>\n";
}

std::string next_section(const diagnosis::Diagnosis& d) {
    if (d.next.empty()) return "";
    std::string text = "<h2>What to measure next</h2>\n";
    for (const PlannedMeasurement& next : planned_measurements(d)) {
        text += "<p>" + escape_xml(upper_first(next.text)) + ".</p>\n";
        if (!next.program.empty())
            text += "<details><summary>NC program</summary><pre tabindex=\"0\">" +
                    escape_xml(next.program) + "</pre></details>\n";
    }
    return text;
}

std::string small_print(const diagnosis::Diagnosis& d) {
    std::string text = "<h2>How to read this</h2>\n<dl>\n";
    const auto entry = [&](const char* term, const std::string& meaning) {
        text += fmt::format("<dt>{}</dt><dd>{}</dd>\n", term, meaning);
    };
    entry("Gap", fmt::format("what the machine reads minus what its simulation reads, after set-up "
                             "and modelled errors were fitted: {} rms over {} readings.",
                             size_words(d, d.rms_um), d.readings));
    entry("Noise", noise_words(d));
    entry("Share",
          "fraction of the squared gap beyond noise that is due to this cause; independent of the "
          "order in which causes are added.");
    entry("Probability",
          "weight of the models with this cause against those without it or with another in its "
          "place. A cause below 0.5 is listed, but not claimed.");
    entry("Shrinks by",
          "reduction of the gap beyond noise on readings that took no part in the fit, with its 95 "
          "% interval.");
    if (d.outliers > 0)
        entry("Set aside", fmt::format("{} readings that fit nothing.", d.outliers));
    if (d.copies > 0)
        entry("Copies",
              fmt::format("{} more repeat the one before exactly and do not count.", d.copies));
    if (const auto unseen = unseen_effects(d); !unseen.empty())
        entry("Not to be seen here", escape_xml(fmt::format("{}", fmt::join(unseen, ", "))) + ".");
    return text + "</dl>\n";
}

/// The effects, and the reduction of the gap by all of them together.
std::string causes_section(const diagnosis::Diagnosis& d) {
    if (d.causes.empty() || is_only_spoiled(d) || d.only_scatter) return {};
    return section_html("Which effect",
                        figure_html(share_bars(d), "Part of the gap that each takes in the fit") +
                            cause_table(d)) +
           section_html(
               "How far the gap shrinks",
               paragraph_html("With the written setup, on readings that took no part in the fit.") +
                   figure_html(before_after(d, d.after), "Before and after") +
                   paragraph_html(fmt::format(
                       "{}Beyond noise the gap shrinks by {} % (95 %: {}).",
                       d.writes_causes ? ""
                                       : "The written setup has none of the causes: none of them "
                                         "helps on readings elsewhere. ",
                       percent(d.after.shrink), interval_words(d.after, " %"))) +
                   (d.background.empty()
                        ? ""
                        : paragraph_html(escape_xml(upper_first(background_words(d))) + ".")));
}

Tone tone_of(const diagnosis::Diagnosis& d) {
    if (d.verdict == diagnosis::Verdict::no_gap) return Tone::good;
    return d.verdict == diagnosis::Verdict::explained ? Tone::neutral : Tone::bad;
}

}  // namespace

Page diagnosis_page(const diagnosis::Diagnosis& d, const std::string& readings) {
    Page page;
    page.title = "Machine against simulation";
    page.subject = (d.setup.name.empty() ? std::string("machine without a name") : d.setup.name) +
                   "; readings " + readings;
    page.verdict = answer(d);
    page.tone = tone_of(d);
    page.body_html = causes_section(d) + changes_section(d);
    page.body_html += section_html(
        "All readings", figure_html(residual_plot(d), "Machine minus simulation of each reading"));
    page.body_html += where_section(d) + set_up_section(d) + next_section(d);
    if (!d.causes.empty()) page.body_html += "<h2>The causes one by one</h2>\n";
    for (const diagnosis::Cause& cause : d.causes) page.body_html += cause_section(d, cause);
    page.body_html += small_print(d);
    return page;
}

}  // namespace trunnion::report
