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

struct ShopUnit {
    const char *from, *to;
    double factor, below;  ///< factor for values below this limit
};

constexpr ShopUnit shop_units[] = {
    {"mm", "µm", 1e3, 1.0}, {"rad", "µrad", 1e6, 0.01}, {"s", "ms", 1e3, 0.1}};

/// "gap_rad" in rad becomes "gap"; vector components get their letter.
std::string plain_name(const identification::FitParameter& p) {
    std::string name = p.name;
    const std::string end = '_' + p.unit;
    // "cup.x_mm" and, of one session, "CMM.x_mm.monday"
    const std::size_t at = name.rfind(end);
    if (at != std::string::npos && at > 0 &&
        (at + end.size() == name.size() || name[at + end.size()] == '.'))
        name.erase(at, end.size());
    std::replace(name.begin(), name.end(), '_', ' ');
    return p.component < 0 ? name : fmt::format("{} {}", name, "xyz"[p.component]);
}

constexpr double improbable = 0.1;  ///< probability below which rivals are rather the cause

bool is_sure(const diagnosis::Diagnosis& d) {
    return !d.causes.empty() && is_claimed(d.causes.front());
}

/// True where the first cause has rivals and is itself improbable.
bool is_rather_a_rival(const diagnosis::Diagnosis& d) {
    return !d.causes.empty() && !d.causes.front().rivals.empty() &&
           d.causes.front().probability < improbable;
}

/// Before the name of the first cause.
std::string by_words(const diagnosis::Diagnosis& d) {
    if (!is_sure(d)) return "but by what is uncertain; most probably it is";
    if (d.causes.front().share >= 0.5) return "most of it by";
    return fmt::format("by {} effects, the largest of them", d.causes.size());
}

/// Name of the first cause that has rivals; empty if none has.
std::string rivalled(const diagnosis::Diagnosis& d) {
    for (const diagnosis::Cause& cause : d.causes)
        if (!cause.rivals.empty()) return cause_name(d, cause);
    return "";
}

std::string gap_words(const diagnosis::Diagnosis& d) {
    return fmt::format("{} rms, {} of it noise ({})", size_words(d, d.rms_um),
                       size_words(d, d.noise_um), to_string(d.noise.source));
}

/// Where the gap is nothing but the readings that were set aside.
std::string spoiled_words(const diagnosis::Diagnosis& d) {
    return fmt::format("{} of {} readings fit nothing and were set aside", d.outliers, d.readings);
}

std::string shrink_words(const diagnosis::Diagnosis& d) {
    return fmt::format(
        "With that in the simulation the gap beyond noise shrinks by {} % ({} to {} %) "
        "on readings that took no part in the fit{}.",
        percent(d.after.shrink), percent(d.after.low), percent(d.after.high),
        d.between_places ? "" : ", at the measured places");
}

std::string causes_words(const diagnosis::Diagnosis& d) {
    std::string text;
    for (const diagnosis::Cause& cause : d.causes) {
        if (!cause.known) continue;
        text += fmt::format("{}{} ({} %)", text.empty() ? "" : ", ", cause_name(d, cause),
                            percent(cause.share));
    }
    return text;
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
    const std::string form = alike > 1 && !cause.points.empty() ? " as a table" : "";
    return cause.effect + form + (cause.since.empty() ? "" : " since " + cause.since);
}

bool is_only_spoiled(const diagnosis::Diagnosis& d) {
    return d.verdict == diagnosis::Verdict::unexplained && d.outliers > 0 && d.excess_um <= 0.0;
}

const char* rivals_words(const diagnosis::Cause& cause) {
    return cause.probability < improbable ? "rather one of its rivals, or nothing"
                                          : "cannot be told apart here from";
}

std::string upper_first(std::string text) {
    if (!text.empty())
        text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
    return text;
}

ShopValue shop_value(const identification::FitParameter& p) {
    ShopValue v{plain_name(p), "", "–", p.unit == "1" ? "" : p.unit};
    double factor = 1.0;
    for (const ShopUnit& unit : shop_units)
        if (p.unit == unit.from && std::abs(p.value) < unit.below &&
            (std::isfinite(p.sigma) || p.value == 0.0 || p.unit != "s")) {
            factor = unit.factor;
            v.unit = unit.to;
        }
    const double value = factor * p.value, sigma = factor * p.sigma;
    const Rounded text = rounded(value, sigma);
    v.value = text.value;
    v.sigma = text.sigma;
    return v;
}

std::string main_size(const diagnosis::Cause& cause) {
    const identification::FitParameter* most = nullptr;
    const auto strength = [](const identification::FitParameter& p) {
        return std::isfinite(p.sigma) && p.sigma > 0.0 ? std::abs(p.value) / p.sigma : 0.0;
    };
    for (const identification::FitParameter& p : cause.parameters)
        if (!most || strength(p) > strength(*most)) most = &p;
    if (!most) return "–";
    const ShopValue v = shop_value(*most);
    return fmt::format("{} {} ± {} {}", v.name, v.value, v.sigma, v.unit);
}

std::string verdict_sentence(const diagnosis::Diagnosis& d) {
    const std::string size = gap_words(d);
    const std::string first = d.causes.empty() ? "" : cause_name(d, d.causes.front());
    const char* where = d.between_places ? "" : " at the measured places";
    switch (d.verdict) {
        case diagnosis::Verdict::no_gap: return "No gap beyond noise: " + size + ".";
        case diagnosis::Verdict::explained:
            return fmt::format("The gap is explained{}, {} {}: {}.", where, by_words(d), first,
                               size);
        case diagnosis::Verdict::ambiguous:
            if (is_rather_a_rival(d))
                return fmt::format(
                    "The gap is explained{}, rather by a rival of {} than by it: {}.", where, first,
                    size);
            if (rivalled(d) == first)
                return fmt::format(
                    "The gap is explained{}, but these readings cannot tell {} from its rivals: "
                    "{}.",
                    where, first, size);
            return fmt::format(
                "The gap is explained{}, {} {}, but these readings cannot tell {} from its "
                "rivals: {}.",
                where, by_words(d), first, rivalled(d), size);
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
    const std::string causes = causes_words(d);
    const std::string part = fmt::format("{} %", percent(d.explained));
    switch (d.verdict) {
        case diagnosis::Verdict::explained:
            return size + (is_sure(d) ? "The cause is " : "The cause is uncertain, perhaps ") +
                   causes + ". " + shrink_words(d);
        case diagnosis::Verdict::ambiguous:
            if (d.causes.size() < 2 && is_rather_a_rival(d))
                return size + "The cause is hardly " + causes + ", rather one of its rivals (" +
                       fmt::format("{}", fmt::join(d.causes.front().rivals, ", ")) + "). " +
                       shrink_words(d);
            if (d.causes.size() < 2)
                return size + "The cause is " + causes +
                       ", or another effect that these readings cannot tell from it: see below. " +
                       shrink_words(d);
            return size + "The causes are " + causes + "; these readings cannot tell " +
                   rivalled(d) + " from its rivals, see below. " + shrink_words(d);
        case diagnosis::Verdict::partly_explained:
            return size + part + " of it is explained: " + causes +
                   ". The rest has a structure that no known effect explains. ";
        default:
            return size + fmt::format(
                              "Known effects explain only {} of it on readings that took no part "
                              "in the fit{}",
                              part,
                              causes.empty() ? "." : "; part of it looks like " + causes + ".");
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
            return size +
                   "assumed: nothing was repeated, and the residual is larger or smaller than the "
                   "stated noise. Repeat some poses to confirm it.";
    }
    return size;
}

}  // namespace trunnion::report
