// The pipeline: prepare -> noise -> search -> judgement -> claims -> interval -> verdict.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/alarm.h"
#include "diagnosis/added_noise.h"
#include "diagnosis/changes.h"
#include "diagnosis/diagnosis_report.h"
#include "diagnosis/groups/open_sides.h"
#include "diagnosis/mistaken_table.h"
#include "diagnosis/prepare/agreeing_visits.h"
#include "diagnosis/prepare/copies.h"
#include "diagnosis/prepare/outliers.h"
#include "diagnosis/prepare/spoiled_readings.h"
#include "diagnosis/prepare/stop_means.h"
#include "diagnosis/prepare/thinning.h"
#include "diagnosis/prepare/turning_points.h"
#include "diagnosis/prepare/unrepeated_readings.h"
#include "diagnosis/round.h"
#include "diagnosis/rules/rules.h"
#include "diagnosis/search/solution.h"
#include "diagnosis/store_causes.h"
#include "effects/settings.h"
#include "identification/row_noise.h"
#include "identification/time_constants.h"

namespace trunnion::diagnosis {
namespace {

/// From a longer table this number is selected evenly: enough to identify causes of a hundredth of
/// the noise.
constexpr std::size_t most_readings = 10000;
constexpr int most_rounds = 3;       ///< of search, noise and linearisation
constexpr double most_bent = 3.0;    ///< growth of the residual by a prediction that is not linear
constexpr double fits_within = 3.0;  ///< deviations: a reading that was set aside fits a model
constexpr double explained_left = 1.2;  ///< noise of a model that explains doubtful readings, in
                                        ///< robust deviations
constexpr double bend_sigma = 0.25;     ///< of a reading: a smaller nonlinearity is ignored

/// Large effects make the readings nonlinear (the stylus touches the sphere off-axis): replaces the
/// linear prediction of the model by that of the emulator. False when the change was negligible.
/// One setup is used for all sessions here, so changes between them remain linear.
bool straighten(Prepared& p, Searched& s) {
    const Solution solution = without_changes(s.design, s.model, solved(s.design, s.model));
    const setup::Setup setup = setup_with(p, s.design, s.model, solution);
    const std::vector<double> read = p.replay.predict(
        setup.machine, identification::offsets_to(p.replay, setup), effects::active_models(setup));
    const Eigen::Map<const Eigen::VectorXd> bent(read.data(), p.base.measured_mm.size());
    Eigen::VectorXd change = p.base.measured_mm - bent - left_mm(p, s.design, s.model, solution);
    // The emulator reads from the first row of a test, the columns of effects do not: only a zero.
    free_zeros(p.replay, p.base.sigma_mm, change);
    const Eigen::VectorXd straight = p.base.residual_mm + change;
    const auto whitened = [&](const Eigen::VectorXd& v) {
        return v.cwiseQuotient(p.base.sigma_mm).norm();
    };
    // Directions that the readings hardly show may be metres long: no machine is bent like that.
    if (!(whitened(straight) <= most_bent * whitened(p.base.residual_mm))) return false;
    if (change.cwiseQuotient(p.base.sigma_mm).cwiseAbs().maxCoeff() < bend_sigma) return false;
    p.base.residual_mm = straight;
    return true;
}

bool same_noise(const NoiseModel& a, const NoiseModel& b) {
    using enum records::Device;
    for (const records::Device device : {sphere, touch, ballbar, linear, angle, point, axis}) {
        const DeviceNoise &x = a.of(device), &y = b.of(device);
        if (std::abs(x.scale - y.scale) > 0.03 * x.scale) return false;
        if (std::abs(x.shared - y.shared) > 0.03) return false;
        if (std::abs(x.turned - y.turned) > 0.03) return false;
        if (x.shared > 0.03 && std::abs(x.memory - y.memory) > 0.03) return false;
    }
    return true;
}

/// A refusal says what is wrong with the table, if that is simple.
Prepared prepared_or_told(const setup::Setup& setup, const records::ReadingTable& table,
                          const GoOn& go_on) {
    try {
        return prepare(setup, table);
    } catch (const InputError& error) {
        const auto mistaken = mistaken_table(setup, table, go_on);
        if (!mistaken) throw;
        throw InputError(error.message + ". " + mistaken->words, error.where, error.line_text);
    }
}

/// Log likelihood of the readings of a search, comparable between searches in the same rows.
double likelihood_of(const Searched& s) {
    return s.model.score + s.setting.empty -
           0.5 * s.design.projection().beside(s.design.data()).squaredNorm();
}

/// Takes the search without doubtful readings where these are more probably spoiled than explained
/// by what the search with them found. True where they are left out.
bool leave_out_doubtful(const Prepared& p, const DoubtfulReadings& doubtful, Searched& s,
                        Round& round, const Again& again) {
    if (doubtful.rows.empty()) return false;
    const double left = s.model.variances.nu * doubtful.scale;
    const auto is_free = [&](std::size_t m) {
        const GroupKind kind = s.design.group(m).kind;
        return kind == GroupKind::table || kind == GroupKind::driver;
    };
    const bool free = std::any_of(s.model.members.begin(), s.model.members.end(), is_free);
    if (!free && left < explained_left * doubtful.usual) return false;  // these follow anything
    Round fewer = round;
    leave_out(p, doubtful.rows, fewer);
    Searched rest = again(p, fewer);
    const double spoiled = likelihood_of_spoiled(doubtful);
    if (likelihood_of(rest) + spoiled < likelihood_of(s) + rules::least_evidence) return false;
    s = std::move(rest);
    round = std::move(fewer);
    return true;
}

/// Set-up and the textbook effects that a search found, whitened.
LinearModel named_model(const Searched& s, std::size_t rows) {
    const auto n = static_cast<Eigen::Index>(rows);
    LinearModel model{s.design.known().topRows(n), s.design.data().head(n)};
    for (const std::size_t m : s.model.members) {
        if (s.design.group(m).kind != GroupKind::textbook) continue;
        const Eigen::MatrixXd own = s.design.columns(m).topRows(n);
        model.columns.conservativeResize(Eigen::NoChange, model.columns.cols() + own.cols());
        model.columns.rightCols(own.cols()) = own;
    }
    return model;
}

/// Doubtful beside the set-up alone, or else beside the named effects: a large one (the tilt of a
/// mount) hides them.
void leave_out_spoiled(const Prepared& p, Searched& s, Round& round, const Again& again) {
    DoubtfulReadings doubtful = doubtful_readings(p, set_up_of(p.base), round.used);
    if (!doubtful.rows.empty())
        doubtful.scale = round.noise.model.of(p.replay.contact(doubtful.rows.front()).device).scale;
    if (leave_out_doubtful(p, doubtful, s, round, again)) return;
    const LinearModel named = named_model(s, round.used.size());
    if (named.columns.cols() == s.design.known().cols()) return;
    leave_out_doubtful(p, doubtful_readings(p, named, round.used), s, round, again);
}

/// Takes readings in again that were set aside beside the set-up alone, and fit the model: they
/// were far from what it leaves out. True if there are any.
bool take_in_again(const Prepared& p, const Eigen::VectorXd& left_mm, const Searched& s,
                   Round& round) {
    bool any = false;
    for (std::size_t i = 0; i < round.used.size(); ++i) {
        const auto row = static_cast<Eigen::Index>(i);
        const double noise = p.base.sigma_mm(row) * s.model.variances.nu *
                             round.noise.model.of(p.replay.contact(i).device).scale;
        if (round.used[i] || std::abs(left_mm(row)) > fits_within * noise) continue;
        round.used[i] = any = true;
        round.sigma_mm(row) = p.base.sigma_mm(row);
    }
    return any;
}

/// Applies what the first model reveals about the round: outliers, other noise, nonlinear readings.
/// False: no further search is needed.
bool corrected(Prepared& p, Searched& s, Round& round) {
    const Eigen::VectorXd left = rest_of(p, s.design, s.model);
    bool changed = !s.model.members.empty() && take_in_again(p, left, s, round);
    const Sizes sizes =
        sizes_of(s.design, s.model, 1.0, std::vector<bool>(s.model.members.size(), false));
    // Noise that nobody states may be far below what is usual of the device.
    const bool assumed = round.noise.model.source == NoiseSource::assumed;
    const double least = assumed ? std::min(1.0, s.model.variances.nu) : 1.0;
    const Eigen::VectorXd digit = last_digit(p.rounding_mm, p.base.sigma_mm);
    const Eigen::VectorXd rest = sizes.remainder.head(left.size()) / least;
    const auto wild = without_agreeing(
        p, round.used,
        wild_readings({rest, digit, devices_of(p.replay)}, round.used,
                      rules::most_outliers * static_cast<double>(round.used.size())),
        rest);
    if (!wild.empty()) {
        leave_out(p, wild, round);
        changed = true;
    }
    if (round.noise.model.source == NoiseSource::repeats && (!s.model.members.empty() || changed)) {
        const NoiseBelief noise = belief_of(p, left, round);
        if (!same_noise(noise.model, round.noise.model)) {
            round.noise = noise;
            changed = true;
        }
    }
    if (!s.model.members.empty() && straighten(p, s)) changed = true;
    return changed;
}

/// The report; causes explain nothing of a table that is mistaken.
Diagnosis reported(const Outcome& f, DiagnosisOptions options) {
    const auto mistaken = mistaken_table(
        f.prepared, {f.design, f.model, std::exp(f.noise.prior.log_mean), options.go_on}, f.used);
    if (!mistaken) return report_of(f, options);
    Judgement judgement = f.judgement;
    if (mistaken->certain) {
        judgement.part = judgement.beside_zeros = 0.0;
        options.plan_next = false;
    }
    Diagnosis d = report_of({f.prepared, f.design, f.setting, f.model, judgement, f.noise, f.used,
                             f.beside_set_up, f.found},
                            options);
    tell_mistaken(*mistaken, d);
    return d;
}

/// All readings but those that are wrong beside the set-up or their own repeats.
Round first_round(const Prepared& p, bool over_sessions) {
    Round round{std::vector<bool>(p.replay.size(), true), {}, p.base.sigma_mm, over_sessions};
    round.noise = belief_of(p, p.base.residual_mm, round);
    leave_out(p, lone_probe_readings(p, round.used), round);
    leave_out(p, unrepeated_readings(p, round.used), round);
    pass_over(p, turning_starts(p), round);
    return round;
}

Diagnosis answer_of(const setup::Setup& setup, const records::ReadingTable& table,
                    const DiagnosisOptions& options);

/// The answer for the table with its files as sessions, without copies, with one reading for each
/// stop or with fewer rows; none where it stays as it is.
std::optional<Diagnosis> answer_for_other(const setup::Setup& setup,
                                          const records::ReadingTable& table,
                                          const DiagnosisOptions& options) {
    if (options.over_sessions)
        if (const auto named = files_as_sessions(table)) return answer_of(setup, *named, options);
    if (const auto once = without_copies(table)) {
        Diagnosis d = answer_of(setup, *once, options);
        d.copies = table.rows.size() - once->rows.size();
        return d;
    }
    const auto stated = [&](const records::Reading& row) {
        return identification::states_noise(setup, row);
    };
    if (const auto stops = means_of_stops(table, stated)) {
        Diagnosis d = answer_of(setup, stops->table, options);
        d.notes.push_back(
            fmt::format("{} readings were taken while the axes stood; {} means stand for them: "
                        "readings of one stop share what the machine does not repeat",
                        stops->readings, stops->means));
        return d;
    }
    if (const auto fewer = thinned(table, most_readings, setup.time_constant_s)) {
        Diagnosis d = answer_of(setup, *fewer, options);
        d.chosen_from = static_cast<std::size_t>(std::count_if(
            table.rows.begin(), table.rows.end(),
            [](const records::Reading& row) { return row.device != records::Device::none; }));
        return d;
    }
    if (const auto rest = without_turning_points(table)) {
        Diagnosis d = answer_of(setup, rest->table, options);
        d.notes.push_back(
            fmt::format("{} readings at exact turning points of an axis are left out: they do not "
                        "tell on which side of its play it stands",
                        rest->readings));
        return d;
    }
    return std::nullopt;
}

/// The answer for a setup that has the time constants of its drives.
Diagnosis answer_of(const setup::Setup& setup, const records::ReadingTable& table,
                    const DiagnosisOptions& options) {
    if (auto other = answer_for_other(setup, table, options)) return std::move(*other);
    const auto watch = [&](const char* stage) {
        if (options.watch) options.watch(stage);
    };
    Prepared p = prepared_or_told(setup, table, options.go_on);
    if (options.holdout) refuse_poor_holdout(p, *options.holdout);
    if (options.over_sessions) refuse_one_session(p);
    Round round = first_round(p, options.over_sessions);
    take_promising_sides(p);
    std::optional<KeySearch> keys;
    int searches = 0;
    const Again again = [&](const Prepared& weighted, const Round& other) {
        ++searches;
        keys.emplace(weighted.replay, weighted.base);  // its columns are weighted
        return search_of(weighted, other, *keys, nullptr, options.go_on);
    };
    watch("search among models");
    Searched s = again(p, round);
    add_noise(p, s, round, again);
    leave_out_spoiled(p, s, round, again);
    if (searches > 1) keys.emplace(p.replay, p.base);
    const std::vector<bool> beside_set_up = round.used;
    const auto stopped = [&] { return options.go_on && !options.go_on(); };
    for (int k = 1; k < most_rounds && !stopped(); ++k) {
        const bool turned = retake_sides(p, s.design, s.model);
        if (turned) keys.emplace(p.replay, p.base);  // its columns were computed for other sides
        if (!corrected(p, s, round) && !turned) break;
        s = search_of(p, round, *keys, &s, options.go_on);
    }
    const bool unfinished = stopped();
    if (unfinished) s.model = computable(s.design, s.setting, std::move(s.model));
    watch("held-out readings");
    s.setting.go_on = options.go_on;
    FoldColumns rows(s.design, {p.folds, round.used});
    const Challenged found = unfinished ? unchallenged(std::move(s.model))
                                        : challenged(rows, s.setting, std::move(s.model));
    s.setting.go_on = {};
    const Judgement judgement = judged(rows, p, found.model, round.noise);
    Diagnosis d = reported({p, s.design, s.setting, found.model, judgement, round.noise, round.used,
                            beside_set_up, found},
                           options);
    d.unfinished = found.ended;  // else only the next measurement may be missing
    if (const auto gap = store_gap(setup, table)) add_store_gap(setup, *gap, options.holdout, d);
    return d;
}

}  // namespace

Diagnosis diagnose(const setup::Setup& setup, const records::ReadingTable& table,
                   const DiagnosisOptions& options) {
    return answer_of(identification::with_time_constants(setup, table), table, options);
}

}  // namespace trunnion::diagnosis
