#include "diagnosis/prepare/spoiled_readings.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "diagnosis/prepare/agreeing_visits.h"
#include "diagnosis/prepare/outliers.h"
#include "diagnosis/rules/rules.h"
#include "estimation/quantiles.h"
#include "estimation/trimmed_fit.h"

namespace trunnion::diagnosis {
namespace {

constexpr double many_readings = 1000.0;  ///< of which a few spoil no fit
constexpr double far_off = 4.5;           ///< deviations of the others
constexpr double least_scale = 0.5;       ///< minimum of that deviation, in sigma ...
constexpr double least_assumed = 0.05;    ///< ... that nobody states

/// Residual of a fit to the rows of `used` without regard to the worst of them; 0 for other rows.
Eigen::VectorXd left_by(const LinearModel& model, const std::vector<bool>& used) {
    std::vector<Eigen::Index> rows;
    for (std::size_t i = 0; i < used.size(); ++i)
        if (used[i]) rows.push_back(static_cast<Eigen::Index>(i));
    const Eigen::VectorXd data = model.data(rows);
    Eigen::VectorXd left = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(used.size()));
    left(rows) = estimation::trimmed_residual(model.columns(rows, Eigen::all), data, data,
                                              rules::most_doubtful);
    return left;
}

/// True when the visits with these rows follow one another: more than two spoiled ones rarely do.
bool follow_one_another(const emulator::Replay& replay, const std::vector<std::size_t>& rows) {
    const std::vector<std::size_t> visit = visits_of(replay);
    std::vector<std::size_t> hit;
    for (const std::size_t i : rows)
        if (hit.empty() || hit.back() != visit[i]) hit.push_back(visit[i]);
    std::size_t pairs = 0;
    for (std::size_t k = 1; k < hit.size(); ++k) pairs += hit[k] - hit[k - 1] == 1 ? 1 : 0;
    return hit.size() > 2 && 10 * pairs > 4 * hit.size();
}

}  // namespace

LinearModel set_up_of(const identification::BaseModel& base) {
    const Eigen::VectorXd weight = base.sigma_mm.cwiseInverse();
    return {weight.asDiagonal() * base.columns, weight.cwiseProduct(base.residual_mm)};
}

DoubtfulReadings doubtful_readings(const Prepared& prepared, const LinearModel& model,
                                   const std::vector<bool>& used) {
    const emulator::Replay& replay = prepared.replay;
    const auto taken = [&](std::size_t i) {
        return used[i] && is_single(replay.contact(i).device);
    };
    std::vector<std::size_t> rows(used.size());
    std::iota(rows.begin(), rows.end(), std::size_t{0});
    std::erase_if(rows, [&](std::size_t i) { return !taken(i); });
    if (rows.empty()) return {};
    const Eigen::VectorXd left = left_by(model, used);
    std::vector<double> size;
    for (const std::size_t i : rows) size.push_back(std::abs(left(static_cast<Eigen::Index>(i))));
    DoubtfulReadings doubtful;
    doubtful.usual = std::max(prepared.base.noise_given ? least_scale : least_assumed,
                              estimation::robust_deviation(std::move(size)));
    const Eigen::VectorXd digit = last_digit(prepared.rounding_mm, prepared.base.sigma_mm);
    std::erase_if(rows, [&](std::size_t i) {
        const auto at = static_cast<Eigen::Index>(i);
        return std::abs(left(at)) <= far_off * doubtful.usual + digit(at);
    });
    doubtful.rows = without_agreeing(prepared, used, std::move(rows), left);
    for (const std::size_t i : doubtful.rows)
        doubtful.largest = std::max(doubtful.largest, std::abs(left(static_cast<Eigen::Index>(i))));
    const std::vector<std::size_t> visit = visits_of(replay);
    doubtful.all_visits = visit.empty() ? 0 : visit.back() + 1;
    std::size_t last = doubtful.all_visits;
    for (const std::size_t i : doubtful.rows)
        if (std::exchange(last, visit[i]) != visit[i]) ++doubtful.visits;
    const auto count = static_cast<double>(doubtful.rows.size()),
               all = static_cast<double>(std::count(used.begin(), used.end(), true));
    const bool few = count <= rules::most_outliers * all;
    if (doubtful.rows.empty() || (few && all > many_readings) ||
        count > rules::most_doubtful * all || follow_one_another(replay, doubtful.rows))
        return {};
    return doubtful;
}

double likelihood_of_spoiled(const DoubtfulReadings& doubtful) {
    const double width = 3.0 * doubtful.largest / doubtful.scale;
    const auto all = static_cast<double>(doubtful.all_visits),
               spoiled = static_cast<double>(doubtful.visits),
               rows = static_cast<double>(doubtful.rows.size());
    // The density of the other readings is without its factor (2 pi)^-1/2, so this one is, too.
    return rows * (0.5 * std::log(2.0 * std::numbers::pi) - std::log(width)) +
           spoiled * std::log(rules::spoiled_part) +
           (all - spoiled) * std::log1p(-rules::spoiled_part);
}

}  // namespace trunnion::diagnosis
