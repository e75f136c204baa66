#include "diagnosis/mistaken_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/alarm.h"
#include "base/rounded.h"
#include "diagnosis/doubted.h"
#include "diagnosis/groups/open_sides.h"
#include "diagnosis/prepare/outliers.h"
#include "diagnosis/prepare/thinning.h"
#include "diagnosis/rules/rules.h"
#include "diagnosis/search/solution.h"
#include "diagnosis/table_slips.h"
#include "identification/index_errors.h"
#include "identification/start_pose.h"

namespace trunnion::diagnosis {
namespace {

/// A fit of the set-up alone tells a wrong column on this many readings as well as on all.
constexpr std::size_t enough_readings = 600;
constexpr double to_the_noise = 1.3;  ///< left by causes that explain the readings
constexpr double absurd = 100.0;      ///< times the noise

/// Rms without the largest twentieth, which a few spoiled readings may be.
double trimmed_rms(std::vector<double> squares) {
    std::sort(squares.begin(), squares.end());
    squares.resize(squares.size() - squares.size() / 20);
    double sum = 0.0;
    for (const double square : squares) sum += square;
    return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(1, squares.size())));
}

/// ... of the device that is furthest off: the many readings of one say nothing of another's
/// columns. Of a device whose unit was changed in the old unit: that its values became smaller is
/// no fit.
double furthest_off(const emulator::Replay& replay, const Eigen::VectorXd& left,
                    const std::vector<bool>& used, const TableSlip& slip) {
    std::map<records::Device, std::vector<double>> squares;
    for (std::size_t i = 0; i < replay.size(); ++i)
        if (used.empty() || used[i])
            squares[replay.contact(i).device].push_back(
                std::pow(left(static_cast<Eigen::Index>(i)), 2));
    double most = 0.0;
    for (auto& [device, list] : squares)
        most = std::max(most,
                        trimmed_rms(std::move(list)) / (device == slip.device ? slip.factor : 1.0));
    return most;
}

/// Both tables are measured by the sigma of the table as it is: a wrong column that makes an axis
/// rest where it moves would turn its whole error into scatter at rest. Values in another unit
/// have a sigma of their own.
const Eigen::VectorXd& sigma_beside(const Eigen::VectorXd& as_is, const Eigen::VectorXd& right,
                                    const TableSlip& slip) {
    return slip.factor == 1.0 && as_is.size() == right.size() ? as_is : right;
}

struct LeftBySetUp {
    double left = 0.0;  ///< in sigma
    Eigen::VectorXd sigma_mm;
};

/// What the set-up alone leaves of a table with a slip undone; empty if it cannot be fitted.
/// `sigma_mm`: of the table as it is, or empty.
std::optional<LeftBySetUp> left_by_set_up(const setup::Setup& setup,
                                          const records::ReadingTable& as_is, const TableSlip& slip,
                                          const Eigen::VectorXd& sigma_mm) {
    try {
        const records::ReadingTable table = slip.undo ? undone(slip, as_is) : as_is;
        setup::Setup any = setup;
        any.model.allow_large = true;
        any =
            identification::with_start_poses(identification::with_index_errors(any, table), table);
        const emulator::Replay replay(any, table);
        const auto catalogue = effects::make_catalogue(any, effects::extent_of(any, table));
        const identification::BaseModel base =
            identification::fit_base(any, table, replay, catalogue, any.model.modelled);
        const double left = furthest_off(
            replay, base.residual_mm.cwiseQuotient(sigma_beside(sigma_mm, base.sigma_mm, slip)), {},
            slip);
        if (!std::isfinite(left)) return std::nullopt;
        return LeftBySetUp{left, base.sigma_mm};
    } catch (const InputError&) {
        return std::nullopt;  // no table of this machine
    }
}

/// False for values in a larger unit that agree far better with each other than any instrument of
/// this device reads: that they became smaller is all that speaks for the unit.
bool is_of_an_instrument(double left, const TableSlip& slip) {
    constexpr double finest = 0.1;  // of the noise of the device (assumed)
    return slip.factor >= 1.0 || left * slip.factor >= finest;
}

struct BestSlip {
    TableSlip slip;
    double before = 0.0, left = 0.0;  ///< in sigma of the table as it is
};

/// The change that leaves least. `noise`: of the readings, in sigma. Far from all readings a fit
/// takes long: with the work ended, none.
std::optional<BestSlip> best_slip(const setup::Setup& setup, const records::ReadingTable& all,
                                  double noise, const GoOn& go_on) {
    const auto fewer = thinned(all, enough_readings);
    const records::ReadingTable& table = fewer ? *fewer : all;
    const auto before = left_by_set_up(setup, table, {}, {});
    if (!before || before->left < rules::mistaken_sigmas * noise) return std::nullopt;
    std::optional<BestSlip> best;
    for (TableSlip& slip : slips_of(table)) {
        if (go_on && !go_on()) return std::nullopt;
        const auto left = left_by_set_up(setup, table, slip, before->sigma_mm);
        if (!left || left->left > rules::mistaken_left * before->left) continue;
        if (!is_of_an_instrument(left->left, slip)) continue;
        if (!best || left->left < best->left)
            best = BestSlip{std::move(slip), before->left, left->left};
    }
    if (best) best->before /= noise;
    if (best) best->left /= noise;
    return best;
}

/// True for a table that is not refused: one that is put right half only helps nobody.
bool is_of_this_machine(const setup::Setup& setup, const records::ReadingTable& table) {
    try {
        prepare(setup, table);
        return true;
    } catch (const InputError&) {
        return false;
    }
}

std::string sentence(const BestSlip& best) {
    return fmt::format(
        "The readings are no machine's as they stand: {}. With that undone the set-up alone leaves "
        "{} times their noise instead of {} times. Correct the table and diagnose it again",
        best.slip.words, three_digits(best.left), three_digits(best.before));
}

/// The same where causes explain the readings about as well.
std::string doubt(const BestSlip& best) {
    return fmt::format(
        "The table may be mistaken: {}. With that undone the set-up alone leaves {} times the "
        "noise instead of {} times, and causes explain the rest about as well. Look at the table",
        best.slip.words, three_digits(best.left), three_digits(best.before));
}

/// What a model leaves, in sigma, and how many columns it takes, those of the set-up included: a
/// wrong column may give the pose of a part more to follow.
struct Explained {
    double left = 0.0, columns = 0.0;
};

Explained explained_by(const Prepared& p, const SearchResult& found, const std::vector<bool>& used,
                       const TableSlip& slip, const Eigen::VectorXd& sigma_mm) {
    Explained e;
    e.columns = static_cast<double>(found.design.projection().rank());
    for (const std::size_t m : found.model.members)
        e.columns += static_cast<double>(found.design.group(m).columns());
    e.left = furthest_off(p.replay, rest_of(p, found.design, found.model).cwiseQuotient(sigma_mm),
                          used, slip);
    return e;
}

/// The same of the table put right: the machine has causes of its own beside the slip.
std::optional<Explained> explained_when_right(const BestSlip& best, const Prepared& as_is,
                                              double noise) {
    try {
        const records::ReadingTable right = undone(best.slip, as_is.table);
        Prepared p = prepare(as_is.replay.setup(), right);
        Round round{std::vector<bool>(p.replay.size(), true), {}, p.base.sigma_mm};
        round.noise = belief_of(p, p.base.residual_mm, round);
        leave_out(p, lone_probe_readings(p, round.used), round);
        take_promising_sides(p);
        KeySearch keys(p.replay, p.base);
        Searched s = search_of(p, round, keys, nullptr, {});
        return explained_by(p, {s.design, s.model}, round.used, best.slip,
                            noise * sigma_beside(as_is.base.sigma_mm, p.base.sigma_mm, best.slip));
    } catch (const InputError&) {
        return std::nullopt;
    }
}

/// The noise and the errors of the axes' places are larger than usual by one and the same factor of
/// a unit.
std::optional<MistakenTable> wrong_size(const Prepared& p, double left) {
    constexpr double noise_within = 2.5, location_within = 10.0;  // assumed
    if (!p.base.noise_given || setup::is_arm(p.base.setup.machine.chain)) return std::nullopt;
    double square = 0.0, count = 0.0;
    for (const identification::FitParameter& q : p.base.parameters)
        if (q.location && std::isfinite(q.sigma)) {
            square += std::pow(q.value / q.typical, 2);
            ++count;
        }
    const double location = std::sqrt(square / std::max(1.0, count));
    const auto is_about = [](double size, double unit, double within) {
        return size > unit / within && size < unit * within;
    };
    for (const auto& [factor, unit] : {std::pair(25.4, "inch"), std::pair(1000.0, "mm")})
        if (count > 0.0 && is_about(left, factor, noise_within) &&
            is_about(location, factor, location_within))
            return MistakenTable{
                fmt::format("The scatter of the readings and the places of the axes are both some "
                            "{:.0f} times as large as is usual: the values seem to be in another "
                            "unit (um or {} for mm)",
                            factor, unit),
                false};
    return std::nullopt;
}

}  // namespace

std::optional<MistakenTable> mistaken_table(const Prepared& p, const SearchResult& found,
                                            const std::vector<bool>& used) {
    const Eigen::VectorXd sigma = found.noise * p.base.sigma_mm;
    const double before =
        furthest_off(p.replay, set_up_left_mm(p, found.design).cwiseQuotient(sigma), used, {});
    const Explained now = explained_by(p, found, used, {}, sigma);
    if (before < rules::mistaken_sigmas) return std::nullopt;
    // What effects of usual size explain to the noise is no slip, unless it is absurd: then it may
    // be one.
    const std::vector<double> sizes = usual_sizes(found.design, found.model);
    const bool usual =
        std::all_of(sizes.begin(), sizes.end(), [](double size) { return size < rules::enormous; });
    const bool possible = usual && now.left < to_the_noise;
    if (possible && before < absurd) return std::nullopt;
    const auto best = best_slip(p.replay.setup(), p.table, found.noise, found.go_on);
    if (!best) return wrong_size(p, now.left);
    const auto right = explained_when_right(*best, p, found.noise);
    if (!right) return std::nullopt;
    // Two models of the same readings, each with its own noise: by the logarithm of what they
    // leave, and by the parameters that one has more. Poses and arcs tell independently.
    const auto blocks = static_cast<double>(p.folds.fold.size());
    const double right_left = std::max(1.0, right->left);
    const double evidence = blocks * std::log(std::max(1.0, now.left) / right_left) +
                            0.5 * (now.columns - right->columns) * std::log(std::max(2.0, blocks));
    // Beforehand a table is rarely mistaken; a tilt and an exchange of columns look alike.
    const double least = best->slip.of_unit ? 0.0 : -std::log(rules::mistaken_odds);
    if (evidence < least) return std::nullopt;
    const bool certain = !possible && evidence > rules::plain_evidence;
    return MistakenTable{certain ? sentence(*best) : doubt(*best), certain};
}

std::optional<MistakenTable> mistaken_table(const setup::Setup& setup,
                                            const records::ReadingTable& table, const GoOn& go_on) {
    // A few readings that are refused for their number say nothing of their unit: in a larger one
    // any error is less.
    const auto count = std::count_if(table.rows.begin(), table.rows.end(), [](const auto& row) {
        return row.device != records::Device::none;
    });
    if (static_cast<std::size_t>(count) < least_readings) return std::nullopt;
    const auto best = best_slip(setup, table, 1.0, go_on);
    if (!best || !is_of_this_machine(setup, undone(best->slip, table))) return std::nullopt;
    return MistakenTable{sentence(*best), true};
}

void tell_mistaken(const MistakenTable& mistaken, Diagnosis& d) {
    d.notes.push_back(mistaken.words);
    const double most = mistaken.certain ? rules::beside_mistaken : rules::claimed;
    bool told = false;
    for (Cause& cause : d.causes) {
        if (cause.effect == "unknown") {
            told = true;
            if (!mistaken.certain) continue;
            cause.what = mistaken.words;
            cause.rivals = {mistaken_readings};
            cause.probability = std::max(cause.probability.value(), 1.0 - rules::beside_mistaken);
            continue;
        }
        cause.probability = std::min(cause.probability.value(), most);
        std::erase(cause.rivals, mistaken_readings);
        cause.rivals.insert(cause.rivals.begin(), mistaken_readings);
    }
    if (!mistaken.certain && d.verdict == Verdict::explained) d.verdict = Verdict::ambiguous;
    if (told)
        std::stable_partition(d.causes.begin(), d.causes.end(),
                              [](const Cause& c) { return c.effect == "unknown"; });
}

}  // namespace trunnion::diagnosis
