#include "diagnosis/added_noise.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "diagnosis/prepare/near_readings.h"
#include "estimation/quantiles.h"

namespace trunnion::diagnosis {
namespace {

constexpr double clear_evidence = 6.0;  ///< nats (assumed)
constexpr double worth_a_search = 1.0;  ///< nats beside a model that may follow the noise (assumed)
constexpr double least_different = 1.5;  ///< ratio of stated sigmas, unsure to sure (assumed)
constexpr double same_size = 0.1;        ///< relative: no other noise than that known already
constexpr int steps = 24;                ///< of the grid of sizes

/// Whitened rows of a search, whitened otherwise.
struct Change {
    std::function<void(Eigen::MatrixXd&)> apply;
    double log_determinant = 0.0;
};

/// The whitened rows of a search under another noise of each row.
class OtherNoise {
  public:
    OtherNoise(const Searched& s, Model model)
        : s_(s), model_(std::move(model)), data_(s.design.data()) {
        Eigen::Index width = 0;
        for (const std::size_t m : model_.members) width += s.design.group(m).columns();
        columns_.resize(data_.size(), width);
        for (Eigen::Index at = 0; const std::size_t m : model_.members) {
            const Eigen::MatrixXd& own = s.design.columns(m);
            columns_.middleCols(at, own.cols()) = own;
            size_.push_back(own.cols());
            at += own.cols();
        }
    }

    struct Fit {
        double likelihood = 0.0;  ///< restricted, comparable between noises
        double nu = 1.0;
        Eigen::VectorXd left;  ///< whitened by this noise
    };
    Fit under(const Change& change) const {
        const auto changed = [&](Eigen::MatrixXd m) {
            change.apply(m);
            return m;
        };
        const Eigen::MatrixXd known = changed(s_.design.projection().basis());
        const Eigen::LLT<Eigen::MatrixXd> root(known.transpose() * known);
        const Eigen::MatrixXd basis = root.matrixL().solve(known.transpose()).transpose();
        const auto beside = [&](const Eigen::MatrixXd& m) -> Eigen::MatrixXd {
            const Eigen::MatrixXd other = changed(m);
            return other - basis * (basis.transpose() * other);
        };
        const Eigen::MatrixXd a = beside(columns_);
        const Eigen::VectorXd y = beside(data_);
        const estimation::GroupEquations e{a.transpose() * a, a.transpose() * y, y.squaredNorm(),
                                           s_.design.freedom(), size_};
        const estimation::BestVariances best =
            estimation::maximise_likelihood(e, model_.variances, s_.setting.noise, sweeps);
        Fit fit{best.likelihood - 0.5 * e.square + change.log_determinant -
                    root.matrixLLT().diagonal().array().log().sum(),
                best.variances.nu, y};
        if (a.cols() > 0) fit.left -= a * best.mean;
        return fit;
    }

  private:
    static constexpr int sweeps = 3;
    const Searched& s_;
    Model model_;
    Eigen::VectorXd data_;
    Eigen::MatrixXd columns_;
    std::vector<Eigen::Index> size_;
};

/// Rows of a device that take part.
std::vector<Eigen::Index> rows_of(const Prepared& p, const Round& round, records::Device device) {
    std::vector<Eigen::Index> rows;
    for (std::size_t i = 0; i < round.used.size(); ++i)
        if (round.used[i] && p.replay.contact(i).device == device)
            rows.push_back(static_cast<Eigen::Index>(i));
    return rows;
}

/// To this noise in addition in these rows, mm or rad.
Change with_added(const Prepared& p, const std::vector<Eigen::Index>& rows, double added) {
    Eigen::VectorXd times(static_cast<Eigen::Index>(rows.size()));
    for (Eigen::Index k = 0; k < times.size(); ++k) {
        const Eigen::Index i = rows[static_cast<std::size_t>(k)];
        times(k) = p.base.sigma_mm(i) / std::hypot(p.stated_sigma_mm(i), added);
    }
    return {[times, &rows](Eigen::MatrixXd& m) {
                for (Eigen::Index k = 0; k < times.size(); ++k)
                    m.row(rows[static_cast<std::size_t>(k)]) *= times(k);
            },
            times.array().log().sum()};
}

/// Stated sigmas of the sure and of the unsure rows, mm or rad.
struct StatedSigmas {
    double sure = 0.0, unsure = 0.0;
};

/// None where the rows state about the same.
std::optional<StatedSigmas> differing(const Prepared& p, const std::vector<Eigen::Index>& rows) {
    if (rows.size() < 2) return std::nullopt;
    std::vector<double> stated;
    for (const Eigen::Index i : rows) stated.push_back(p.stated_sigma_mm(i));
    const StatedSigmas sigmas{estimation::quantile(stated, 0.1), estimation::quantile(stated, 0.9)};
    if (sigmas.unsure < least_different * sigmas.sure) return std::nullopt;
    return sigmas;
}

/// The noise to add to a device, mm or rad; 0 where the readings need none.
double added_to(const Prepared& p, const OtherNoise& noise, const std::vector<Eigen::Index>& rows) {
    const std::optional<StatedSigmas> stated = differing(p, rows);
    if (!stated) return 0.0;
    const double without = noise.under(with_added(p, rows, 0.0)).likelihood;
    const double low = 0.1 * stated->sure, high = 10.0 * stated->unsure;
    double best = without, added = 0.0;
    for (int k = 0; k <= steps; ++k) {
        const double trial = low * std::pow(high / low, static_cast<double>(k) / steps);
        const double value = noise.under(with_added(p, rows, trial)).likelihood;
        if (value > best) std::tie(best, added) = std::pair(value, trial);
    }
    return best < without + worth_a_search ? 0.0 : added;
}

/// Gives each device the noise that adds to its rows. False where none changes.
bool give_added(Prepared& p, const OtherNoise& noise, Round& round) {
    bool changed = false;
    for (const records::Device device : {records::Device::angle, records::Device::point}) {
        const std::vector<Eigen::Index> rows = rows_of(p, round, device);
        const double added = added_to(p, noise, rows), known = p.added(device);
        if (std::abs(added - known) <= same_size * std::max(added, known)) continue;
        p.added_mm[device] = added;
        changed = true;
        for (std::size_t i = 0; i < round.used.size(); ++i) {
            if (p.replay.contact(i).device != device) continue;
            const auto row = static_cast<Eigen::Index>(i);
            const double part = round.sigma_mm(row) / p.base.sigma_mm(row);
            p.base.sigma_mm(row) = std::hypot(p.stated_sigma_mm(row), added);
            round.sigma_mm(row) = part * p.base.sigma_mm(row);
        }
    }
    return changed;
}

/// Stops of all points that take part; empty where they do not hold more readings than directions.
std::vector<NoiseBlock> full_stops(const Prepared& p, const Round& round) {
    constexpr std::size_t least_stops = 4, least_beyond = 12, most_of_one = 300;  // assumed
    std::vector<NoiseBlock> stops = stops_of(p.blocks, p.replay);
    std::erase_if(stops, [](const NoiseBlock& b) { return b.device != records::Device::point; });
    std::size_t full = 0, beyond = 0;
    for (const NoiseBlock& stop : stops) {
        if (stop.rows.size() > most_of_one) return {};
        const auto used = static_cast<std::size_t>(
            std::count_if(stop.rows.begin(), stop.rows.end(),
                          [&](Eigen::Index i) { return round.used[static_cast<std::size_t>(i)]; }));
        if (used <= 3) continue;
        ++full;
        beyond += used - 3;
    }
    const bool enough = full >= least_stops && beyond >= least_beyond;
    if (!enough || differing(p, rows_of(p, round, records::Device::point))) return {};
    return stops;
}

/// Variances of a stop, its shift and its rotation, in that of a single reading.
struct StopVariance {
    double shift = 0.0, turn = 0.0;
    double all() const { return 1.0 + shift + turn; }
};

/// What repeats tell is the variance of all, else what is stated is that of a single reading.
DeviceNoise noise_with(const StopVariance& v, bool repeated) {
    DeviceNoise noise{repeated ? 1.0 : std::sqrt(v.all()), v.shift / v.all(), 0.0};
    noise.turned = v.turn / v.all();
    return noise;
}

Eigen::MatrixXd root_of(const Prepared& p, const NoiseBlock& stop, const DeviceNoise& noise) {
    return Eigen::LLT<Eigen::MatrixXd>(shared_covariance(p.replay, stop.rows, noise)).matrixL();
}

/// To other variances of the stops.
Change with_shared(const Prepared& p, const std::vector<NoiseBlock>& stops, const Round& round,
                   const StopVariance& v) {
    const bool repeated = round.noise.model.source == NoiseSource::repeats;
    const double alone = 1.0 - round.shared_by_stops - round.turned_by_stops;
    const DeviceNoise now =
        noise_with({round.shared_by_stops / alone, round.turned_by_stops / alone}, repeated);
    const DeviceNoise other = noise_with(v, repeated);
    std::vector<Eigen::MatrixXd> turns;
    double log_determinant = 0.0;
    for (const NoiseBlock& stop : stops) {
        const Eigen::MatrixXd from = root_of(p, stop, now), to = root_of(p, stop, other);
        log_determinant += (from.diagonal().array() / to.diagonal().array()).log().sum();
        turns.push_back(to.triangularView<Eigen::Lower>().solve(from));
    }
    return {[turns = std::move(turns), &stops](Eigen::MatrixXd& m) {
                for (std::size_t b = 0; b < stops.size(); ++b)
                    m(stops[b].rows, Eigen::all) = (turns[b] * m(stops[b].rows, Eigen::all)).eval();
            },
            log_determinant};
}

/// Gives the stops of points their variances. False where none changes.
bool give_shared(Prepared& p, const OtherNoise& noise, Round& round) {
    constexpr int sizes = 10;
    const std::vector<NoiseBlock> stops = full_stops(p, round);
    if (stops.empty()) return false;
    const auto likelihood = [&](const StopVariance& v) {
        return noise.under(with_shared(p, stops, round, v)).likelihood;
    };
    const double without = likelihood({});
    double best = without;
    StopVariance found;
    for (const auto part : {&StopVariance::shift, &StopVariance::turn, &StopVariance::shift})
        for (int k = 0; k <= sizes; ++k) {
            StopVariance trial = found;  // deviations of 0.2 to 30, and none
            trial.*part =
                k == 0 ? 0.0 : std::pow(0.2 * std::pow(150.0, (k - 1.0) / (sizes - 1)), 2);
            if (const double value = likelihood(trial); value > best)
                std::tie(best, found) = std::pair(value, trial);
        }
    if (best < without + worth_a_search) found = {};
    const double shared = found.shift / found.all(), turned = found.turn / found.all();
    if (shared == round.shared_by_stops && turned == round.turned_by_stops) return false;
    round.shared_by_stops = shared;
    round.turned_by_stops = turned;
    return true;
}

/// What is believed of the rows.
struct Belief {
    Eigen::VectorXd sigma_mm;
    std::map<records::Device, double> added_mm;
    Round round;
};

Belief belief_now(const Prepared& p, const Round& round) {
    return {p.base.sigma_mm, p.added_mm, round};
}

void believe(const Belief& belief, Prepared& p, Round& round) {
    p.base.sigma_mm = belief.sigma_mm;
    p.added_mm = belief.added_mm;
    round = belief.round;
}

/// From the whitened rows of one belief to those of the present one.
Change from_belief(const Prepared& p, const Belief& before, const Round& round,
                   const std::vector<NoiseBlock>& stops) {
    Eigen::VectorXd times = before.round.sigma_mm.cwiseQuotient(round.sigma_mm);
    std::vector<Eigen::MatrixXd> turns;
    double log_determinant = 0.0;
    const auto alone = [](const DeviceNoise& noise) { return noise.shared + noise.turned <= 0.0; };
    for (const NoiseBlock& stop : stops) {
        const DeviceNoise &from = before.round.noise.model.of(stop.device),
                          &to = round.noise.model.of(stop.device);
        const bool shares = stop.device == records::Device::point;
        if (!shares || (alone(from) && alone(to))) {
            times(stop.rows) *= from.scale / to.scale;
            turns.emplace_back();
            continue;
        }
        const Eigen::MatrixXd old_root = root_of(p, stop, from), root = root_of(p, stop, to);
        turns.push_back(root.triangularView<Eigen::Lower>().solve(old_root));
        log_determinant += (old_root.diagonal().array() / root.diagonal().array()).log().sum();
    }
    log_determinant += times.array().log().sum();
    return {[times, turns = std::move(turns), &stops](Eigen::MatrixXd& m) {
                for (Eigen::Index i = 0; i < times.size(); ++i) m.row(i) *= times(i);
                for (std::size_t b = 0; b < stops.size(); ++b)
                    if (turns[b].size() > 0)
                        m(stops[b].rows, Eigen::all) =
                            (turns[b] * m(stops[b].rows, Eigen::all)).eval();
            },
            log_determinant};
}

double evidence_of(Searched& s) {
    return evidence(s.design, s.model) + s.setting.empty -
           0.5 * s.design.projection().beside(s.design.data()).squaredNorm();
}

/// Evidence of a search under the present belief against one under an earlier belief.
double gain_of(const Prepared& p, Searched& other, const Round& round, Searched& s,
               const Belief& before) {
    const std::vector<NoiseBlock> stops = stops_of(p.blocks, p.replay);
    const Change change = from_belief(p, before, round, stops);
    Eigen::MatrixXd known = s.design.projection().basis();
    change.apply(known);
    const Eigen::LLT<Eigen::MatrixXd> root(known.transpose() * known);
    return evidence_of(other) + change.log_determinant -
           root.matrixLLT().diagonal().array().log().sum() - evidence_of(s);
}

/// True where neighbours differ as the noise that was added to a device says, rather than as the
/// rows state. `s`: the search beside it, `stated`: that without.
bool confirmed(const Prepared& p, const Searched& s, const Round& round, records::Device device,
               const std::pair<const Belief&, double>& stated) {
    const Eigen::VectorXd left = OtherNoise(s, s.model).under({[](Eigen::MatrixXd&) {}, 0.0}).left;
    std::vector<bool> own(round.used.size(), false);
    Eigen::VectorXd left_mm = Eigen::VectorXd::Zero(p.base.sigma_mm.size());
    const double scale = round.noise.model.of(device).scale;
    for (const Eigen::Index i : rows_of(p, round, device)) {
        own[static_cast<std::size_t>(i)] = true;
        left_mm(i) = left(i) * scale * p.base.sigma_mm(i);
    }
    const auto off = [&](const Eigen::VectorXd& sigma_mm) {
        return std::abs(std::log(noise_of_neighbours(p.replay, own, left_mm, sigma_mm).variance));
    };
    const auto& [before, nu] = stated;
    const double old_scale = before.round.noise.model.of(device).scale;
    return off(s.model.variances.nu * scale * p.base.sigma_mm) <
           off(nu * old_scale * before.sigma_mm);
}

/// The same for all devices.
bool all_confirmed(const Prepared& p, const Searched& s, const Round& round,
                   const std::pair<const Belief&, double>& stated) {
    return std::all_of(p.added_mm.begin(), p.added_mm.end(), [&](const auto& added) {
        return added.second <= 0.0 || confirmed(p, s, round, added.first, stated);
    });
}

using Give = bool (*)(Prepared&, const OtherNoise&, Round&);

/// The model without free forms and drivers.
Model named_alone(const Searched& s) {
    Model model = s.model;
    for (std::size_t k = model.members.size(); k-- > 0;) {
        const GroupKind kind = s.design.group(model.members[k]).kind;
        if (kind == GroupKind::table || kind == GroupKind::driver) model = without(model, k);
    }
    return model;
}

/// The best search under a noise of one kind, if that is clear.
void search_again(Give give, Prepared& p, Searched& s, Round& round, const Again& again) {
    constexpr int most = 3;
    const Belief before = belief_now(p, round);
    std::optional<Searched> best;
    Belief believed = before;
    double most_gain = clear_evidence;
    const Searched* last = &s;
    std::optional<Searched> other;
    for (int k = 0; k < most; ++k) {
        // The first model may follow what is noise.
        const Model beside = k > 0 ? last->model : named_alone(s);
        if (!give(p, OtherNoise(*last, beside), round)) break;
        round.noise = belief_of(p, p.base.residual_mm, round);
        other.emplace(again(p, round));
        last = &*other;
        const double gain = gain_of(p, *other, round, s, before);
        if (gain <= most_gain || !all_confirmed(p, *other, round, {before, s.model.variances.nu}))
            continue;
        most_gain = gain;
        best = other;
        believed = belief_now(p, round);
    }
    believe(believed, p, round);
    if (best) s = std::move(*best);
}

}  // namespace

void add_noise(Prepared& p, Searched& s, Round& round, const Again& again) {
    search_again(give_added, p, s, round, again);
    if (p.added_mm.empty()) search_again(give_shared, p, s, round, again);
}

}  // namespace trunnion::diagnosis
