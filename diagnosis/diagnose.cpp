#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "diagnosis/diagnosis.h"
#include "diagnosis/drivers.h"
#include "diagnosis/heldout.h"
#include "diagnosis/next_measurement.h"
#include "diagnosis/rules.h"
#include "diagnosis/search.h"
#include "diagnosis/statistics.h"
#include "effects/settings.h"
#include "geometry/alarm.h"
#include "identification/identify.h"

namespace trunnion {
namespace {

/// One diagnosis in progress: the stages of docs/diagnosis.md in the order of run().
class Diagnoser {
  public:
    Diagnoser(const Setup& setup, const ReadingTable& table, const DiagnosisOptions& options)
        : table_(table),
          options_(options),
          replay_(setup, table),
          catalogue_(make_catalogue(setup, extent_of(setup, table))) {
        refuse_poor_tables();
        base_ = fit_base(setup, table, replay_, catalogue_, setup.model.modelled);
        blocks_ = noise_blocks(replay_, table);
        folds_ = make_folds(blocks_, replay_.size());
        used_.assign(replay_.size(), true);
        sigma_mm_ = base_.sigma_mm;
    }

    Diagnosis run() {
        start_noise();
        build_design();
        drop_outliers();
        set_ = best_set();
        refine_noise();
        refine_set();
        prune();
        judge();
        return std::move(result_);
    }

  private:
    void refuse_poor_tables() const {
        if (replay_.size() < 12)
            throw InputError(fmt::format("{} readings allow no diagnosis", replay_.size()),
                             {table_.path, 0, 0});
    }

    void start_noise() {
        noise_.source = base_.noise_given ? NoiseSource::given : NoiseSource::assumed;
        noise_ = noise_from_repeats(replay_, table_, blocks_, base_.residual_mm, sigma_mm_, noise_);
        rewhiten();
    }

    void rewhiten() {
        whitener_.emplace(replay_, blocks_, noise_, sigma_mm_);
        if (design_) design_->rewhiten(*whitener_);
    }

    bool modelled(const Effect& effect) const {
        const auto& names = base_.setup.model.modelled;
        return effect.name == "location" ||
               std::find(names.begin(), names.end(), effect.name) != names.end();
    }

    void build_design() {
        design_.emplace(replay_, base_, *whitener_);
        for (const Effect& effect : catalogue_) {
            if (modelled(effect) || effect.parameters.empty()) continue;
            if (!has_keys(effect)) design_->add(effect, effect.zeros(), prior_);
        }
        add_keyed(base_.residual_mm, 2);
        design_->update();
    }

    /// Candidates of effects with keys, at the settings that promise most on what is left.
    void add_keyed(const Eigen::VectorXd& left_mm, int count) {
        for (const Effect& effect : catalogue_) {
            if (modelled(effect) || !has_keys(effect)) continue;
            for (auto& keys : best_keys(replay_, base_, effect, left_mm, sigma_mm_, count)) {
                double trials = 1.0;
                for (const EffectParameter& p : effect.parameters)
                    if (p.is_key()) trials *= static_cast<double>(p.grid.size());
                design_->add(effect, std::move(keys), prior_ - std::log(trials));
            }
        }
    }

    /// Do most of these rows follow each other?
    static bool neighbours(const std::vector<std::size_t>& rows) {
        std::size_t pairs = 0;
        for (std::size_t k = 1; k < rows.size(); ++k) pairs += rows[k] - rows[k - 1] <= 2 ? 1 : 0;
        return rows.size() > 8 && 10 * pairs > 4 * rows.size();
    }

    /// Rows that stand out although everything was tried on them: left out from here on.
    void drop_outliers() {
        for (int pass = 0; pass < 2; ++pass) {
            std::vector<Eigen::Index> all(static_cast<std::size_t>(design_->gram().cols()));
            for (std::size_t k = 0; k < all.size(); ++k) all[k] = static_cast<Eigen::Index>(k);
            const Eigen::VectorXd z = design_->residual(all, 1.0).cwiseQuotient(base_.sigma_mm);
            std::vector<double> size;
            for (Eigen::Index i = 0; i < z.size(); ++i) size.push_back(std::abs(z(i)));
            const double limit = 5.0 * std::max(0.5, 1.4826 * median(size));
            std::vector<std::size_t> wild;
            for (std::size_t i = 0; i < used_.size(); ++i)
                if (used_[i] && size[i] > limit) wild.push_back(i);
            // Many at once, or in a row, are no outliers: something happened to the machine.
            if (wild.empty() || neighbours(wild) ||
                static_cast<double>(wild.size()) >
                    rules::most_outliers * static_cast<double>(used_.size()))
                return;
            for (const std::size_t i : wild) {
                const auto row = static_cast<Eigen::Index>(i);
                used_[i] = false;
                sigma_mm_(row) = 1e3 * base_.sigma_mm(row);
            }
            rewhiten();
        }
    }

    SearchOptions search_options() const {
        SearchOptions options;
        options.noise_variance = noise_variance_;
        return options;
    }

    EffectSet best_set() { return search_sets(*design_, search_options()).front(); }

    Eigen::VectorXd left_after(const EffectSet& set) const {
        return design_->residual(columns_of(*design_, set.members), set.scale);
    }

    double freedom_after(const EffectSet& set) const {
        return design_->freedom() - static_cast<double>(columns_of(*design_, set.members).size());
    }

    /// Mean squared z (in stated sigma) of rows that count, freedom accounted for.
    double mean_square(const Eigen::VectorXd& left_mm, double lost) const {
        double sum = 0.0, rows = 0.0;
        for (std::size_t i = 0; i < used_.size(); ++i) {
            if (!used_[i]) continue;
            const auto k = static_cast<Eigen::Index>(i);
            sum += left_mm(k) * left_mm(k) / (base_.sigma_mm(k) * base_.sigma_mm(k));
            rows += 1.0;
        }
        return sum / std::max(1.0, rows - lost);
    }

    /// Too little change for another round.
    static bool same_noise(const NoiseModel& a, const NoiseModel& b) {
        for (const Device device : {Device::sphere, Device::touch, Device::ballbar}) {
            const DeviceNoise &x = a.of(device), &y = b.of(device);
            if (std::abs(x.scale - y.scale) > 0.03 * x.scale) return false;
            if (std::abs(x.shared - y.shared) > 0.03) return false;
            if (x.shared > 0.03 && std::abs(x.memory - y.memory) > 0.03) return false;
        }
        return true;
    }

    /// Noise anew from what the best set leaves, then the best set anew.
    void refine_noise() {
        for (int pass = 0; pass < 2; ++pass) {
            const Eigen::VectorXd left = left_after(set_);
            const NoiseModel used = noise_;
            NoiseModel stated;
            stated.source = noise_.source;
            if (noise_.source == NoiseSource::repeats) {
                if (set_.members.empty()) return;
                noise_ = noise_from_repeats(replay_, table_, blocks_, left, base_.sigma_mm, stated);
            } else {
                const double freedom =
                    std::clamp(freedom_after(set_) / static_cast<double>(replay_.size()), 0.3, 1.0);
                noise_ = noise_from_residuals(replay_, blocks_, left, base_.sigma_mm, stated,
                                              freedom, base_.noise_given);
            }
            if (same_noise(used, noise_)) return;
            const std::vector<std::size_t> before = set_.members;
            rewhiten();
            set_ = best_set();
            if (set_.members == before) return;
        }
    }

    /// Keys of chosen effects refined, beside the others and alone; further keys tried on the rest.
    void refine_set() {
        for (int pass = 0; pass < 3; ++pass) {
            const EffectSet before = set_;
            for (const std::size_t m : before.members) {
                if (!has_keys(*design_->candidates()[m].effect)) continue;
                std::vector<std::size_t> others = before.members;
                std::erase(others, m);
                add_refined(m, others);
                if (!others.empty()) add_refined(m, {});
            }
            add_keyed(left_after(before), 1);
            design_->update();
            set_ = best_set();
            if (set_.log_evidence < before.log_evidence + 1.0) break;
        }
    }

    /// Candidate `m` again with keys refined on what the effects `others` leave.
    void add_refined(std::size_t m, const std::vector<std::size_t>& others) {
        const Candidate candidate = design_->candidates()[m];
        const Eigen::VectorXd left = design_->residual(columns_of(*design_, others), set_.scale);
        design_->add(*candidate.effect,
                     refine_keys(replay_, base_, *candidate.effect, candidate.values, left),
                     candidate.log_prior);
    }

    /// What a subset of the chosen effects leaves, as mean squared z.
    double left_square(const std::vector<std::size_t>& members) const {
        const auto columns = columns_of(*design_, members);
        return mean_square(design_->residual(columns, set_.scale),
                           static_cast<double>(replay_.size()) - design_->freedom() +
                               static_cast<double>(columns.size()));
    }

    /// Mean squared z that noise alone leaves.
    double floor_square() const {
        double sum = 0.0, rows = 0.0;
        for (std::size_t i = 0; i < used_.size(); ++i) {
            if (!used_[i]) continue;
            const double s = noise_.of(replay_.contact(i).device).scale;
            sum += s * s;
            rows += 1.0;
        }
        return sum / std::max(1.0, rows);
    }

    /// What the fit leaves is noise of another size than the setup states.
    bool stated_noise_is_off() const {
        std::map<Device, double> rows;
        for (const NoiseBlock& block : blocks_)
            rows[block.device] += static_cast<double>(block.rows.size());
        return std::any_of(rows.begin(), rows.end(), [&](const auto& entry) {
            const DeviceNoise& noise = noise_.of(entry.first);
            const double chance = 3.0 / std::sqrt(2.0 * noise.independent(entry.second));
            return std::abs(std::log(noise.scale)) > std::max(0.1, chance);
        });
    }

    std::vector<double> shares_of(const std::vector<std::size_t>& members) const {
        const auto players = static_cast<int>(members.size());
        std::vector<double> worth(std::size_t{1} << players);
        const double base = left_square({});
        for (std::size_t mask = 1; mask < worth.size(); ++mask) {
            std::vector<std::size_t> part;
            for (int k = 0; k < players; ++k)
                if (mask >> k & 1) part.push_back(members[static_cast<std::size_t>(k)]);
            worth[mask] = base - left_square(part);
        }
        return shapley(worth, players);
    }

    /// Effects that add little to what the others explain are background, not causes.
    void prune() {
        while (!set_.members.empty()) {
            const std::vector<double> share = shares_of(set_.members);
            const double base = left_square({});
            const double floor = floor_square();
            const double gap = std::max(1e-9, base - std::min(floor, left_square(set_.members)));
            std::size_t least = 0;
            for (std::size_t k = 1; k < share.size(); ++k)
                if (share[k] < share[least]) least = k;
            const bool small = share[least] < rules::least_share * gap ||
                               share[least] < rules::least_square * floor;
            if (!small) break;
            std::vector<std::size_t> members = set_.members;
            members.erase(members.begin() + static_cast<long>(least));
            set_ = evaluate(*design_, members, search_options());
        }
    }

    /// What is left after the chosen set, as mean squared z.
    struct Remainder {
        std::vector<DriverTest> drivers;  ///< significant ones
        double base = 0.0, after = 0.0, floor = 0.0, structured = 0.0;
        double gap = 0.0, unexplained = 0.0;
    };
    Remainder remainder();
    double unusual_square() const;
    double aliased_square() const;
    double ripple_square(const Eigen::VectorXd& left) const;
    bool coincidence() const;
    double noise_doubt() const;
    void judge();
    void describe_size(const Remainder& r);
    void describe_where();
    void claim(double gap);
    void add_unknown(double share, const std::vector<DriverTest>& left);
    std::vector<std::string> rivals_of(std::size_t member, double& probability) const;
    std::vector<FitParameter> parameters_of(const EffectSet& set, std::size_t member) const;
    void write_setup();
    void ask_next();
    void test_holdout();

    Eigen::MatrixXd known_columns(const EffectSet& set) const {
        const auto columns = columns_of(*design_, set.members);
        Eigen::MatrixXd known(design_->raw().rows(),
                              design_->base_count() + static_cast<Eigen::Index>(columns.size()));
        known.leftCols(design_->base_count()) = design_->raw().leftCols(design_->base_count());
        for (std::size_t k = 0; k < columns.size(); ++k)
            known.col(design_->base_count() + static_cast<Eigen::Index>(k)) =
                design_->raw().col(design_->base_count() + columns[k]);
        return known;
    }

    Eigen::VectorXd noise_mm() const {
        Eigen::VectorXd v = base_.sigma_mm;
        for (Eigen::Index i = 0; i < v.size(); ++i)
            v(i) *= noise_.of(replay_.contact(static_cast<std::size_t>(i)).device).scale;
        return v;
    }

    double rms_um(const Eigen::VectorXd& v) const {
        double sum = 0.0, rows = 0.0;
        for (std::size_t i = 0; i < used_.size(); ++i) {
            if (!used_[i]) continue;
            sum += v(static_cast<Eigen::Index>(i)) * v(static_cast<Eigen::Index>(i));
            rows += 1.0;
        }
        return 1e3 * std::sqrt(sum / std::max(1.0, rows));
    }

    const ReadingTable& table_;
    DiagnosisOptions options_;
    Replay replay_;
    Catalogue catalogue_;
    BaseModel base_;
    std::vector<NoiseBlock> blocks_;
    Folds folds_;
    std::vector<bool> used_;
    Eigen::VectorXd sigma_mm_;  ///< large for outliers
    NoiseModel noise_;
    double noise_variance_ = 1.0;
    double prior_ = std::log(0.04);
    std::optional<Whitener> whitener_;
    std::optional<Design> design_;
    EffectSet set_;
    Diagnosis result_;
};

void Diagnoser::describe_where() {
    const auto tests = test_drivers(replay_, table_, base_, known_columns({}), base_.residual_mm,
                                    base_.sigma_mm, used_, *whitener_);
    const double gap = std::max(1e-9, left_square({}) - floor_square());
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

std::vector<std::string> Diagnoser::rivals_of(std::size_t member, double& probability) const {
    std::vector<std::size_t> others;
    for (const std::size_t m : set_.members)
        if (m != member) others.push_back(m);
    const EffectSet rest = evaluate(*design_, others, search_options());
    const double contribution = set_.explained - rest.explained;
    struct Rival {
        std::string name;
        double evidence;
    };
    std::vector<Rival> rivals;
    double sum = 1.0;
    const auto& candidates = design_->candidates();
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        if (!candidates[k].visible || candidates[k].effect == candidates[member].effect) continue;
        const bool taken = std::any_of(others.begin(), others.end(), [&](std::size_t o) {
            return candidates[o].effect == candidates[k].effect;
        });
        if (taken) continue;
        std::vector<std::size_t> members = others;
        members.push_back(k);
        std::sort(members.begin(), members.end());
        const EffectSet swapped = evaluate(*design_, members, search_options());
        const double loss = set_.explained - swapped.explained;
        if (loss > std::clamp(rules::rival_part * contribution, rules::rival_loss,
                              std::max(rules::rival_loss, 0.3 * contribution)) ||
            loss > 0.3 * contribution)
            continue;
        const double worse = set_.log_evidence - swapped.log_evidence;
        const auto same = std::find_if(rivals.begin(), rivals.end(), [&](const Rival& r) {
            return r.name == candidates[k].effect->name;
        });
        if (same != rivals.end()) {
            same->evidence = std::min(same->evidence, worse);
            continue;
        }
        rivals.push_back({candidates[k].effect->name, worse});
    }
    std::sort(rivals.begin(), rivals.end(),
              [](const Rival& a, const Rival& b) { return a.evidence < b.evidence; });
    std::vector<std::string> names;
    for (const Rival& r : rivals) {
        sum += std::exp(-std::min(std::max(0.0, r.evidence), rules::parsimony_nats));
        names.push_back(r.name);
    }
    const double with = set_.log_evidence, without = rest.log_evidence;
    probability = 1.0 / (sum + std::exp(std::clamp(without - with, -50.0, 50.0)));
    return names;
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
    for (std::size_t k = 0; k < set_.members.size(); ++k) {
        const std::size_t m = set_.members[k];
        const Effect& effect = *design_->candidates()[m].effect;
        Cause cause;
        cause.effect = effect.name;
        cause.share = std::clamp(share[k] / gap, 0.0, 1.0);
        cause.rivals = rivals_of(m, cause.probability);
        cause.parameters = parameters_of(set_, m);
        cause.heldout = cross_validate(*design_, base_, folds_, {m}, set_.scale, noise_mm(), used_,
                                       options_.seed, noise_doubt());
        cause.what = effect.what;
        cause.usual_cause = effect.cause;
        cause.remedy = effect.remedy;
        result_.causes.push_back(std::move(cause));
    }
    std::stable_sort(result_.causes.begin(), result_.causes.end(),
                     [](const Cause& a, const Cause& b) { return a.share > b.share; });
}

void Diagnoser::add_unknown(double share, const std::vector<DriverTest>& left) {
    Cause cause;
    cause.effect = "unknown";
    cause.share = share;
    cause.probability = 1.0;
    cause.what = "A gap with structure that no effect of the catalogue explains";
    if (!left.empty()) cause.what += ": it " + left.front().text;
    cause.heldout = cross_validate(*design_, base_, folds_, {}, 1.0, noise_mm(), used_,
                                   options_.seed, noise_doubt());
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

/// What the chosen set explains only by parameters that let forms deviate from the textbook's, as
/// mean squared z.
double Diagnoser::unusual_square() const {
    std::vector<Eigen::Index> usual;
    for (const std::size_t m : set_.members) {
        const Candidate& c = design_->candidates()[m];
        for (Eigen::Index j = 0; j < c.size(); ++j)
            if (c.effect->parameters[c.parameters[static_cast<std::size_t>(j)]].usual)
                usual.push_back(c.first + j);
    }
    const auto all = columns_of(*design_, set_.members);
    if (usual.size() == all.size()) return 0.0;
    const double lost = static_cast<double>(replay_.size()) - design_->freedom();
    const double with =
        mean_square(design_->residual(all, set_.scale), lost + static_cast<double>(all.size()));
    const double without =
        mean_square(design_->residual(usual, set_.scale), lost + static_cast<double>(usual.size()));
    return std::max(0.0, without - with);
}

/// What a ripple explains that stands beside positioning errors of the same axis while that axis
/// stood in few places: any function of so few places can be written so.
double Diagnoser::aliased_square() const {
    const auto has = [&](const std::string& name) {
        return std::any_of(set_.members.begin(), set_.members.end(), [&](std::size_t m) {
            return design_->candidates()[m].effect->name == name;
        });
    };
    double sum = 0.0;
    for (const std::size_t m : set_.members) {
        const Effect& effect = *design_->candidates()[m].effect;
        const auto axis = axis_of(effect.name[0]);
        if (effect.name.find(".cyclic") == std::string::npos || !axis || !is_rotary(*axis) ||
            !has(effect.name.substr(0, 1) + ".positioning"))
            continue;
        std::set<long> places;
        for (std::size_t i = 0; i < replay_.size(); ++i)
            places.insert(std::lround(replay_.sample(i).position[*axis] * 1e4));
        if (places.size() > 30) continue;
        std::vector<std::size_t> others;
        for (const std::size_t o : set_.members)
            if (o != m) others.push_back(o);
        sum += std::max(0.0, left_square(others) - left_square(set_.members));
    }
    return sum;
}

/// What a further ripple (a keyed effect at keys not used yet) would explain of the remainder.
double Diagnoser::ripple_square(const Eigen::VectorXd& left) const {
    double most = 0.0;
    const double rows = static_cast<double>(replay_.size());
    for (const Effect& effect : catalogue_) {
        if (modelled(effect) || effect.name.find(".cyclic") == std::string::npos) continue;
        const auto keys = best_keys(replay_, base_, effect, left, sigma_mm_, 1);
        if (keys.empty()) continue;
        Eigen::MatrixXd a(left.size(), 2);
        for (Eigen::Index c = 0; c < 2; ++c)
            a.col(c) = effect_column(replay_, base_.gradient, effect, keys.front(),
                                     static_cast<std::size_t>(c));
        whitener_->apply(a);
        const Eigen::VectorXd h = a.transpose() * whitener_->apply(left);
        Eigen::Matrix2d information = a.transpose() * a;
        information.diagonal().array() += 1e-6;
        const double gain = h.dot(information.ldlt().solve(h));
        if (1e4 * chi_squared_tail(gain, 2.0) > rules::driver_p) continue;
        most = std::max(most, gain / rows * floor_square());
    }
    return most;
}

/// Several effects that all follow one driver, none of them the main one: a coincidence that rather
/// says that something unknown follows that driver.
bool Diagnoser::coincidence() const {
    if (result_.causes.size() < 3) return false;
    const double top = result_.causes.front().share;
    if (result_.causes.size() >= 4) return top < 0.6;
    if (top >= 0.6 || result_.where.empty()) return false;
    double sum = 0.0;
    for (const Cause& cause : result_.causes) sum += cause.share;
    return result_.where.front().share >= 0.95 * sum;
}

Diagnoser::Remainder Diagnoser::remainder() {
    Remainder r;
    const Eigen::VectorXd left = left_after(set_);
    r.drivers = test_drivers(replay_, table_, base_, known_columns(set_), left, base_.sigma_mm,
                             used_, *whitener_);
    std::erase_if(r.drivers, [](const DriverTest& t) { return t.p_value > rules::driver_p; });
    r.base = left_square({});
    r.after = left_square(set_.members);
    r.floor = floor_square();
    r.structured = r.drivers.empty() ? 0.0 : std::max(0.0, r.drivers.front().explained);
    r.structured = std::max(r.structured, ripple_square(left));
    const bool trusted = noise_.source == NoiseSource::repeats;
    if (!trusted && r.structured == 0.0 && stated_noise_is_off())
        noise_.source = NoiseSource::assumed;
    // Without repeats a remainder without structure is noise, whatever was stated.
    double rows = 0.0;
    for (const NoiseBlock& block : blocks_)
        rows += noise_.of(block.device).independent(static_cast<double>(block.rows.size()));
    const double doubt = trusted ? 4.0 * std::hypot(noise_.doubt, std::sqrt(2.0 / rows)) : 1.1;
    double beyond = r.after - r.floor > doubt * r.floor ? r.after - r.floor : 0.0;
    // A stated noise may be wrong by 30 %: what is left beyond that is no noise.
    if (!trusted && base_.noise_given && r.after > rules::most_noise) beyond = r.after - 1.0;
    // A gap of structure alone, without any effect, must be plain to see.
    const double plain = set_.members.empty() ? rules::plain_square : rules::least_square;
    const double least = trusted ? std::max(plain, noise_.doubt) : plain;
    r.unexplained = std::max(r.structured > least * r.floor ? r.structured : 0.0, beyond);
    r.gap = std::max(1e-9, r.base - r.after) + r.unexplained;
    r.unexplained = std::min(r.gap, r.unexplained + unusual_square() + aliased_square());
    return r;
}

void Diagnoser::judge() {
    const Remainder r = remainder();
    describe_size(r);
    if (set_.members.empty() && r.unexplained == 0.0) {
        result_.verdict = Verdict::no_gap;
        write_setup();
        return;
    }
    describe_where();
    if (!set_.members.empty()) claim(r.gap);
    double explained = std::clamp(1.0 - r.unexplained / r.gap, 0.0, 1.0);
    if (coincidence()) explained = std::min(explained, result_.causes.front().share);
    result_.unexplained_share = 1.0 - explained;
    const bool rivalled = std::any_of(result_.causes.begin(), result_.causes.end(),
                                      [](const Cause& c) { return !c.rivals.empty(); });
    result_.verdict = explained >= 0.8   ? (rivalled ? Verdict::ambiguous : Verdict::explained)
                      : explained >= 0.5 ? Verdict::partly_explained
                                         : Verdict::unexplained;
    if (result_.unexplained_share > rules::admit_share)
        add_unknown(result_.unexplained_share, r.drivers);
    result_.after = cross_validate(*design_, base_, folds_, set_.members, set_.scale, noise_mm(),
                                   used_, options_.seed, noise_doubt());
    write_setup();
    if (options_.holdout) test_holdout();
    if (options_.plan_next) ask_next();
}

/// The first two rivals of each claim, with the measurement that would tell them from it.
void Diagnoser::ask_next() {
    std::vector<AmbiguousPair> pairs;
    const Eigen::VectorXd x = design_->solve(columns_of(*design_, set_.members), set_.scale);
    Eigen::Index at = design_->base_count();
    for (const std::size_t m : set_.members) {
        const Candidate& claimed = design_->candidates()[m];
        const auto cause =
            std::find_if(result_.causes.begin(), result_.causes.end(),
                         [&](const Cause& c) { return c.effect == claimed.effect->name; });
        for (std::size_t k = 0; k < 2 && cause != result_.causes.end() && k < cause->rivals.size();
             ++k)
            for (const Candidate& rival : design_->candidates()) {
                if (rival.effect->name != cause->rivals[k] || !rival.visible) continue;
                pairs.push_back({&claimed, x.segment(at, claimed.size()), &rival});
                break;
            }
        at += claimed.size();
    }
    result_.next = plan_next(*design_, base_, catalogue_, pairs, table_.rows.back().time_s);
}

void Diagnoser::describe_size(const Remainder& r) {
    result_.readings = replay_.size();
    result_.outliers = static_cast<std::size_t>(std::count(used_.begin(), used_.end(), false));
    result_.noise = noise_;
    result_.rms_um = rms_um(base_.residual_mm);
    result_.noise_um = rms_um(noise_mm());
    result_.excess_um = std::sqrt(
        std::max(0.0, result_.rms_um * result_.rms_um - result_.noise_um * result_.noise_um));
    result_.after_rms_um = rms_um(left_after(set_));
    result_.inseparable = base_.inseparable;
    for (const Candidate& c : design_->candidates())
        if (!c.visible && std::find(result_.unseen.begin(), result_.unseen.end(), c.effect->name) ==
                              result_.unseen.end())
            result_.unseen.push_back(c.effect->name);
    const auto width = static_cast<double>(columns_of(*design_, set_.members).size());
    result_.p_value = set_.members.empty()
                          ? (r.drivers.empty() ? 1.0 : r.drivers.front().p_value)
                          : std::min(1.0, 60.0 * chi_squared_tail(set_.explained, width));
}

/// Relative standard error of the noise variance: from repeats, or from the freedom that was left.
double Diagnoser::noise_doubt() const {
    if (noise_.source == NoiseSource::repeats) return noise_.doubt;
    double rows = 0.0;
    for (const NoiseBlock& block : blocks_)
        rows += noise_.of(block.device).independent(static_cast<double>(block.rows.size()));
    return std::sqrt(2.0 / std::max(1.0, rows));
}

void Diagnoser::test_holdout() {
    const ReadingTable& table = *options_.holdout;
    const Replay replay(base_.setup, table);
    const std::vector<double> before = replay.predict(base_.models);
    const Replay fitted(result_.setup, table);
    const std::vector<double> after = fitted.predict(active_models(result_.setup));
    SquaredSums sums;
    for (const NoiseBlock& block : noise_blocks(replay, table)) {
        double b = 0, a = 0, n = 0;
        const RowNoise noise = row_noise(base_.setup, table, replay);
        for (const Eigen::Index i : block.rows) {
            const auto k = static_cast<std::size_t>(i);
            const Reading& row = table.rows[replay.table_row(k)];
            if (!row.value_mm)
                throw InputError("a held-out row with a device but without value_mm",
                                 {table.path, row.line, 0});
            const double scale = noise_.of(block.device).scale;
            b += std::pow(*row.value_mm - before[k], 2);
            a += std::pow(*row.value_mm - after[k], 2);
            n += std::pow(scale * noise.sigma_mm(i), 2);
        }
        sums.before.push_back(b);
        sums.after.push_back(a);
        sums.noise.push_back(n);
        sums.rows.push_back(static_cast<double>(block.rows.size()));
    }
    result_.after = summarise(sums, options_.seed, noise_doubt());
    if (result_.causes.size() == 1) result_.causes.front().heldout = result_.after;
}

}  // namespace

const char* to_string(Verdict verdict) {
    switch (verdict) {
        case Verdict::no_gap:
            return "no-gap";
        case Verdict::explained:
            return "explained";
        case Verdict::partly_explained:
            return "partly-explained";
        case Verdict::ambiguous:
            return "ambiguous";
        case Verdict::unexplained:
            return "unexplained";
    }
    return "";
}

const char* to_string(NoiseSource source) {
    return source == NoiseSource::repeats ? "repeats"
           : source == NoiseSource::given ? "given"
                                          : "assumed";
}

Diagnosis diagnose(const Setup& setup, const ReadingTable& table, const DiagnosisOptions& options) {
    return Diagnoser(setup, table, options).run();
}

}  // namespace trunnion
