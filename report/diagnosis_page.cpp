#include "report/diagnosis_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/svg.h"
#include "report/xml.h"

namespace trunnion {
namespace {

/// Horizontal bars, one a line, of shares 0..1.
std::string bars(const std::vector<std::pair<std::string, double>>& shares) {
    constexpr double line = 24.0, left = 230.0, width = 420.0;
    Svg svg(left + width + 60.0, line * static_cast<double>(shares.size()) + 8.0);
    double y = 6.0;
    for (std::size_t k = 0; k < shares.size(); ++k) {
        const auto& [name, share] = shares[k];
        const double length = width * std::clamp(share, 0.0, 1.0);
        SvgStyle fill;
        fill.stroke = "none";
        fill.fill = plot_colours[k % plot_colours.size()];
        svg.text({left - 8.0, y + 14.0}, name, 13, "end");
        svg.rectangle({left, y}, std::max(1.0, length), line - 8.0, fill);
        svg.text({left + length + 6.0, y + 13.0}, fmt::format("{:.0f} %", 100.0 * share), 12);
        y += line;
    }
    return svg.str();
}

/// RMS before and after on held-out readings, with the noise floor.
std::string before_after(const HeldOut& h) {
    if (h.rms_before_um <= 0.0) return "";
    constexpr double left = 230.0, width = 420.0;
    const double scale = width / h.rms_before_um;
    Svg svg(left + width + 90.0, 84.0);
    const std::pair<const char*, double> lines[] = {
        {"before", h.rms_before_um}, {"after", h.rms_after_um}, {"noise", h.noise_um}};
    double y = 6.0;
    for (const auto& [name, value] : lines) {
        SvgStyle fill;
        fill.stroke = "none";
        fill.fill = plot_colours[static_cast<std::size_t>(y) / 24 % plot_colours.size()];
        svg.text({left - 8.0, y + 14.0}, name, 13, "end");
        svg.rectangle({left, y}, std::max(1.0, value * scale), 16.0, fill);
        svg.text({left + value * scale + 6.0, y + 13.0}, fmt::format("{:.2f} um", value), 12);
        y += 24.0;
    }
    return svg.str();
}

std::string parameter_rows(const Cause& cause) {
    std::string text;
    for (const FitParameter& p : cause.parameters) {
        const char* component = p.component < 0    ? ""
                                : p.component == 0 ? " x"
                                : p.component == 1 ? " y"
                                                   : " z";
        text += fmt::format("<tr><td>{}{}</td><td>{:.4g}</td><td>{}</td><td>{}</td></tr>\n",
                            escape_xml(p.name), component, p.value,
                            std::isfinite(p.sigma) ? fmt::format("{:.2g}", p.sigma) : "-",
                            escape_xml(p.unit));
    }
    return text;
}

std::string cause_section(const Cause& cause) {
    std::string text =
        fmt::format("<h3>{} &ndash; {:.0f} % of the gap</h3>\n<p>{}.", escape_xml(cause.effect),
                    100.0 * cause.share, escape_xml(cause.what));
    if (!cause.usual_cause.empty())
        text += fmt::format(" Usual cause: {}. What to do: {}.", escape_xml(cause.usual_cause),
                            escape_xml(cause.remedy));
    text += "</p>\n";
    if (!cause.rivals.empty())
        text += fmt::format("<p class=\"rival\">These readings cannot tell it from: {}.</p>\n",
                            escape_xml(fmt::format("{}", fmt::join(cause.rivals, ", "))));
    if (cause.parameters.empty()) return text;
    text += "<table><tr><th>parameter</th><th>value</th><th>sigma</th><th>unit</th></tr>\n" +
            parameter_rows(cause) + "</table>\n";
    text += fmt::format(
        "<p>Alone on held-out readings: {:.2f} um before, {:.2f} um after, noise {:.2f} um: "
        "the gap shrinks by {:.0f} % ({:.0f} to {:.0f} %).</p>\n",
        cause.heldout.rms_before_um, cause.heldout.rms_after_um, cause.heldout.noise_um,
        100.0 * cause.heldout.shrink, 100.0 * cause.heldout.low, 100.0 * cause.heldout.high);
    return text;
}

const char* style =
    "body{font:15px/1.5 sans-serif;max-width:760px;margin:2em auto;color:#222}"
    "h1{font-size:1.5em}table{border-collapse:collapse}td,th{padding:2px 12px 2px "
    "0;text-align:left}"
    ".verdict{background:#f2f4f7;padding:.8em 1em;border-left:5px solid #0072b2}"
    ".rival{color:#a04000}pre{background:#f7f7f7;padding:.6em;overflow:auto;max-height:16em}";

}  // namespace

std::string verdict_sentence(const Diagnosis& d) {
    const std::string size = fmt::format("{:.2f} um rms, {:.2f} um of it noise ({})", d.rms_um,
                                         d.noise_um, to_string(d.noise.source));
    const std::string first = d.causes.empty() ? "" : d.causes.front().effect;
    switch (d.verdict) {
        case Verdict::no_gap:
            return "No gap beyond noise: " + size + ".";
        case Verdict::explained:
            return fmt::format("The gap is explained, most of it by {}: {}.", first, size);
        case Verdict::ambiguous:
            return fmt::format(
                "The gap is explained, but these readings cannot tell {} from its "
                "rivals: {}.",
                first, size);
        case Verdict::partly_explained:
            return fmt::format("The gap is explained in part: {}.", size);
        case Verdict::unexplained:
            return fmt::format("There is a gap that the catalogue does not explain: {}.", size);
    }
    return size;
}

std::string diagnosis_page(const Diagnosis& d, const std::string& title) {
    std::string text = fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{0}</title>"
        "<style>{1}</style></head><body>\n<h1>Simulation against reality: {0}</h1>\n"
        "<p class=\"verdict\">{2}</p>\n<p>{3} readings, {4} set aside as outliers.</p>\n",
        escape_xml(title), style, escape_xml(verdict_sentence(d)), d.readings, d.outliers);
    if (!d.causes.empty()) {
        std::vector<std::pair<std::string, double>> shares;
        for (const Cause& cause : d.causes) shares.emplace_back(cause.effect, cause.share);
        text += "<h2>Which effect</h2>\n" + bars(shares);
        for (const Cause& cause : d.causes) text += cause_section(cause);
        text +=
            "<h2>How far the gap shrinks</h2>\n<p>All causes together, on readings that took no "
            "part in the fit:</p>\n" +
            before_after(d.after);
        text += fmt::format("<p>The gap shrinks by {:.0f} % ({:.0f} to {:.0f} %).</p>\n",
                            100.0 * d.after.shrink, 100.0 * d.after.low, 100.0 * d.after.high);
    }
    if (!d.where.empty()) {
        text += "<h2>Where</h2>\n<ul>\n";
        for (const DriverShare& w : d.where) text += "<li>" + escape_xml(w.text) + "</li>\n";
        text += "</ul>\n";
    }
    if (!d.next.empty()) {
        text += "<h2>What to measure next</h2>\n";
        for (const NextMeasurement& next : d.next) {
            text += "<p>" + escape_xml(next.text) + "</p>\n";
            if (!next.program.empty())
                text += "<details><summary>NC program</summary><pre>" + escape_xml(next.program) +
                        "</pre></details>\n";
        }
    }
    if (!d.unseen.empty())
        text += fmt::format("<h2>Not to be seen in these readings</h2>\n<p>{}</p>\n",
                            escape_xml(fmt::format("{}", fmt::join(d.unseen, ", "))));
    return text + "</body></html>\n";
}

}  // namespace trunnion
