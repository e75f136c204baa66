#include "report/diagnosis_words.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "base/rounded.h"

namespace trunnion::report {
namespace {

constexpr double claimed_from = 0.5;  ///< probability of a cause

constexpr double improbable = 0.1;  ///< probability below which rivals are rather the cause

using Causes = std::vector<const diagnosis::Cause*>;

/// What may be said to be a cause; "unknown" is none.
Causes claimed_causes(const diagnosis::Diagnosis& d) {
    Causes list;
    for (const diagnosis::Cause& cause : d.causes)
        if (cause.known && is_claimed(cause)) list.push_back(&cause);
    return list;
}

/// True where the first cause has rivals and is itself improbable.
bool is_rather_a_rival(const diagnosis::Diagnosis& d) {
    return !d.causes.empty() && !d.causes.front().rivals.empty() &&
           d.causes.front().probability < improbable;
}

/// True where nothing is claimed, but the first cause has rivals.
bool is_one_of_rivals(const diagnosis::Diagnosis& d) {
    return !d.causes.empty() && !d.causes.front().rivals.empty() && !is_claimed(d.causes.front());
}

std::string with_probability(const diagnosis::Diagnosis& d, const diagnosis::Cause& cause) {
    return cause_name(d, cause) + " (probability " + probability_words(cause.probability) + ")";
}

/// Where nothing is claimed: the most probable of the listed causes.
std::string likeliest(const diagnosis::Diagnosis& d) {
    const auto most = std::max_element(
        d.causes.begin(), d.causes.end(),
        [](const auto& a, const auto& b) { return a.probability < b.probability; });
    return most == d.causes.end() ? "" : with_probability(d, *most);
}

/// By which causes the gap is explained.
std::string by_words(const diagnosis::Diagnosis& d) {
    const Causes causes = claimed_causes(d);
    if (causes.empty()) return "but by what is uncertain; the likeliest is " + likeliest(d);
    const std::string first = cause_name(d, *causes.front());
    if (causes.front()->share >= 0.5) return "most of it by " + first;
    if (causes.size() == 1) return "in part by " + first;
    return fmt::format("by {} effects, the largest of them {}", causes.size(), first);
}

/// Name of the first claimed cause that has rivals; empty if none has.
std::string rivalled(const diagnosis::Diagnosis& d) {
    for (const diagnosis::Cause* cause : claimed_causes(d))
        if (!cause->rivals.empty()) return cause_name(d, *cause);
    return "";
}

/// "; for the rest these readings cannot tell X.scale from its rivals", where no claimed cause has
/// any, but another one.
std::string open_rest(const diagnosis::Diagnosis& d) {
    if (claimed_causes(d).empty() || !rivalled(d).empty()) return "";
    for (const diagnosis::Cause& cause : d.causes)
        if (cause.known && !cause.rivals.empty())
            return "; for the rest these readings cannot tell " + cause_name(d, cause) +
                   " from its rivals";
    return "";
}

/// "EXX, EYX": the errors of its table.
std::string errors_of(const diagnosis::Cause& cause) {
    std::vector<std::string> names;
    for (const diagnosis::TablePoint& p : cause.points)
        if (std::find(names.begin(), names.end(), p.error) == names.end()) names.push_back(p.error);
    return fmt::format("{}", fmt::join(names, ", "));
}

/// What is stated, where the readings were taken to have another noise.
std::string stated_words(const diagnosis::Diagnosis& d) {
    return d.stated_um ? fmt::format("; stated {}", size_words(d, *d.stated_um)) : "";
}

std::string gap_words(const diagnosis::Diagnosis& d) {
    return fmt::format("{} rms, {} of it noise ({}{})", size_words(d, d.rms_um),
                       size_words(d, d.noise_um), to_string(d.noise.source), stated_words(d));
}

/// Where the gap is nothing but the readings that were set aside.
std::string spoiled_words(const diagnosis::Diagnosis& d) {
    return fmt::format("{} of {} readings fit nothing and were set aside", d.outliers, d.readings);
}

std::string shrink_words(const diagnosis::Diagnosis& d) {
    return fmt::format(
        "With the written setup{} the gap beyond noise shrinks by {} % ({}) on readings that took "
        "no part in the fit{}.",
        d.writes_causes ? "" : ", which has none of the causes,", percent(d.after.shrink),
        interval_words(d.after, " %"), d.between_places ? "" : ", at the measured places");
}

std::string claimed_words(const diagnosis::Diagnosis& d) {
    std::string text;
    for (const diagnosis::Cause* cause : claimed_causes(d))
        text += fmt::format("{}{} ({} %, probability {})", text.empty() ? "" : ", ",
                            cause_name(d, *cause), percent(cause->share),
                            probability_words(cause->probability));
    return text;
}

/// " Listed, but not claimed (probability below 0.5): J3.axial (0.11)."
std::string unclaimed_words(const diagnosis::Diagnosis& d) {
    std::string text;
    for (const diagnosis::Cause& cause : d.causes)
        if (cause.known && !is_claimed(cause))
            text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", cause_name(d, cause),
                                probability_words(cause.probability));
    return text.empty() ? "" : " Listed, but not claimed (probability below 0.5): " + text + ".";
}

/// The answer where the gap is explained.
std::string explained_words(const diagnosis::Diagnosis& d) {
    const Causes causes = claimed_causes(d);
    if (causes.empty() && is_one_of_rivals(d)) {
        const bool hardly = is_rather_a_rival(d);
        return fmt::format("{}{}, {}one of its rivals ({}).",
                           hardly ? "The cause is hardly " : "Its cause is uncertain: ",
                           with_probability(d, d.causes.front()), hardly ? "rather " : "or ",
                           fmt::join(d.causes.front().rivals, ", "));
    }
    if (causes.empty()) return "Its cause is uncertain: perhaps " + likeliest(d) + ".";
    const std::string of_rivals = rivalled(d);
    const char* begin = causes.size() == 1 ? "The cause is " : "The causes are ";
    return begin + claimed_words(d) +
           (of_rivals.empty()
                ? open_rest(d) + "."
                : "; these readings cannot tell " + of_rivals + " from its rivals, see below.");
}

/// Of a cause that is one harmonic of a turn, told by its cosine and sine alone: its order.
std::optional<std::string> single_order(const diagnosis::Cause& cause) {
    if (cause.parameters.size() != 2) return std::nullopt;
    const std::string &cosine = cause.parameters[0].name, &sine = cause.parameters[1].name;
    const std::size_t end = cosine.find('_');
    if (!cosine.starts_with("cos") || end == 3 || end == std::string::npos ||
        sine != "sin" + cosine.substr(3))
        return std::nullopt;
    return cosine.substr(3, end - 3);
}

}  // namespace

bool is_claimed(const diagnosis::Cause& cause) {
    return cause.probability >= claimed_from;
}

std::string size_words(const diagnosis::Diagnosis& d, double size) {
    return d.angles ? angle_words(size) : length_words(size);
}

std::string cause_name(const diagnosis::Diagnosis& d, const diagnosis::Cause& cause) {
    const auto alike = std::count_if(d.causes.begin(), d.causes.end(), [&](const auto& other) {
        return other.effect == cause.effect && other.since == cause.since;
    });
    const std::string since = cause.since.empty() ? "" : " since " + cause.since;
    if (const auto order = single_order(cause)) return cause.effect + " of order " + *order + since;
    if (alike < 2 || cause.points.empty()) return cause.effect + since;
    const bool other_table = std::any_of(d.causes.begin(), d.causes.end(), [&](const auto& other) {
        return &other != &cause && other.effect == cause.effect && !other.points.empty();
    });
    return cause.effect + (other_table ? " (" + errors_of(cause) + ')' : " as a table") + since;
}

std::string missing_in_setup(const diagnosis::Diagnosis& d, const diagnosis::Cause& cause) {
    if (!d.writes_causes || cause.written || !cause.known || !is_claimed(cause)) return "";
    return "not in the written setup (--out): these readings do not show that it predicts others";
}

std::string background_words(const diagnosis::Diagnosis& d) {
    if (d.background.empty()) return "";
    return fmt::format(
        "beside the causes the written setup has small errors, none of them certain, which "
        "together predict readings that were left out: {}",
        fmt::join(d.background, ", "));
}

std::vector<std::string> unseen_effects(const diagnosis::Diagnosis& d) {
    const auto is_named = [&](const std::string& name) {
        return std::any_of(d.causes.begin(), d.causes.end(), [&](const auto& cause) {
            return cause.effect == name ||
                   std::find(cause.rivals.begin(), cause.rivals.end(), name) != cause.rivals.end();
        });
    };
    std::vector<std::string> list;
    for (const std::string& name : d.unseen)
        if (!is_named(name)) list.push_back(name);
    return list;
}

bool is_sure_only_together(const diagnosis::Cause& cause) {
    constexpr double certain = 2.0;  ///< in sigma
    std::size_t measured = 0;
    for (const identification::FitParameter& p : cause.parameters) {
        if (!std::isfinite(p.sigma) || p.value == 0.0) continue;
        if (std::abs(p.value) > certain * p.sigma) return false;
        ++measured;
    }
    return is_claimed(cause) && measured > 1;
}

std::string interval_words(const diagnosis::HeldOut& heldout, const char* unit) {
    if (heldout.high < -1.0) return "it rather grows to more than twice its size";
    if (heldout.low < -1.0)
        return fmt::format("at most {}{}; it may also grow to more than twice its size",
                           percent(heldout.high), unit);
    return fmt::format("{} to {}{}", percent(heldout.low), percent(heldout.high), unit);
}

bool is_only_spoiled(const diagnosis::Diagnosis& d) {
    return d.verdict == diagnosis::Verdict::unexplained && d.outliers > 0 && d.excess_um <= 0.0;
}

bool is_improbable(const diagnosis::Cause& cause) {
    return cause.probability < improbable;
}

const char* rivals_words(const diagnosis::Cause& cause) {
    return is_improbable(cause) ? "rather one of its rivals, or nothing"
                                : "cannot be told apart here from";
}

std::string upper_first(std::string text) {
    if (!text.empty())
        text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
    return text;
}

std::string verdict_sentence(const diagnosis::Diagnosis& d) {
    const std::string size = gap_words(d);
    const std::string of_rivals = rivalled(d);
    const char* where = d.between_places ? "" : " at the measured places";
    switch (d.verdict) {
        case diagnosis::Verdict::no_gap: return "No gap beyond noise: " + size + ".";
        case diagnosis::Verdict::ambiguous:
            if (is_rather_a_rival(d))
                return fmt::format(
                    "The gap is explained{}, rather by a rival of {} than by it: {}.", where,
                    cause_name(d, d.causes.front()), size);
            if (is_one_of_rivals(d) ||
                (!of_rivals.empty() && of_rivals == cause_name(d, d.causes.front())))
                return fmt::format(
                    "The gap is explained{}, but these readings cannot tell {} from its rivals: "
                    "{}.",
                    where, is_one_of_rivals(d) ? with_probability(d, d.causes.front()) : of_rivals,
                    size);
            if (!of_rivals.empty())
                return fmt::format(
                    "The gap is explained{}, {}, but these readings cannot tell {} from its "
                    "rivals: {}.",
                    where, by_words(d), of_rivals, size);
            return fmt::format("The gap is explained{}, {}{}: {}.", where, by_words(d),
                               open_rest(d), size);
        case diagnosis::Verdict::explained:
            return fmt::format("The gap is explained{}, {}: {}.", where, by_words(d), size);
        case diagnosis::Verdict::partly_explained:
            return fmt::format("The gap is explained in part: {}.", size);
        case diagnosis::Verdict::unexplained:
            if (is_only_spoiled(d))
                return fmt::format("{}; the others show no gap beyond noise: {}.", spoiled_words(d),
                                   size);
            if (d.only_scatter)
                return fmt::format(
                    "Repeated readings differ more than is stated; nothing beyond that is certain: "
                    "{}.",
                    size);
            return fmt::format("There is a gap that the catalogue does not explain: {}.", size);
    }
    return size;
}

std::string answer(const diagnosis::Diagnosis& d) {
    if (d.verdict == diagnosis::Verdict::no_gap)
        return fmt::format(
            "No gap. Machine and simulation differ by {} rms, and noise alone makes {}.",
            size_words(d, d.rms_um), size_words(d, d.noise_um));
    if (is_only_spoiled(d))
        return fmt::format(
            "{}. The others differ from the simulation by {} rms, and noise alone makes {}.",
            spoiled_words(d), size_words(d, d.rms_um), size_words(d, d.noise_um));
    if (d.only_scatter)
        return fmt::format(
            "Repeated readings differ more than is stated of the device: {} rms. Nothing beyond "
            "that is certain.",
            size_words(d, d.noise_um));
    const std::string size =
        fmt::format("Machine and simulation differ by {} rms; noise alone would make {}. ",
                    size_words(d, d.rms_um), size_words(d, d.noise_um));
    const std::string claimed = claimed_words(d);
    const std::string part = fmt::format("{} %", percent(d.explained));
    switch (d.verdict) {
        case diagnosis::Verdict::explained:
        case diagnosis::Verdict::ambiguous:
            return size + explained_words(d) +
                   (claimed.empty() && d.causes.size() == 1 ? "" : unclaimed_words(d)) + ' ' +
                   shrink_words(d);
        case diagnosis::Verdict::partly_explained:
            return size +
                   (claimed.empty()
                        ? part + " of it is explained, but by what is uncertain."
                        : part + " of it is explained. The causes claimed are " + claimed + ".") +
                   " The rest has a structure that no known effect explains." + unclaimed_words(d);
        default:
            return size +
                   (claimed.empty()
                        ? "No known effect is claimed as its cause."
                        : "Known effects explain only " + part +
                              " of it on readings that took no part in the fit; part of it looks "
                              "like " +
                              claimed + ".") +
                   unclaimed_words(d);
    }
}

std::string noise_words(const diagnosis::Diagnosis& d) {
    const std::string size = size_words(d, d.noise_um) + " rms, ";
    switch (d.noise.source) {
        case diagnosis::NoiseSource::repeats:
            return size + "measured from poses and passes that were repeated.";
        case diagnosis::NoiseSource::given:
            return size + "as the setup states it; nothing was repeated to check it.";
        case diagnosis::NoiseSource::assumed:
            if (const double shared = d.noise.point.shared + d.noise.point.turned; shared > 0.0)
                return size +
                       fmt::format("{} % of its variance belongs to whole stops of the axes.",
                                   percent(shared));
            if (!d.added.empty())
                return size + fmt::format("more than the rows state: {} adds to it.",
                                          size_words(d, d.added.front().added_um));
            return size +
                   "assumed: nothing was repeated, and the residual is larger or smaller than the "
                   "stated noise. Repeat some poses to confirm it.";
    }
    return size;
}

}  // namespace trunnion::report
