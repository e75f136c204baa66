#include "diagnosis/unknown_cause.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "diagnosis/prepare/outliers.h"
#include "diagnosis/reading_sizes.h"
#include "diagnosis/rules/rules.h"
#include "estimation/distributions.h"

namespace trunnion::diagnosis {
namespace {

/// True where the noise is assumed, and what is left of the readings follows nothing.
bool is_unstated_scatter(const Outcome& f, const Diagnosis& d) {
    return f.noise.model.source == NoiseSource::assumed && d.where.empty() &&
           f.model.members.empty();
}

/// True where what is left of successive readings of one test is correlated, as noise is not.
bool is_alike_in_time(const Outcome& f) {
    double product = 0.0, square = 0.0, pairs = 0.0;
    std::map<std::string, double> last;
    for (std::size_t i = 0; i < f.used.size(); ++i) {
        if (!f.used[i]) continue;
        const std::string& test = f.prepared.table.rows[f.prepared.replay.table_row(i)].test;
        const double left = f.judgement.left(static_cast<Eigen::Index>(i));
        square += left * left;
        if (const auto before = last.find(test); before != last.end()) {
            product += left * before->second;
            ++pairs;
        }
        last[test] = left;
    }
    return pairs > 2.0 && product * std::sqrt(pairs) > rules::alike * square;
}

/// True where no effect, position or time goes with a scatter beyond the noise that is stated.
bool is_scatter_beyond_stated(const Outcome& f, const Diagnosis& d) {
    return f.noise.model.source == NoiseSource::given && d.where.empty() &&
           f.model.members.empty() && !is_alike_in_time(f);
}

constexpr const char* alike_words =
    "Successive readings are off alike, as no noise is: something comes and goes with time that no "
    "effect of the catalogue does";
constexpr const char* near_words =
    "Readings at near places are off alike, as no noise is: an error follows the position in a "
    "shape that no effect of the catalogue has, or finer than places left out can confirm. More "
    "places would tell";
constexpr const char* scatter_words =
    "More scatter than is usual of the device, without structure: no effect, position or time goes "
    "with it. It may be noise, which nobody states here: give it in a column sigma_mm or in "
    "[model] of the setup, or repeat readings, and it is known";

constexpr const char* beyond_stated_words =
    "The readings scatter more than the noise that is stated, without structure: no effect, "
    "position or time goes with it. The noise is larger than stated, or probe, target or clamping "
    "are loose";

/// Probability that something is missing in the model. What left-out readings do not confirm may
/// also be what the others leave uncertain: then the residuals are no larger than that, within the
/// belief in the noise. The Bayes factor of a p-value is at most 1 / (-e p ln p) (Sellke, Bayarri
/// and Berger 2001); the prior is that of one more effect.
double probability_of_unknown(const Outcome& f) {
    const auto rows = static_cast<double>(std::count(f.used.begin(), f.used.end(), true));
    const LeftOut left(f.design, f.model, f.prepared.folds, f.used);
    const double spread = std::hypot(f.noise.prior.spread, 1.0 / std::sqrt(2.0 * rows));
    const double off = 0.5 * std::log(left.surprise() / rows) - f.noise.prior.log_mean;
    const double p = std::max(1e-300, estimation::normal_tail(off / spread));
    const double factor = p < std::exp(-1.0) ? -1.0 / (std::exp(1.0) * p * std::log(p)) : 1.0;
    const double odds = factor * std::exp(rules::effect_prior);
    return odds / (1.0 + odds);
}

/// What the causes leave, with the probability that it is more than noise and than what they leave
/// open.
Cause unknown_cause(const Outcome& f, const Diagnosis& d) {
    Cause cause;
    cause.effect = "unknown";
    cause.known = false;
    cause.share = d.unexplained_share;
    std::string places;
    for (std::size_t k = 0; k < f.model.members.size(); ++k) {
        const ColumnGroup& group = f.design.group(f.model.members[k]);
        if (group.kind != GroupKind::driver && !f.judgement.large[k]) continue;
        const double blocks = f.judgement.support[k].saving.blocks;
        const Instead instead = instead_of(f.design, f.model, k, blocks);
        cause.probability = std::max(cause.probability.value(), instead.probability);
        for (const std::string& rival : instead.rivals)
            if (std::find(cause.rivals.begin(), cause.rivals.end(), rival) == cause.rivals.end())
                cause.rivals.push_back(rival);
        places += fmt::format(": it {} ({})", group.text, group.component);
    }
    if (places.empty()) cause.probability = probability_of_unknown(f);
    if (are_spoiled(f.used, f.prepared.replay) && places.empty()) {
        // Laplace's rule of succession: that many were seen.
        const auto count = static_cast<double>(set_aside(f));
        cause.probability = std::max(cause.probability.value(), (count + 1.0) / (count + 2.0));
        const bool along_one = are_along_one(f.used, f.prepared.replay);
        cause.what = fmt::format(
            "{} of {} readings fit nothing and were set aside: {}. Take them again", set_aside(f),
            f.used.size(),
            along_one ? "most are along one direction, so the machine differs there rather than "
                        "that they are spoiled"
                      : "they are spoiled, or the machine differs there");
    } else if (f.judgement.only_scatter && places.empty()) {
        const auto count = static_cast<double>(f.used.size() - set_aside(f));
        cause.probability = std::max(cause.probability.value(), (count + 1.0) / (count + 2.0));
        cause.what = fmt::format(
            "Repeated readings scatter {:.0f} times as much as is stated of the device, and "
            "nothing "
            "beyond that is certain: the machine does not come back to the same place, or "
            "something "
            "disturbs the readings",
            f.judgement.scatter);
    } else if ((f.judgement.alike_near || f.judgement.alike_in_time) && places.empty()) {
        cause.probability = rules::sure;
        cause.what = f.judgement.alike_near ? near_words : alike_words;
    } else if (is_unstated_scatter(f, d) && places.empty()) {
        // Nobody states the noise: it may be that large as well as not.
        const bool follows_time = is_alike_in_time(f);
        cause.probability = follows_time ? rules::sure : 0.5;
        cause.what = follows_time ? alike_words : scatter_words;
    } else if (is_scatter_beyond_stated(f, d) && places.empty()) {
        cause.what = beyond_stated_words;
    } else if (places.empty() && cause.probability < 0.5)
        cause.what = "What left-out readings do not confirm, and the others leave open";
    else if (cause.rivals.empty())
        cause.what = "A gap with structure that no effect of the catalogue explains";
    else
        cause.what = "A gap with structure that need not be an effect of the catalogue";
    cause.what += places;
    cause.heldout = held_out(f, f.judgement.left_before, f.judgement.left_before);
    return cause;
}

}  // namespace

bool leaves_something(const Outcome& f, const Diagnosis& d) {
    return d.verdict == Verdict::unexplained || d.verdict == Verdict::partly_explained ||
           are_spoiled(f.used, f.prepared.replay);
}

std::string set_aside_words(const Outcome& f) {
    constexpr int most = 10;
    std::string words;
    int count = 0;
    for (std::size_t i = 0; i < f.used.size(); ++i) {
        if (f.used[i] || ++count > most) continue;
        const records::Reading& row = f.prepared.table.rows[f.prepared.replay.table_row(i)];
        words += fmt::format("{}{}", words.empty() ? "" : ", ", row.index);
        if (row.line > 0) words += fmt::format(" (line {})", row.line);
    }
    return "set aside, because they fit nothing: readings " + words + (count > most ? ", .." : "");
}

void add_unknown(const Outcome& f, Diagnosis& d) {
    Cause unknown = unknown_cause(f, d);
    const bool likely = unknown.probability >= rules::claimed;
    const auto at = std::find_if(d.causes.begin(), d.causes.end(),
                                 [&](const Cause& c) { return likely && c.share < unknown.share; });
    d.causes.insert(at, std::move(unknown));
}

}  // namespace trunnion::diagnosis
