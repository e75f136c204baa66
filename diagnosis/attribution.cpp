// Which set of effects: candidates, noise, keys, and what is too small to be a cause.
#include <algorithm>
#include <cmath>

#include "diagnosis/diagnoser.h"
#include "diagnosis/rules.h"
#include "diagnosis/statistics.h"
#include "identification/identify.h"

namespace trunnion {
namespace {

constexpr std::size_t kept_sets = 300;  ///< of those the search met
/// Prior of key settings: even over their grids, but even in the logarithm where the grid counts
/// periods: a period and its alias fit alike, and the coarse one is what machines have.
double log_prior_of_keys(const Effect& effect, const std::vector<double>& keys) {
    double sum = 0.0;
    for (std::size_t j = 0; j < keys.size(); ++j) {
        const EffectParameter& p = effect.parameters[j];
        if (!p.is_key()) continue;
        double all = 0.0;
        const bool counts = p.name == periods_key;
        for (const double g : p.grid) all += counts ? 1.0 / g : 1.0;
        sum += std::log((counts ? 1.0 / keys[j] : 1.0) / all);
    }
    return sum;
}

/// A key that might lie between grid values stands on one.
bool on_the_grid(const Candidate& candidate) {
    for (std::size_t j = 0; j < candidate.values.size(); ++j) {
        const EffectParameter& p = candidate.effect->parameters[j];
        if (p.is_key() && p.refine &&
            std::find(p.grid.begin(), p.grid.end(), candidate.values[j]) != p.grid.end())
            return true;
    }
    return false;
}

constexpr int alternative_keys = 6;  ///< tried for each chosen effect with keys, for doubt

}  // namespace

void Diagnoser::build_design() {
    design_.emplace(replay_, base_, *whitener_);
    keys_.emplace(replay_, base_);
    for (const Effect& effect : catalogue_) {
        if (modelled(effect) || effect.parameters.empty()) continue;
        if (has_keys(effect)) continue;
        // An effect's prior is shared among its forms; the simpler ones have fewer parameters.
        const auto forms = simpler_forms(effect);
        const double prior = prior_ - std::log(1.0 + static_cast<double>(forms.size()));
        design_->add(effect, effect.zeros(), prior);
        for (const auto& takes : forms) design_->add(effect, effect.zeros(), prior, takes);
    }
    design_->update();
    add_keyed({}, 2);
    design_->update();
}

void Diagnoser::add_keyed(const EffectSet& beside, int count) {
    const Eigen::VectorXd left = left_after(beside);
    const Eigen::MatrixXd fitted = known_columns(beside);
    for (const Effect& effect : catalogue_) {
        if (modelled(effect) || !has_keys(effect)) continue;
        for (auto& keys : keys_->best(effect, left, sigma_mm_, fitted, count)) {
            const double log_prior = prior_ + log_prior_of_keys(effect, keys);
            design_->add(effect, std::move(keys), log_prior);
        }
    }
}

SearchOptions Diagnoser::search_options() const {
    SearchOptions options;
    options.noise_variance = noise_variance_;
    return options;
}

EffectSet Diagnoser::best_set() {
    visited_ = search_sets(*design_, search_options());
    if (visited_.size() > kept_sets) visited_.resize(kept_sets);
    return visited_.front();
}

Eigen::VectorXd Diagnoser::left_after(const EffectSet& set) const {
    return design_->residual(columns_of(*design_, set.members), set.scale);
}

double Diagnoser::freedom_after(const EffectSet& set) const {
    return design_->freedom() - outliers() -
           static_cast<double>(columns_of(*design_, set.members).size());
}

bool Diagnoser::same_noise(const NoiseModel& a, const NoiseModel& b) {
    for (const Device device : {Device::sphere, Device::touch, Device::ballbar}) {
        const DeviceNoise &x = a.of(device), &y = b.of(device);
        if (std::abs(x.scale - y.scale) > 0.03 * x.scale) return false;
        if (std::abs(x.shared - y.shared) > 0.03) return false;
        if (x.shared > 0.03 && std::abs(x.memory - y.memory) > 0.03) return false;
    }
    return true;
}

void Diagnoser::refine_noise() {
    for (int pass = 0; pass < 2; ++pass) {
        const Eigen::VectorXd left = left_after(set_);
        const NoiseModel used = noise_;
        NoiseModel stated;
        stated.source = noise_.source;
        if (noise_.source == NoiseSource::repeats) {
            if (set_.members.empty() && outliers() == 0.0) return;
            noise_ = noise_from_repeats(replay_, table_, blocks_, left, sigma_mm_, stated);
        } else {
            const double freedom =
                std::clamp(freedom_after(set_) / static_cast<double>(replay_.size()), 0.3, 1.0);
            noise_ = noise_from_residuals(replay_, blocks_, left, sigma_mm_, stated, freedom,
                                          base_.noise_given);
        }
        if (same_noise(used, noise_)) return;
        const std::vector<std::size_t> before = set_.members;
        rewhiten();
        set_ = best_set();
        if (set_.members == before) return;
    }
}

void Diagnoser::refine_set() {
    for (int pass = 0; pass < 3; ++pass) {
        const EffectSet before = set_;
        for (const std::size_t m : before.members) {
            if (!has_keys(*design_->candidates()[m].effect)) continue;
            std::vector<std::size_t> others = before.members;
            std::erase(others, m);
            add_refined(m, others);
            if (!others.empty()) add_refined(m, {});
        }
        add_keyed(before, 1);
        design_->update();
        set_ = best_set();
        if (set_.log_evidence < before.log_evidence + 1.0) break;
    }
}

void Diagnoser::add_refined(std::size_t m, const std::vector<std::size_t>& others) {
    const Candidate candidate = design_->candidates()[m];
    const Eigen::VectorXd left = design_->residual(columns_of(*design_, others), set_.scale);
    design_->add(*candidate.effect,
                 refine_keys(replay_, base_, *candidate.effect, candidate.values, left),
                 candidate.log_prior);
}

/// Other settings of the keys of chosen effects: aliases that these readings may not exclude.
void Diagnoser::add_alternatives() {
    bool added = false;
    for (const std::size_t m : set_.members) {
        const Candidate chosen = design_->candidates()[m];
        if (!has_keys(*chosen.effect)) continue;
        std::vector<std::size_t> others = set_.members;
        std::erase(others, m);
        const EffectSet beside{others, 0.0, set_.scale, 0.0};
        for (auto& keys : keys_->best(*chosen.effect, left_after(beside), sigma_mm_,
                                      known_columns(beside), alternative_keys)) {
            const double log_prior = prior_ + log_prior_of_keys(*chosen.effect, keys);
            design_->add(*chosen.effect, std::move(keys), log_prior);
        }
        added = true;
    }
    if (added) design_->update();
}

void Diagnoser::prune() {
    while (!set_.members.empty()) {
        const std::vector<double> share = shares_of(set_.members);
        const double base = left_square({});
        const double floor = floor_square();
        const double gap = std::max(1e-9, base - std::min(floor, left_square(set_.members)));
        std::size_t least = 0;
        for (std::size_t k = 1; k < share.size(); ++k)
            if (share[k] < share[least]) least = k;
        const bool small =
            share[least] < rules::least_share * gap || share[least] < rules::least_square * floor;
        if (!small) break;
        std::vector<std::size_t> members = set_.members;
        members.erase(members.begin() + static_cast<long>(least));
        set_ = evaluate(*design_, members, search_options());
    }
}

/// With small effects gone the best set of what remains may be another: each effect is replaced by
/// any other candidate as long as that raises the evidence.
void Diagnoser::settle() {
    for (int pass = 0; pass < 6; ++pass) {
        EffectSet best = set_;
        for (const std::size_t m : set_.members)
            for (EffectSet& s : swapped_sets(m))
                if (s.log_evidence > best.log_evidence + 1e-6) best = std::move(s);
        if (best.members == set_.members) break;
        set_ = std::move(best);
        prune();
    }
    if (!set_.members.empty() && by_chance()) set_ = EffectSet{};
}

/// Keys beside the effects that remain; of equal ones the refined (a moment in the middle between
/// two readings).
void Diagnoser::finish_keys() {
    for (const std::size_t m : std::vector<std::size_t>(set_.members)) {
        if (!on_the_grid(design_->candidates()[m])) continue;
        std::vector<std::size_t> members = set_.members;
        std::erase(members, m);
        add_refined(m, members);
        design_->update();
        members.push_back(design_->candidates().size() - 1);
        EffectSet refined = evaluate(*design_, std::move(members), search_options());
        if (refined.log_evidence > set_.log_evidence - 1e-6) set_ = std::move(refined);
    }
}

/// Noise alone would explain as much with one effect of the catalogue too often.
bool Diagnoser::by_chance() const {
    const auto width = static_cast<double>(columns_of(*design_, set_.members).size());
    return rules::effects_tried * chi_squared_tail(set_.explained, width) > rules::gap_p;
}

}  // namespace trunnion
