#include "identification/resolution.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <span>
#include <tuple>
#include <utility>

#include "base/units.h"
#include "emulator/device_noise.h"
#include "estimation/quantiles.h"

namespace trunnion::identification {

namespace {

bool is_multiple(double value, double steps) {
    constexpr double rounding = 1e-6;  // of a step: differences of large positions
    return std::abs(value * steps - std::round(value * steps)) <= rounding;
}

/// Standard deviation of a value by its last digit.
double spread_of(double step) {
    return step / std::sqrt(12.0);
}

/// Digits before the decimal point of the position of an axis row.
int digits_of(const records::Reading& row, const emulator::Contact& contact) {
    if (row.device != records::Device::axis) return 0;
    const double at = std::abs(row.commanded[contact.axis]);
    return static_cast<int>(std::log10(std::max(1.0, row.angular ? deg_from_rad(at) : at)));
}

/// The digits that count: of the value; of a servo log of both positions, whose difference is often
/// zero.
void add_numbers(const records::Reading& row, const emulator::Contact& contact,
                 std::vector<double>& values) {
    const auto in_degrees = [&](double v) { return row.angular ? deg_from_rad(v) : v; };
    if (row.device != records::Device::axis) return values.push_back(in_degrees(*row.value_mm));
    const double commanded = row.commanded[contact.axis];
    values.push_back(in_degrees(commanded));
    values.push_back(in_degrees(commanded + *row.value_mm));
}

}  // namespace

double decimal_step(const std::vector<double>& values) {
    constexpr std::size_t least = 5, many = 20;
    std::vector<double> moved;
    for (const double v : values)
        if (v != 0.0) moved.push_back(v);
    // A display that shows zero most of the time has digits as well: no other one does so.
    const bool mostly_zero = values.size() >= many && 2 * moved.size() < values.size();
    if (moved.empty() || (moved.size() < least && !mostly_zero)) return 0.0;
    for (double steps = 1.0; steps < 2e6; steps *= 10.0) {
        const auto on = std::count_if(moved.begin(), moved.end(),
                                      [&](double v) { return is_multiple(v, steps); });
        if (static_cast<double>(on) >= 0.95 * static_cast<double>(moved.size())) return 1.0 / steps;
    }
    return 0.0;
}

namespace {

/// The same in the units in which instruments show a value: mm and inch, or degrees, seconds of arc
/// and radians, in which a record kept its digits before it was converted.
double decimal_step_as_shown(const std::vector<double>& values, bool angular) {
    const double mm[] = {1.0, 25.4}, deg[] = {1.0, 1.0 / 3600.0, deg_from_rad(1.0)};
    double most = 0.0;
    for (const double unit : angular ? std::span<const double>(deg) : std::span<const double>(mm)) {
        std::vector<double> shown;
        for (const double v : values) shown.push_back(v / unit);
        most = std::max(most, unit * decimal_step(shown));
    }
    return most;
}

/// Sorts, and keeps one of values that differ by the rounding of a sum only.
void sort_apart(std::vector<double>& values) {
    constexpr double rounding = 1e-11;
    std::sort(values.begin(), values.end());
    const auto same = [](double a, double b) {
        return b - a <= rounding * std::max(1.0, std::abs(b));
    };
    values.erase(std::unique(values.begin(), values.end(), same), values.end());
}

/// True where so many different values, seen so often, are multiples of so many digits by no
/// chance. Values of neighbouring places may go together: half of them count.
bool are_counts(std::size_t values, std::size_t seen, double digits) {
    constexpr std::size_t fewest = 5;
    constexpr double least_chance = 2e-3;
    const double free =
        std::max(static_cast<double>(values) - 2.0, 0.5 * static_cast<double>(seen));
    return values >= fewest && std::pow(digits, -free) <= least_chance;
}

}  // namespace

double counter_step(std::vector<double> values, std::size_t seen) {
    constexpr double no_digits = 1e6;            // values of full precision
    constexpr double near = 0.25, exact = 1e-6;  // of a step: on the way, and in the end
    const double digit = decimal_step(values);
    sort_apart(values);
    double step = HUGE_VAL;
    for (std::size_t k = 1; k < values.size(); ++k)
        step = std::min(step, values[k] - values[k - 1]);
    // The step is refined as the values grow: its first estimate has the error of their digits.
    double along = 0.0, square = 0.0;
    for (const double v : values) {
        const double way = v - values.front(), count = std::round(way / step);
        if (!(std::abs(way - count * step) <= near * step)) return 0.0;
        along += way * count;
        square += count * count;
        if (square > 0.0) step = along / square;
    }
    double worst = 0.0;
    for (const double v : values) {
        const double count = (v - values.front()) / step;
        worst = std::max(worst, std::abs(count - std::round(count)));
    }
    if (!are_counts(values.size(), seen, digit > 0.0 ? step / digit : no_digits)) return 0.0;
    return worst <= exact + 0.6 * digit / step ? step : 0.0;  // rounded, the first value too
}

namespace {

/// Where, and for a log when, a value was read, and the value.
using Seen = std::tuple<std::array<double, axis_count>, double, double>;

/// True when each value was read twice on average, at different places or times.
bool are_met_again(std::vector<double> values, const std::set<Seen>& seen) {
    sort_apart(values);
    return seen.size() >= 2 * values.size();
}

}  // namespace

namespace {

/// True when neighbouring values are not the same distance apart: a log at constant speed without
/// noise has even steps, which are no counts.
bool vary(std::vector<double> values) {
    constexpr double even = 0.9;  // part of the steps
    sort_apart(values);
    if (values.size() < 3) return false;
    std::vector<double> steps;
    for (std::size_t k = 1; k < values.size(); ++k) steps.push_back(values[k] - values[k - 1]);
    const double usual = estimation::median(steps);
    const auto same = std::count_if(steps.begin(), steps.end(), [&](double step) {
        return std::abs(step - usual) < 0.25 * usual;
    });
    return static_cast<double>(same) < even * static_cast<double>(steps.size());
}

}  // namespace

Eigen::VectorXd rounding(const records::ReadingTable& table, const emulator::Replay& replay) {
    using Key = std::tuple<records::Device, std::string, int>;
    std::map<Key, std::vector<std::size_t>> alike;
    for (std::size_t i = 0; i < replay.size(); ++i)
        if (const records::Reading& row = table.rows[replay.table_row(i)]; row.value_mm)
            alike[{row.device, row.feature, digits_of(row, replay.contact(i))}].push_back(i);
    Eigen::VectorXd spread_mm = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(replay.size()));
    for (const auto& [of, rows] : alike) {
        const records::Reading& first = table.rows[replay.table_row(rows.front())];
        const bool log = first.device == records::Device::axis;
        std::vector<double> values, counts;
        std::set<Seen> seen;
        for (const std::size_t i : rows) {
            const records::Reading& row = table.rows[replay.table_row(i)];
            add_numbers(row, replay.contact(i), values);
            counts.push_back(values.back());
            seen.insert({row.commanded.value, log ? row.time_s : 0.0, counts.back()});
        }
        if (log) sort_apart(counts);
        const double digit = log ? decimal_step(counts) : 0.0;
        if (!are_met_again(counts, seen) && !(log && vary(counts))) counts.clear();
        // A log that stands still most of the time repeats a few round positions.
        if (log) {
            std::sort(values.begin(), values.end());
            values.erase(std::unique(values.begin(), values.end()), values.end());
        }
        const double spread = spread_of(
            std::max({log ? decimal_step(values) : decimal_step_as_shown(values, first.angular),
                      digit, counter_step(std::move(counts), log ? 0 : seen.size())}));
        for (const std::size_t i : rows)
            spread_mm(static_cast<Eigen::Index>(i)) = first.angular ? rad_from_deg(spread) : spread;
    }
    return spread_mm;
}

void add_rounding(const records::ReadingTable& table, const emulator::Replay& replay,
                  Eigen::VectorXd& sigma_mm) {
    const Eigen::VectorXd spread_mm = rounding(table, replay);
    for (Eigen::Index i = 0; i < sigma_mm.size(); ++i) {
        const auto& stated = table.rows[replay.table_row(static_cast<std::size_t>(i))].sigma_mm;
        if (!stated || *stated <= 0.0) sigma_mm(i) = std::max(sigma_mm(i), spread_mm(i));
    }
}

void add_rest_scatter(const setup::Setup& setup, const records::ReadingTable& table,
                      const emulator::Replay& replay, Eigen::VectorXd& sigma_mm) {
    constexpr std::size_t fewest = 10;
    constexpr double least_factor = 2.0;
    struct Log {
        std::vector<std::size_t> rows;
        std::vector<double> differences;  ///< of successive rows at rest, of one row's size
    };
    std::map<std::pair<std::string, std::string>, Log> logs;  // of each test and axis
    for (std::size_t i = 0; i < replay.size(); ++i) {
        const records::Reading& row = table.rows[replay.table_row(i)];
        if (row.device != records::Device::axis || !row.value_mm ||
            emulator::device_noise(setup.model, row).given)
            continue;
        logs[{row.test, row.feature}].rows.push_back(i);
    }
    for (auto& entry : logs) {
        Log& log = entry.second;
        const auto at = [&](std::size_t k) -> const records::Reading& {
            return table.rows[replay.table_row(log.rows[k])];
        };
        const auto commanded = [&](std::size_t k) {
            return at(k).commanded[replay.contact(log.rows[k]).axis];
        };
        for (std::size_t k = 2; k < log.rows.size(); ++k)
            if (commanded(k) == commanded(k - 1) && commanded(k) == commanded(k - 2))
                log.differences.push_back((*at(k).value_mm - *at(k - 1).value_mm) / std::sqrt(2.0));
        if (log.differences.size() < fewest) continue;
        const double scatter = estimation::robust_deviation(log.differences);
        for (const std::size_t i : log.rows) {
            double& sigma = sigma_mm(static_cast<Eigen::Index>(i));
            if (scatter >= least_factor * sigma) sigma = scatter;
        }
    }
}

}  // namespace trunnion::identification
