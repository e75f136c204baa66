#include "identification/resolution.h"

#include <algorithm>
#include <cmath>
#include <map>
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
    std::vector<double> moved;
    for (const double v : values)
        if (v != 0.0) moved.push_back(v);
    if (moved.size() < 5) return 0.0;
    for (double steps = 1.0; steps < 2e6; steps *= 10.0) {
        const auto on = std::count_if(moved.begin(), moved.end(),
                                      [&](double v) { return is_multiple(v, steps); });
        if (static_cast<double>(on) >= 0.95 * static_cast<double>(moved.size())) return 1.0 / steps;
    }
    return 0.0;
}

void add_rounding(const setup::Setup& setup, const records::ReadingTable& table,
                  const emulator::Replay& replay, Eigen::VectorXd& sigma_mm) {
    using Key = std::tuple<records::Device, std::string, int>;
    std::map<Key, std::vector<std::size_t>> alike;
    for (std::size_t i = 0; i < replay.size(); ++i) {
        const records::Reading& row = table.rows[replay.table_row(i)];
        if (!row.value_mm || (row.sigma_mm && *row.sigma_mm > 0.0)) continue;
        if (row.device == records::Device::axis || !emulator::device_noise(setup.model, row).given)
            alike[{row.device, row.feature, digits_of(row, replay.contact(i))}].push_back(i);
    }
    for (const auto& [of, rows] : alike) {
        const bool angular = table.rows[replay.table_row(rows.front())].angular;
        std::vector<double> values;
        for (const std::size_t i : rows)
            add_numbers(table.rows[replay.table_row(i)], replay.contact(i), values);
        // A log that stands still most of the time repeats a few round positions.
        if (table.rows[replay.table_row(rows.front())].device == records::Device::axis) {
            std::sort(values.begin(), values.end());
            values.erase(std::unique(values.begin(), values.end()), values.end());
        }
        const double spread = spread_of(decimal_step(values));
        for (const std::size_t i : rows) {
            double& sigma = sigma_mm(static_cast<Eigen::Index>(i));
            sigma = std::max(sigma, angular ? rad_from_deg(spread) : spread);
        }
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
