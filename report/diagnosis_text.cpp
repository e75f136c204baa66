#include "report/diagnosis_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "report/diagnosis_words.h"
#include "report/error_table.h"
#include "report/parameters_json.h"

namespace trunnion::report {
namespace {

std::string cause_text(const diagnosis::Cause& cause) {
    std::string text = fmt::format("\n{}  {:.0f} % of the gap, probability {:.2f}\n", cause.effect,
                                   100 * cause.share, cause.probability);
    text += fmt::format("  {}.\n", cause.what);
    if (!cause.usual_cause.empty())
        text +=
            fmt::format("  Usual cause: {}. What to do: {}.\n", cause.usual_cause, cause.remedy);
    for (const identification::FitParameter& p : cause.parameters)
        text += fmt::format("  {:<20} {:>12.4g} {} {}\n", with_component(p), p.value, p.unit,
                            std::isfinite(p.sigma) ? fmt::format("(sigma {:.2g})", p.sigma)
                                                   : std::string("(no sigma of its own)"));
    for (const identification::Inseparable& group : cause.unseen)
        text += fmt::format("  no reading here sees: {}\n", to_string(group));
    if (!cause.points.empty())
        text += fmt::format("  a table of {} values{}\n{}", cause.points.size(),
                            cause.holds_between ? "" : ": at the measured places only",
                            error_table(cause));
    if (!cause.rivals.empty())
        text +=
            fmt::format("  cannot be told apart here from: {}\n", fmt::join(cause.rivals, ", "));
    text += fmt::format(
        "  held out: {:.3f} -> {:.3f} um (noise {:.3f}): shrinks by {:.0f} % ({:.0f} to {:.0f})\n",
        cause.heldout.rms_before_um, cause.heldout.rms_after_um, cause.heldout.noise_um,
        100 * cause.heldout.shrink, 100 * cause.heldout.low, 100 * cause.heldout.high);
    return text;
}

}  // namespace

std::string diagnosis_text(const diagnosis::Diagnosis& d) {
    std::string text = fmt::format("verdict: {}\n{}\n", to_string(d.verdict), verdict_sentence(d));
    text += fmt::format(
        "{} readings ({} set aside), rms {:.3f} um, noise {:.3f} um ({}), excess {:.3f} um\n",
        d.readings, d.outliers, d.rms_um, d.noise_um, to_string(d.noise.source), d.excess_um);
    for (const identification::FoundSide& s : d.sides) text += fmt::format("  {}\n", to_string(s));
    if (d.chosen_from > 0) text += fmt::format("  chosen evenly from {} readings\n", d.chosen_from);
    for (const diagnosis::DriverShare& w : d.where) text += fmt::format("  {}\n", w.text);
    for (const diagnosis::Cause& cause : d.causes) text += cause_text(cause);
    if (!d.causes.empty())
        text += fmt::format(
            "\nafter: rms {:.3f} um; of readings left out the causes explain {:.0f} %{}; the gap "
            "shrinks by {:.0f} % ({:.0f} to {:.0f})\n",
            d.after_rms_um, 100 * d.explained, d.between_places ? "" : " at the measured places",
            100 * d.after.shrink, 100 * d.after.low, 100 * d.after.high);
    if (d.causes.empty())
        for (const identification::Inseparable& group : d.inseparable)
            text += fmt::format("no reading here sees: {}\n", to_string(group));
    for (const diagnosis::NextMeasurement& next : d.next)
        text += fmt::format("next: {}\n", next.text);
    return text;
}

}  // namespace trunnion::report
