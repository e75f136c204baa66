// From the chosen set to the verdict: size, where, claims, the setup with the effects added.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "diagnosis/diagnoser.h"
#include "diagnosis/rules.h"
#include "diagnosis/statistics.h"

namespace trunnion {
namespace {

/// Log evidence of an unknown cause that follows a driver, against noise alone: Laplace, with the
/// prior size that suits the data best, and the prior of an effect.
double evidence_of(const DriverTest& t) {
    const double q = t.columns;
    const double size = std::max(1.0, t.gain / q);  // prior variance over the estimate's, plus 1
    return 0.5 * t.gain * (1.0 - 1.0 / size) - 0.5 * q * std::log(size) + rules::effect_prior;
}

/// Of an interval of the shrink: draws go along derivatives, but readings bend, and what is
/// compared is another fit of the base.
constexpr double least_half_width = 0.01;

}  // namespace

/// Held-out readings come closer with the chosen set: effects that explain only the readings they
/// were fitted to (a spike on one of them) explain nothing.
bool Diagnoser::holds_elsewhere() const {
    const HeldOut out =
        cross_validate(*design_, base_, folds_, set_.members, set_.scale, noise_mm(), used_);
    return out.shrink > rules::least_heldout;
}

void Diagnoser::judge() {
    Remainder r = remainder();
    if (!set_.members.empty() && r.unexplained < rules::admit_share * r.gap && !holds_elsewhere()) {
        set_ = EffectSet{};
        r = remainder();
    }
    describe_size(r);
    if (set_.members.empty() && r.unexplained == 0.0) {
        result_.verdict = Verdict::no_gap;
        write_setup();
        return;
    }
    describe_where();
    result_.unexplained_share = std::clamp(r.unexplained / r.gap, 0.0, 1.0);
    if (!set_.members.empty()) claim(r.gap);
    double explained = std::clamp(1.0 - r.unexplained / r.gap, 0.0, 1.0);
    if (coincidence()) explained = std::min(explained, result_.causes.front().share);
    if (unknown_belief_ > rules::unknown_belief) explained = std::min(explained, 0.49);
    result_.unexplained_share = 1.0 - explained;
    const bool rivalled = std::any_of(result_.causes.begin(), result_.causes.end(),
                                      [](const Cause& c) { return !c.rivals.empty(); });
    result_.verdict = explained >= 0.8   ? (rivalled ? Verdict::ambiguous : Verdict::explained)
                      : explained >= 0.5 ? Verdict::partly_explained
                                         : Verdict::unexplained;
    if (result_.unexplained_share > rules::admit_share || r.plain)
        add_unknown(result_.unexplained_share, r.drivers);
    if (set_.members.empty()) {
        result_.after = cross_validate(*design_, base_, folds_, {}, 1.0, noise_mm(), used_);
        result_.after.low -= least_half_width;
        result_.after.high += least_half_width;
    }
    write_setup();
    if (options_.holdout) test_holdout();
    if (options_.plan_next) ask_next();
}

void Diagnoser::describe_size(const Remainder& r) {
    result_.readings = replay_.size();
    result_.outliers = static_cast<std::size_t>(std::count(used_.begin(), used_.end(), false));
    result_.noise = noise_;
    result_.rms_um = rms_um(base_.residual_mm);
    result_.noise_um = rms_um(noise_mm());
    result_.excess_um = std::sqrt(
        std::max(0.0, result_.rms_um * result_.rms_um - result_.noise_um * result_.noise_um));
    const Eigen::VectorXd left_mm = left_after(set_);
    result_.after_rms_um = rms_um(left_mm);
    for (Eigen::Index i = 0; i < left_mm.size(); ++i) {
        result_.before_um.push_back(1e3 * base_.residual_mm(i));
        result_.after_um.push_back(1e3 * left_mm(i));
    }
    result_.inseparable = base_.inseparable;
    for (const Candidate& c : design_->candidates())
        if (c.visible && c.effect->name.starts_with("pivot."))
            for (Inseparable& group : unseen_of(c)) result_.inseparable.push_back(std::move(group));
    for (const Candidate& c : design_->candidates())
        if (!c.visible && std::find(result_.unseen.begin(), result_.unseen.end(), c.effect->name) ==
                              result_.unseen.end())
            result_.unseen.push_back(c.effect->name);
    const auto width = static_cast<double>(columns_of(*design_, set_.members).size());
    result_.p_value =
        set_.members.empty()
            ? (r.drivers.empty() ? 1.0 : r.drivers.front().p_value)
            : std::min(1.0, rules::effects_tried * chi_squared_tail(set_.explained, width));
}

void Diagnoser::describe_where() {
    const auto tests = test_drivers(replay_, table_, base_, known_columns({}), base_.residual_mm,
                                    base_.sigma_mm, used_, *whitener_);
    const double gap = std::max(1e-9, left_square({}) - floor_square());
    for (const DriverTest& t : tests)
        unknown_evidence_ = std::max(unknown_evidence_, evidence_of(t));
    for (const DriverTest& t : tests) {
        const double share = std::min(1.0, t.explained / gap);
        if (t.p_value > rules::driver_p || share < rules::driver_share) continue;
        if (result_.where.size() == 6) break;
        DriverShare driver{t.by, t.component, "", share, t.p_value};
        driver.text =
            fmt::format("{:.0f} % of the gap {} ({})", 100.0 * share, t.text, t.component);
        result_.where.push_back(std::move(driver));
    }
}

std::vector<FitParameter> Diagnoser::parameters_of(const EffectSet& set, std::size_t member) const {
    const auto columns = columns_of(*design_, set.members);
    const Eigen::VectorXd x = design_->solve(columns, set.scale);
    const Eigen::MatrixXd covariance = design_->covariance(columns, set.scale);
    Eigen::Index at = design_->base_count();
    for (const std::size_t m : set.members) {
        if (m == member) break;
        at += design_->candidates()[m].size();
    }
    const Candidate& candidate = design_->candidates()[member];
    std::vector<FitParameter> list;
    std::size_t column = 0;
    for (std::size_t j = 0; j < candidate.effect->parameters.size(); ++j) {
        const EffectParameter& p = candidate.effect->parameters[j];
        FitParameter fit{candidate.effect->name, p.name, p.unit, p.component, p.typical, 0.0,
                         std::nan(""),           0.0,    0.0};
        if (p.is_key()) {
            fit.value = candidate.values[j];
        } else if (column < candidate.parameters.size() && candidate.parameters[column] == j) {
            const Eigen::Index k = at + static_cast<Eigen::Index>(column++);
            fit.value = x(k) * p.typical;
            const double sigma = std::sqrt(covariance(k, k));
            if (sigma < 0.7 * set.scale) fit.sigma = sigma * p.typical;
        }
        list.push_back(fit);
    }
    return list;
}

void Diagnoser::claim(double gap) {
    const std::vector<double> share = shares_of(set_.members);
    const std::vector<EffectSet> possible = possible_sets();
    const auto belief = belief_of(possible);
    unknown_belief_ = belief.at("unknown");
    const ShrinkDraws draws = shrink_draws(possible);
    for (std::size_t k = 0; k < set_.members.size(); ++k) {
        const std::size_t m = set_.members[k];
        const Effect& effect = *design_->candidates()[m].effect;
        Cause cause;
        cause.effect = effect.name;
        cause.share = std::clamp(share[k] / gap, 0.0, 1.0);
        cause.probability = belief.at(effect.name);
        cause.rivals = rivals_of(m);
        cause.parameters = parameters_of(set_, m);
        cause.unseen = unseen_of(design_->candidates()[m]);
        cause.heldout = held_out({m}, draws);
        cause.what = effect.what;
        cause.usual_cause = effect.cause;
        cause.remedy = effect.remedy;
        result_.causes.push_back(std::move(cause));
    }
    std::stable_sort(result_.causes.begin(), result_.causes.end(),
                     [](const Cause& a, const Cause& b) { return a.share > b.share; });
    result_.after = held_out(set_.members, draws);
}

/// How far the gap shrinks with some of the chosen effects: by folds, with the interval drawn.
HeldOut Diagnoser::held_out(const std::vector<std::size_t>& members,
                            const ShrinkDraws& draws) const {
    HeldOut result =
        cross_validate(*design_, base_, folds_, members, set_.scale, noise_mm(), used_);
    const auto [low, high] = draws.interval(columns_of(*design_, members), set_.scale);
    result.low = std::min(low, result.shrink) - least_half_width;
    result.high = std::min(1.0, std::max(high, result.shrink) + least_half_width);
    return result;
}

void Diagnoser::add_unknown(double share, const std::vector<DriverTest>& left) {
    Cause cause;
    cause.effect = "unknown";
    cause.share = share;
    cause.probability = 1.0;
    cause.what = "A gap with structure that no effect of the catalogue explains";
    if (!left.empty()) cause.what += ": it " + left.front().text;
    cause.heldout = cross_validate(*design_, base_, folds_, {}, 1.0, noise_mm(), used_);
    const auto at = std::find_if(result_.causes.begin(), result_.causes.end(),
                                 [&](const Cause& c) { return c.share < share; });
    result_.causes.insert(at, std::move(cause));
}

void Diagnoser::write_setup() {
    const auto columns = columns_of(*design_, set_.members);
    const Eigen::VectorXd x = design_->solve(columns, set_.scale);
    result_.setup = base_.setup;
    shift_base(result_.setup, base_, catalogue_, x.head(design_->base_count()));
    for (const std::size_t m : set_.members) {
        const Candidate& candidate = design_->candidates()[m];
        std::vector<double> values;
        for (const FitParameter& p : parameters_of(set_, m)) values.push_back(p.value);
        add_effect(result_.setup, *candidate.effect, values);
    }
}

}  // namespace trunnion
