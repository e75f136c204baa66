#include "report/diagnosis_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/diagnosis_words.h"
#include "report/svg.h"
#include "report/xml.h"

namespace trunnion::report {
namespace {

struct Bar {
    std::string name, value;
    double part = 0.0;  ///< of the full width
    std::string colour;
};

constexpr double bar_left = 190.0, bar_width = 420.0, bar_line = 26.0;

/// Horizontal bars, one a line, over an axis from 0 to `full` in `unit`.
std::string bars(const std::vector<Bar>& list, double full, const std::string& unit,
                 double dashed_at = -1.0, const std::string& dashed_text = "") {
    const bool dashed = dashed_at >= 0.0;
    const double top = dashed ? 26.0 : 8.0;
    const double bottom = top + bar_line * static_cast<double>(list.size());
    Svg svg(bar_left + bar_width + 110.0, bottom + 44.0);
    const PlotRange range = round_range(0.0, full, 5);
    const double scale = bar_width / range.high;
    for (double tick = 0.0; tick <= range.high * 1.0001; tick += range.tick) {
        const double x = bar_left + tick * scale;
        svg.line({x, top}, {x, bottom}, {"#dddddd", 1.0, "none", ""});
        svg.text({x, bottom + 16.0}, fmt::format("{:.3g}", tick), 11, "middle", "#555");
    }
    svg.text({bar_left + 0.5 * bar_width, bottom + 34.0}, unit, 12, "middle", "#555");
    double y = top + 4.0;
    for (const Bar& bar : list) {
        const double length =
            std::max(1.0, scale * range.high * std::clamp(bar.part, 0.0, 1.0) * full / range.high);
        SvgStyle fill;
        fill.stroke = "none";
        fill.fill = bar.colour;
        svg.text({bar_left - 10.0, y + 13.0}, bar.name, 13, "end");
        svg.rectangle({bar_left, y}, length, bar_line - 8.0, fill);
        svg.text({bar_left + length + 6.0, y + 13.0}, bar.value, 12);
        y += bar_line;
    }
    if (dashed) {
        const double x = bar_left + dashed_at * scale;
        svg.line({x, top - 8.0}, {x, bottom}, {"#444444", 1.2, "none", "4 3"});
        svg.text({x + 4.0, top - 12.0}, dashed_text, 11, "start", "#444");
    }
    return svg.str();
}

std::string share_bars(const diagnosis::Diagnosis& d) {
    std::vector<Bar> list;
    for (std::size_t k = 0; k < d.causes.size(); ++k)
        list.push_back({d.causes[k].effect, fmt::format("{:.0f} %", 100.0 * d.causes[k].share),
                        d.causes[k].share,
                        d.causes[k].effect == "unknown" ? std::string("#999999")
                                                        : plot_colours[k % plot_colours.size()]});
    return bars(list, 100.0, "share of the gap in %");
}

std::string before_after(const diagnosis::HeldOut& h) {
    if (h.rms_before_um <= 0.0) return "";
    const std::vector<Bar> list{
        {"simulation as it is", fmt::format("{:.2f} µm", h.rms_before_um), 1.0, "#d55e00"},
        {"with the causes added", fmt::format("{:.2f} µm", h.rms_after_um),
         h.rms_after_um / h.rms_before_um, "#0072b2"}};
    return bars(list, h.rms_before_um, "difference between machine and simulation, µm rms",
                h.noise_um, fmt::format("noise {:.2f} µm", h.noise_um));
}

/// Machine minus simulation of each reading, without and with the causes; the noise as a band.
std::string residual_plot(const diagnosis::Diagnosis& d) {
    const std::size_t n = d.before_um.size();
    if (n < 2) return "";
    std::vector<double> size;
    for (const double v : d.before_um) size.push_back(std::abs(v));
    std::sort(size.begin(), size.end());
    // A few outliers must not flatten the picture: they are drawn at its edge.
    const double top = std::max(1.2 * size[(n - 1) * 995 / 1000], 3.0 * d.noise_um);
    const PlotRange x = round_range(0.0, static_cast<double>(n), 6), y = round_range(-top, top, 6);
    Svg svg(740.0, 330.0);
    Plot plot(svg, {64.0, 34.0}, 650.0, 230.0, x, y);
    const Point2 high = plot.at(0.0, 2.0 * d.noise_um), low = plot.at(x.high, -2.0 * d.noise_um);
    svg.rectangle(high, low.x - high.x, low.y - high.y, {"none", 0.0, "#e8e8e8", ""});
    plot.frame("", "reading, in the order taken", "machine - simulation, µm");
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
    key(230.0, "#0072b2", "with the causes added");
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

std::string cause_table(const diagnosis::Diagnosis& d) {
    std::string text =
        "<table class=\"wide\">\n" +
        row({"Cause", "Share of the gap", "Size", "Could also be", "Alone it shrinks the gap by"},
            "th");
    for (const diagnosis::Cause& cause : d.causes) {
        const bool known = cause.effect != "unknown";
        text += row({"<b>" + escape_xml(cause.effect) + "</b><br><span class=\"small\">" +
                         escape_xml(cause.what) + "</span>",
                     fmt::format("{:.0f} %", 100.0 * cause.share),
                     known ? escape_xml(main_size(cause)) : "&ndash;",
                     known ? rivals_text(cause) : "&ndash;",
                     known ? fmt::format("{:.0f} %<br><span class=\"small\">95 %: {:.0f} to "
                                         "{:.0f} %</span>",
                                         100.0 * cause.heldout.shrink, 100.0 * cause.heldout.low,
                                         100.0 * cause.heldout.high)
                           : "&ndash;"});
    }
    return text + "</table>\n";
}

std::string cause_section(const diagnosis::Cause& cause) {
    if (cause.parameters.empty()) return "";
    std::string text = fmt::format(
        "<h3>{}</h3>\n<p>{}. <b>Usual cause:</b> {}. <b>What to do:</b> "
        "{}.</p>\n",
        escape_xml(cause.effect), escape_xml(cause.what), escape_xml(cause.usual_cause),
        escape_xml(cause.remedy));
    if (!cause.rivals.empty())
        text += "<p class=\"rival\">These readings cannot tell it from: " + rivals_text(cause) +
                ".</p>\n";
    text += "<table>" + row({"Parameter", "Value", "&plusmn; 1 sigma", "Unit"}, "th");
    for (const identification::FitParameter& p : cause.parameters) {
        const ShopValue v = shop_value(p);
        text += row({escape_xml(v.name), v.value, v.sigma, escape_xml(v.unit)});
    }
    text += "</table>\n";
    for (const identification::Inseparable& group : cause.unseen)
        text +=
            "<p class=\"small\">No reading here sees this change: " + escape_xml(to_string(group)) +
            ".</p>\n";
    return text;
}

std::string where_section(const diagnosis::Diagnosis& d) {
    if (d.where.empty()) return "";
    std::string text =
        "<h2>Where it shows</h2>\n<p>Each line stands alone; they overlap, because one cause shows "
        "in several ways. Only what chance cannot make (p below 0.0001) is listed.</p>\n<ul>\n";
    for (const diagnosis::DriverShare& w : d.where)
        text += "<li>" + escape_xml(w.text) + ".</li>\n";
    return text + "</ul>\n";
}

std::string next_section(const diagnosis::Diagnosis& d) {
    if (d.next.empty()) return "";
    std::string text = "<h2>What to measure next</h2>\n";
    for (const diagnosis::NextMeasurement& next : d.next) {
        text += "<p>" + escape_xml(upper_first(next.text)) + ".</p>\n";
        if (!next.program.empty())
            text += "<details><summary>NC program</summary><pre>" + escape_xml(next.program) +
                    "</pre></details>\n";
    }
    return text;
}

std::string small_print(const diagnosis::Diagnosis& d) {
    std::string text = "<h2>How to read this</h2>\n<dl>\n";
    const auto entry = [&](const char* term, const std::string& meaning) {
        text += fmt::format("<dt>{}</dt><dd>{}</dd>\n", term, meaning);
    };
    entry("Gap", fmt::format("what the machine reads minus what its simulation reads, after set-up "
                             "and modelled errors were fitted: {:.2f} µm rms over {} readings.",
                             d.rms_um, d.readings));
    entry("Noise", noise_words(d));
    entry("Share",
          "part of the gap's square beyond noise that goes with this cause; "
          "it does not depend on the order in which causes are added.");
    entry("Shrinks by",
          "how much of the gap beyond noise is gone on readings that took no part in "
          "the fit, with its 95 % interval.");
    if (d.outliers > 0)
        entry("Set aside", fmt::format("{} readings that fit nothing.", d.outliers));
    if (!d.unseen.empty())
        entry("Not to be seen here",
              escape_xml(fmt::format("{}", fmt::join(d.unseen, ", "))) + ".");
    return text + "</dl>\n";
}

const char* style =
    "body{font:15px/1.5 system-ui,sans-serif;max-width:800px;margin:2em auto;padding:0 1em;"
    "color:#1d1d1d;background:#fff}h1{font-size:1.5em;margin-bottom:0}h2{font-size:1.2em;"
    "margin-top:1.8em;border-bottom:1px solid #ddd}h3{font-size:1.05em;margin-bottom:.2em}"
    ".from{color:#555;margin-top:.2em}table{border-collapse:collapse;margin:.6em 0}"
    "td,th{padding:4px 16px 4px 0;text-align:left;vertical-align:top;border-bottom:1px solid #eee}"
    "th{color:#555;font-weight:600}.wide{width:100%}.small{color:#555;font-size:.87em}"
    ".answer{background:#f2f6fa;padding:.9em 1.1em;border-left:5px solid #0072b2;font-size:1.07em}"
    ".rival{color:#a04000}pre{background:#f7f7f7;padding:.6em;overflow:auto;max-height:20em;"
    "font-size:.85em}dt{font-weight:600}dd{margin:0 0 .5em 1.2em}svg{max-width:100%;height:auto}"
    "@media print{body{margin:0;max-width:none}details{display:none}}";

}  // namespace

std::string diagnosis_page(const diagnosis::Diagnosis& d, const std::string& title) {
    std::string text = fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
        "<meta name=\"viewport\" content=\"width=device-width\"><title>Machine against simulation: "
        "{0}</title><style>{1}</style></head><body>\n<h1>Machine against simulation</h1>\n"
        "<p class=\"from\">{2}; readings {0}</p>\n<p class=\"answer\">{3}</p>\n",
        escape_xml(title), style,
        escape_xml(d.setup.name.empty() ? std::string("machine without a name") : d.setup.name),
        escape_xml(answer(d)));
    if (!d.causes.empty()) {
        text += "<h2>Which effect</h2>\n" + share_bars(d) + cause_table(d);
        text +=
            "<h2>How far the gap shrinks</h2>\n<p>All causes together, on readings that took no "
            "part in the fit.</p>\n" +
            before_after(d.after);
        text += fmt::format(
            "<p>Beyond noise the gap shrinks by <b>{:.0f} %</b> (95 %: {:.0f} to {:.0f} %).</p>\n",
            100.0 * d.after.shrink, 100.0 * d.after.low, 100.0 * d.after.high);
    }
    text += "<h2>All readings</h2>\n" + residual_plot(d);
    text += where_section(d) + next_section(d);
    if (!d.causes.empty()) text += "<h2>The causes one by one</h2>\n";
    for (const diagnosis::Cause& cause : d.causes) text += cause_section(cause);
    return text + small_print(d) + "</body></html>\n";
}

}  // namespace trunnion::report
