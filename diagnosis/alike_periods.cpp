#include "diagnosis/alike_periods.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

#include "base/units.h"
#include "diagnosis/groups/candidate_groups.h"
#include "diagnosis/groups/ripples.h"
#include "diagnosis/prepare/places.h"
#include "diagnosis/round.h"
#include "diagnosis/rules/rules.h"

namespace trunnion::diagnosis {
namespace {

/// Peaks explain this part at least of what the ripple explains, as the mean errors of the places
/// have it: that neglects what is fitted beside them, as the pose of a tracker.
constexpr double least_height = 0.4;
/// Periods that are tried in the model: those that explain most beside the set-up. One that is
/// alike is enough.
constexpr std::size_t most_candidates = 8, most_peaks = 60;
constexpr double steps_per_cycle = 4.0;  ///< over the range
constexpr double most_steps =
    1e5;  ///< 100 m of travel reach it; a wild coordinate has coarser ones

/// Mean errors of the places, and what a ripple of any frequency explains of them beside their
/// mean: the generalised periodogram of Zechmeister and Kuerster (2009).
class Periodogram {
  public:
    Periodogram(const RippleSearch& s, Axis axis, const Eigen::VectorXd& left_mm) {
        const Prepared& p = s.prepared;
        const std::vector<bool> tells = tells_place(p, axis);
        position_ = positions_at(telling_places(p, axis));
        weight_.assign(position_.size(), 0.0);
        product_.assign(position_.size(), 0.0);
        for (std::size_t i = 0; i < tells.size(); ++i) {
            if (!tells[i]) continue;
            const auto row = static_cast<Eigen::Index>(i);
            const double sigma = s.sigma_mm(row), response = p.base.gradient[i].axis[axis];
            const std::size_t at = nearest(p.replay.sample(i).position[axis]);
            weight_[at] += response * response / (sigma * sigma);
            product_[at] += response * left_mm(row) / (sigma * sigma);
        }
        for (std::size_t k = 0; k < position_.size(); ++k) {
            sum_weight_ += weight_[k];
            sum_product_ += product_[k];
        }
    }

    double range() const { return position_.empty() ? 0.0 : position_.back() - position_.front(); }

    /// Chi-squared explained by cosine and sine.
    double explained(double frequency) const {
        double c = 0.0, s = 0.0, cc = 0.0, cs = 0.0, ss = 0.0, yc = 0.0, ys = 0.0;
        for (std::size_t k = 0; k < position_.size(); ++k) {
            const double angle = 2.0 * pi * frequency * (position_[k] - position_.front());
            const double co = std::cos(angle), si = std::sin(angle), w = weight_[k];
            c += w * co;
            s += w * si;
            cc += w * co * co;
            cs += w * co * si;
            ss += w * si * si;
            yc += product_[k] * co;
            ys += product_[k] * si;
        }
        const double mean = sum_product_ / sum_weight_;
        yc -= mean * c;
        ys -= mean * s;
        cc -= c * c / sum_weight_;
        cs -= c * s / sum_weight_;
        ss -= s * s / sum_weight_;
        // Of one phase only (the readings alternate) one component is determined.
        const double ridge = 1e-9 * sum_weight_,
                     determinant = (cc + ridge) * (ss + ridge) - cs * cs;
        return ((ss + ridge) * yc * yc - 2.0 * cs * yc * ys + (cc + ridge) * ys * ys) / determinant;
    }

  private:
    std::size_t nearest(double q) const {
        const auto at = std::lower_bound(position_.begin(), position_.end(), q);
        if (at == position_.begin()) return 0;
        const auto k = static_cast<std::size_t>(at - position_.begin());
        return at == position_.end() || q - position_[k - 1] < *at - q ? k - 1 : k;
    }
    std::vector<double> position_, weight_, product_;
    double sum_weight_ = 0.0, sum_product_ = 0.0;
};

/// Key of a ripple, and frequencies of the periods that the catalogue has.
struct RippleKey {
    std::size_t index = 0;
    bool counts = false;             ///< periods in a turn, all of them whole
    double least = 0.0, most = 0.0;  ///< frequency, cycles per mm or rad
    double frequency_of(double key) const { return counts ? key / (2.0 * pi) : 1.0 / key; }
    double key_of(double frequency) const {
        return counts ? std::round(2.0 * pi * frequency) : 1.0 / frequency;
    }
};
RippleKey ripple_key_of(const effects::Effect& effect) {
    RippleKey key;
    for (std::size_t j = 0; j < effect.parameters.size(); ++j) {
        const effects::EffectParameter& p = effect.parameters[j];
        if (!p.is_key()) continue;
        key.index = j;
        key.counts = p.counts_periods;
        const auto [low, high] = std::minmax_element(p.grid.begin(), p.grid.end());
        key.least = std::min(key.frequency_of(*low), key.frequency_of(*high));
        key.most = std::max(key.frequency_of(*low), key.frequency_of(*high));
    }
    return key;
}

/// The top of a peak of the periodogram around a frequency, in golden sections.
double top_of(const Periodogram& spectrum, double frequency, double step) {
    constexpr double golden = 0.6180339887498949;
    double low = frequency - step, high = frequency + step;
    for (int k = 0; k < 16; ++k) {
        const double a = high - golden * (high - low), b = low + golden * (high - low);
        const bool left = spectrum.explained(a) > spectrum.explained(b);
        (left ? high : low) = left ? b : a;
    }
    return 0.5 * (low + high);
}

/// The first frequencies of a list by their order.
std::vector<double> first_of(std::vector<std::pair<double, double>> list, std::size_t count) {
    std::sort(list.begin(), list.end());
    std::vector<double> frequencies;
    for (const auto& [order, f] : list)
        if (frequencies.size() < count) frequencies.push_back(f);
    return frequencies;
}

/// Frequencies of high peaks apart from `own`.
std::vector<double> peaks(const Periodogram& spectrum, const RippleKey& key, double own) {
    const double resolution = 1.0 / spectrum.range();
    const double most = std::min(key.most, own / far_finer);
    const double step =
        key.counts ? 1.0 / (2.0 * pi)
                   : std::max(resolution / steps_per_cycle, (most - key.least) / most_steps);
    const auto count = static_cast<std::size_t>(std::floor((most - key.least) / step + 1e-6)) + 1;
    const auto at = [&](std::size_t k) { return key.least + step * static_cast<double>(k); };
    std::vector<double> height(count);
    for (std::size_t k = 0; k < count; ++k) height[k] = spectrum.explained(at(k));
    const double least = least_height * spectrum.explained(own);
    std::vector<std::pair<double, double>> found;
    for (std::size_t k = 0; k < count; ++k) {
        const bool top = (k == 0 || height[k] >= height[k - 1]) &&
                         (k + 1 == count || height[k] >= height[k + 1]);
        // A step beside its top a peak is a little lower.
        if (!top || height[k] < 0.9 * least || std::abs(at(k) - own) < resolution) continue;
        const double f =
            key.counts ? at(k) : std::clamp(top_of(spectrum, at(k), step), key.least, most);
        const double explained = spectrum.explained(f);
        if (explained >= least && std::abs(f - own) >= resolution)
            found.emplace_back(-explained, f);
    }
    return first_of(std::move(found), most_peaks);
}

/// Chi-squared that a ripple of the axis explains of whitened readings beside the set-up.
double explained_of(const RippleSearch& s, Axis axis, double frequency,
                    const Eigen::VectorXd& white) {
    const auto n = static_cast<Eigen::Index>(s.prepared.replay.size());
    Eigen::MatrixXd both(n, 2);
    for (Eigen::Index i = 0; i < n; ++i) {
        const auto row = static_cast<std::size_t>(i);
        const double angle = 2.0 * pi * frequency * s.prepared.replay.sample(row).position[axis];
        const double response = s.prepared.base.gradient[row].axis[axis];
        both(i, 0) = response * std::cos(angle);
        both(i, 1) = response * std::sin(angle);
    }
    s.whitener.apply(both);
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(white.size(), 2);
    all.topRows(n) = both;
    all = s.design.projection().beside(all);
    Eigen::Matrix2d square = all.transpose() * all;
    square.diagonal().array() += 1e-9 * square.trace();  // two phases show one component
    const Eigen::Vector2d product = all.transpose() * white;
    return product.dot(square.llt().solve(product));
}

/// The peaks that explain most of what the other members leave, the best first.
std::vector<double> candidates(const RippleSearch& s, Axis axis, const Eigen::VectorXd& left_mm,
                               const std::vector<double>& peaks) {
    Eigen::VectorXd white = Eigen::VectorXd::Zero(s.design.data().size());
    white.head(left_mm.size()) = s.whitener.apply(left_mm);
    white = s.design.projection().beside(white);
    std::vector<std::pair<double, double>> found;
    for (const double f : peaks) found.emplace_back(-explained_of(s, axis, f, white), f);
    return first_of(std::move(found), most_candidates);
}

/// True for a ripple, not for other effects with keys.
bool is_ripple(const ColumnGroup& group) {
    return group.kind == GroupKind::periodic && group.effect->kind == effects::EffectKind::cyclic;
}

/// True for a ripple of a linear axis. Of a rotary one the arms differ from reading to reading, and
/// places are not worth what they weigh: the rule for grids alone decides there.
bool is_questioned(const ColumnGroup& group) {
    return is_ripple(group) && !ripple_key_of(*group.effect).counts;
}

/// Takes all ripples of an effect out of the offers, except members of the model.
void hide_ripples(Design& design, const effects::Effect* effect, const Model& model) {
    for (std::size_t k = 0; k < design.groups().size(); ++k)
        if (is_ripple(design.group(k)) && design.group(k).effect == effect &&
            std::find(model.members.begin(), model.members.end(), k) == model.members.end())
            design.hide(k);
}

}  // namespace

std::vector<double> alike_periods(const RippleSearch& s, Model& model, std::size_t position) {
    const ColumnGroup held = s.design.group(model.members[position]);
    const RippleKey key = ripple_key_of(*held.effect);
    const Axis axis = *held.effect->axis;
    const Eigen::VectorXd left_mm = rest_of(s.prepared, s.design, without(model, position));
    const Periodogram spectrum(s, axis, left_mm);
    if (spectrum.range() <= 0.0) return {};
    const std::vector<double> places = positions_at(telling_places(s.prepared, axis));
    Model best = model;
    std::vector<std::pair<double, double>> tried{{model.score, held.keys[key.index]}};
    const double own_frequency = key.frequency_of(held.keys[key.index]);
    for (const double f : candidates(s, axis, left_mm, peaks(spectrum, key, own_frequency))) {
        std::vector<double> keys = held.keys;
        keys[key.index] = key.key_of(f);
        const auto added =
            add_keyed_group(s.design, s.prepared, s.whitener, *held.effect, std::move(keys));
        if (!added) continue;
        s.design.hide(*added);
        Model trial = model;
        trial.members[position] = *added;
        trial = tuned(s.design, s.setting, std::move(trial), 2);
        tried.emplace_back(trial.score, key.key_of(f));
        if (trial.score > best.score + better && shows_period(places, 1.0 / f))
            best = std::move(trial);
    }
    model = std::move(best);
    const double own = s.design.group(model.members[position]).keys[key.index];
    std::vector<double> alike;
    for (const auto& [score, other] : tried)
        if (other != own && score > model.score - rules::least_evidence) alike.push_back(other);
    return alike;
}

Model without_open_ripples(const RippleSearch& s, Model model) {
    for (std::size_t k = 0; k < model.members.size();) {
        if (!is_questioned(s.design.group(model.members[k]))) {
            ++k;
            continue;
        }
        std::vector<double> alike = alike_periods(s, model, k);
        const std::size_t member = model.members[k];
        const effects::Effect* effect = s.design.group(member).effect;
        const auto places = telling_places(s.prepared, *effect->axis);
        if (alike.empty() ||
            std::round(effective_count(places)) >= static_cast<double>(many_on_grid)) {
            s.design.leave_open(member, std::move(alike));
            ++k;
            continue;
        }
        if (!may_be_usual(*effect, s.design.group(member).keys, alike))
            s.design.favour(member, rules::odd_period_prior);
        model = without(model, k);
        hide_ripples(s.design, effect, model);
        s.design.keep_as_rival(member);
        model =
            settled(s.design, s.setting,
                    grown(s.design, s.setting, tuned(s.design, s.setting, std::move(model), 2)));
        k = 0;
    }
    return model;
}

}  // namespace trunnion::diagnosis
