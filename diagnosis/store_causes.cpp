#include "diagnosis/store_causes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "diagnosis/rules/rules.h"
#include "diagnosis/stores/programmed_points.h"

namespace trunnion::diagnosis {
namespace {

using effects::EffectKind;

/// Mean squares, um^2: of the machine beyond its noise; of the control by the declared stores and
/// by those in force.
struct Excess {
    double machine = 0.0, control = 0.0, left = 0.0;
    double total() const { return machine + control + 1e-30; }
    /// For a shrink of the machine's part.
    double shrink(double of_machine) const {
        const double rest = std::pow(1.0 - of_machine, 2) * machine + left;
        return 1.0 - std::sqrt(rest / total());
    }
};

double beyond(double rms, double noise) {
    return std::max(0.0, rms * rms - noise * noise);
}

/// With and without the control's part; `machine` is what the machine's causes do held out.
HeldOut both(const HeldOut& machine, const Excess& excess) {
    HeldOut h = machine;
    h.rms_before_um = std::hypot(machine.rms_before_um, std::sqrt(excess.control));
    h.rms_after_um = std::hypot(machine.rms_after_um, std::sqrt(excess.left));
    h.shrink = excess.shrink(machine.shrink);
    h.low = excess.shrink(machine.low);
    h.high = excess.shrink(machine.high);
    return h;
}

std::string store_words(const std::vector<StoreChange>& changes,
                        std::optional<EffectKind> kind = {}) {
    std::string words;
    for (const StoreChange& c : changes)
        if (!kind || c.kind == *kind)
            words += fmt::format("{}{} is {:.4f} in force, {:.4f} in the setup",
                                 words.empty() ? "" : "; ", c.store.name,
                                 c.store.value_mm + c.change_mm, c.store.value_mm);
    return words;
}

/// Parameters as those of the effect: a tool that the control believes longer is shorter.
Cause cause_of(const StoreGap& gap, EffectKind kind) {
    Cause cause;
    cause.effect = effects::word_of(kind);
    // Never more certain than the places that were compared, as for any other cause.
    cause.probability = std::min((gap.places + 1.0) / (gap.places + 2.0),
                                 1.0 / (1.0 + static_cast<double>(gap.rivals.size())));
    for (const EffectKind rival : gap.rivals) cause.rivals.emplace_back(effects::word_of(rival));
    for (const StoreChange& c : gap.changes) {
        if (c.kind != kind) continue;
        const bool tool = c.store.place == tool_place;
        cause.parameters.push_back({cause.effect, parameter_of(c.store), "mm",
                                    tool ? -1 : c.store.component, 0.03,
                                    tool ? -c.change_mm : c.change_mm, c.sigma_mm});
    }
    cause.what = "The control commands other positions than the declared one: " +
                 store_words(gap.changes, kind);
    cause.usual_cause = "a store entered or measured again after the setup was written";
    cause.remedy = "enter the value of the setup, or declare the one in force (--out writes it)";
    return cause;
}

Cause unknown_positions() {
    Cause cause;
    cause.effect = "unknown";
    cause.known = false;
    cause.probability = 1.0;
    cause.what =
        "Positions of the table are not those of its programmed points, whatever the stores";
    return cause;
}

std::vector<Cause> causes_of(const StoreGap& gap, const Excess& excess) {
    double sum = 1e-30;  // no direction that was read may see them
    std::map<EffectKind, double> squares;
    for (const StoreChange& c : gap.changes) {
        squares[c.kind] += c.square_um2;
        sum += c.square_um2;
    }
    std::vector<Cause> list;
    for (const auto& [kind, square] : squares) {
        list.push_back(cause_of(gap, kind));
        list.back().share = (excess.control - excess.left) / excess.total() * square / sum;
        list.back().rms_sigma = 0.0;
    }
    if (!list.empty()) list.front().unseen = gap.unseen;
    if (excess.left > 0.2 * excess.total()) {
        list.push_back(unknown_positions());
        list.back().share = excess.left / excess.total();
    }
    return list;
}

Verdict verdict_with(const Diagnosis& d, const StoreGap& gap) {
    if (d.explained < rules::partly) return Verdict::unexplained;
    if (d.explained < rules::explained) return Verdict::partly_explained;
    return gap.rivals.empty() && d.verdict != Verdict::ambiguous ? Verdict::explained
                                                                 : Verdict::ambiguous;
}

void add_causes(const StoreGap& gap, const Excess& excess, const HeldOut& machine, Diagnosis& d) {
    const double part = excess.machine / excess.total();
    for (Cause& cause : d.causes) cause.share = cause.share * part;
    HeldOut alone = machine;
    alone.rms_after_um = alone.rms_before_um;
    alone.shrink = alone.low = alone.high = 0.0;
    for (Cause& cause : causes_of(gap, excess)) {
        cause.heldout = both(alone, excess);
        cause.rms_sigma =
            std::sqrt(cause.share * excess.total()) / std::max(1e-9, d.noise_um.value());
        d.causes.push_back(std::move(cause));
    }
    std::stable_sort(d.causes.begin(), d.causes.end(),
                     [](const Cause& a, const Cause& b) { return a.share > b.share; });
    for (DriverShare& share : d.where) share.share = share.share * part;
    std::vector<DriverShare> where = gap.where;
    for (DriverShare& share : where) share.share = share.share * (1.0 - part);
    d.where.insert(d.where.begin(), where.begin(), where.end());
}

void add_vector(const std::vector<double>& more, std::vector<double>& list) {
    for (std::size_t k = 0; k < std::min(list.size(), more.size()); ++k) list[k] += more[k];
}

}  // namespace

std::string words_of(const StoreGap& gap) {
    return gap.changes.empty() ? "no store explains the positions of these points"
                               : store_words(gap.changes);
}

void add_store_gap(const setup::Setup& setup, const StoreGap& gap,
                   const records::ReadingTable* holdout, Diagnosis& d) {
    const bool machine_gap = d.verdict != Verdict::no_gap;
    Excess excess{machine_gap ? beyond(d.rms_um, d.noise_um) : 0.0, mean_square_of(gap.before_um),
                  mean_square_of(gap.after_um)};
    HeldOut machine = d.after;
    if (!machine_gap) {
        machine.rms_before_um = machine.rms_after_um = d.rms_um;
        machine.noise_um = d.noise_um;
    }
    Excess out = excess;
    if (holdout) out.control = mean_square_of(points_um(setup, *holdout));
    if (holdout) out.left = mean_square_of(points_um(with_stores(setup, gap), *holdout));
    if (machine_gap) out.machine = beyond(machine.rms_before_um, machine.noise_um);
    add_causes(gap, excess, machine, d);
    d.after = both(machine, out);
    d.explained = std::clamp(
        1.0 - ((1.0 - d.explained) * excess.machine + excess.left) / excess.total(), 0.0, 1.0);
    d.unexplained_share = 1.0 - d.explained;
    d.verdict = verdict_with(d, gap);
    d.p_value = 0.0;
    d.rms_um = std::hypot(d.rms_um, std::sqrt(excess.control));
    d.after_rms_um = std::hypot(d.after_rms_um, std::sqrt(excess.left));
    d.excess_um = std::sqrt(excess.total());
    add_vector(gap.before_um, d.before_um);
    add_vector(gap.after_um, d.after_um);
    d.setup = with_stores(d.setup, gap);
}

}  // namespace trunnion::diagnosis
