#include "report/diagnosis_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "base/rounded.h"
#include "report/diagnosis_words.h"
#include "report/error_table.h"
#include "report/next_words.h"
#include "report/paragraph.h"
#include "report/session_changes.h"

namespace trunnion::report {
namespace {

/// Beside what a cause that is no better alone was claimed: other causes, or zeros that wander.
std::string no_better_words(const diagnosis::Diagnosis& d, const diagnosis::Cause& cause) {
    if (!cause.known || !is_claimed(cause)) return "no better by this alone\n";
    const bool others = std::any_of(d.causes.begin(), d.causes.end(), [&](const auto& other) {
        return &other != &cause && other.known && is_claimed(other);
    });
    const bool zeros = std::any_of(d.where.begin(), d.where.end(), [](const auto& place) {
        return place.by.starts_with("zero of ");
    });
    return fmt::format("no better by this alone{}\n",
                       others  ? ", only together with others"
                       : zeros ? ", only beside zeros that are free (above)"
                               : "");
}

/// In workshop units, with as many digits as the sigma supports.
std::string parameter_line(const identification::FitParameter& p) {
    const ShopValue v = shop_value(p);
    return std::isfinite(p.sigma)
               ? fmt::format("  {:<20} {:>10} ± {} {}\n", v.name, v.value, v.sigma, v.unit)
               : fmt::format("  {:<20} {:>10} {} (no sigma of its own)\n", v.name, v.value, v.unit);
}

std::string parameters_text(const std::vector<identification::FitParameter>& parameters) {
    std::string text;
    std::vector<std::string> unseen;
    for (const identification::FitParameter& p : parameters)
        if (p.value == 0.0 && !std::isfinite(p.sigma))
            unseen.push_back(shop_value(p).name);
        else
            text += parameter_line(p);
    if (!unseen.empty())
        text += paragraph(fmt::format("held at 0: {}", fmt::join(unseen, ", ")), 2);
    return text;
}

/// Sums of values that the readings do not determine; a long list of them tells nobody anything.
std::string unseen_text(const diagnosis::Cause& cause) {
    constexpr std::size_t most = 2;
    if (cause.unseen.size() > most)
        return paragraph(fmt::format("these readings do not determine its values one by one: {} "
                                     "sums of them are open (--json lists them)",
                                     cause.unseen.size()),
                         2);
    std::string text;
    for (const identification::Inseparable& group : cause.unseen)
        text += paragraph("not observable from these readings: " + to_string(group), 2);
    return text;
}

std::string cause_text(const diagnosis::Diagnosis& d, const diagnosis::Cause& cause) {
    std::string text = fmt::format("\n{}  {} % of the gap, probability {}\n", cause_name(d, cause),
                                   percent(cause.share), probability_words(cause.probability));
    text += paragraph(cause.what + ".", 2);
    if (!cause.usual_cause.empty() && !is_improbable(cause))
        text += paragraph("Usual cause: " + cause.usual_cause + ".", 2) +
                paragraph("What to do: " + cause.remedy + ".", 2);
    text += parameters_text(cause.parameters);
    if (is_sure_only_together(cause))
        text +=
            paragraph("none of these values is certain by itself, only what they do together", 2);
    text += unseen_text(cause);
    if (!cause.points.empty())
        text += fmt::format("  a table of {} values{}\n{}", cause.points.size(),
                            cause.holds_between ? "" : ": at the measured places only",
                            error_table(cause));
    else
        text += pitch_error_text(cause);
    if (!cause.rivals.empty())
        text +=
            paragraph(fmt::format("{}: {}", rivals_words(cause), fmt::join(cause.rivals, ", ")), 2);
    if (const std::string missing = missing_in_setup(d, cause); !missing.empty())
        text += paragraph(missing, 2);
    text += fmt::format(
        "  held out: {} -> {} (noise {}): ", size_words(d, cause.heldout.rms_before_um),
        size_words(d, cause.heldout.rms_after_um), size_words(d, cause.heldout.noise_um));
    if (cause.heldout.shrink >= 0.0)
        return text + fmt::format("shrinks by {} % ({})\n", percent(cause.heldout.shrink),
                                  interval_words(cause.heldout));
    return text + no_better_words(d, cause);
}

/// What is left with the causes, and with the setup that is written.
std::string after_text(const diagnosis::Diagnosis& d) {
    const bool any = std::any_of(d.causes.begin(), d.causes.end(), [](const auto& cause) {
        return cause.known && is_claimed(cause);
    });
    const std::string explained = fmt::format(
        "after: rms {}; of readings left out {} {} %{}; ", size_words(d, d.after_rms_um),
        any ? "the causes explain" : "what is listed explains", percent(d.explained),
        d.between_places ? "" : " at the measured places");
    const std::string shrink =
        fmt::format("shrinks by {} % ({})", percent(d.after.shrink), interval_words(d.after));
    const std::string background = background_words(d);
    return "\n" +
           paragraph(explained + (d.writes_causes ? "with the written setup the gap " + shrink
                                                  : "the written setup has none of them; with it "
                                                    "the gap " +
                                                        shrink),
                     0) +
           (background.empty() ? "" : paragraph(background, 0));
}

/// What the rows state of their noise, if more was found.
std::string added_words(const diagnosis::Diagnosis& d) {
    std::string words;
    for (const diagnosis::AddedNoise& a : d.added)
        words += fmt::format("; the rows of {} state {}, {} add to it", records::name_of(a.device),
                             size_words(d, a.stated_um), size_words(d, a.added_um));
    const diagnosis::DeviceNoise& point = d.noise.point;
    if (const double shared = point.shared + point.turned; shared > 0.0)
        words += fmt::format("; {} % of its variance belongs to whole stops of the axes",
                             percent(shared));
    return words;
}

}  // namespace

std::string diagnosis_text(const diagnosis::Diagnosis& d) {
    std::string text =
        fmt::format("verdict: {}\n", to_string(d.verdict)) + paragraph(verdict_sentence(d), 0);
    // Below what a gap needs, the rest is no statement: the size of the noise itself is uncertain.
    const std::string excess =
        d.verdict == diagnosis::Verdict::no_gap ? "" : ", excess " + size_words(d, d.excess_um);
    text += paragraph(fmt::format("{} readings ({} set aside), rms {}, noise {} ({}){}", d.readings,
                                  d.outliers, size_words(d, d.rms_um), size_words(d, d.noise_um),
                                  to_string(d.noise.source) + added_words(d), excess),
                      0);
    for (const std::string& sentence : d.set_up_words) text += paragraph(sentence, 2);
    for (const identification::FoundSide& s : d.sides) text += fmt::format("  {}\n", to_string(s));
    if (d.copies > 0)
        text += fmt::format("  {} more repeat the one before exactly: copies, which do not count\n",
                            d.copies);
    if (d.chosen_from > 0) text += fmt::format("  chosen evenly from {} readings\n", d.chosen_from);
    for (const diagnosis::DriverShare& w : d.where) text += fmt::format("  {}\n", w.text);
    for (const diagnosis::Cause& cause : d.causes) text += cause_text(d, cause);
    if (!d.causes.empty() && !is_only_spoiled(d) && !d.only_scatter) text += after_text(d);
    if (d.causes.empty())
        for (const identification::Inseparable& group : d.inseparable)
            text += paragraph("not observable from these readings: " + to_string(group), 0);
    text += changes_text(d);
    for (const PlannedMeasurement& next : planned_measurements(d))
        text += paragraph("next: " + next.text, 0);
    return text;
}

}  // namespace trunnion::report
