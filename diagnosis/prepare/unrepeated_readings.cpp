#include "diagnosis/prepare/unrepeated_readings.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "diagnosis/prepare/cycle_zeros.h"
#include "diagnosis/prepare/outliers.h"
#include "diagnosis/rules/rules.h"
#include "estimation/quantiles.h"
#include "estimation/scatter.h"

namespace trunnion::diagnosis {
namespace {

constexpr double far_from_others = 5.0;  ///< deviations (assumed)
constexpr std::size_t least_repeats = 10;

/// Rows of one target from one side, by the first of them.
std::map<Eigen::Index, std::vector<Eigen::Index>> places_of(const std::vector<Stretch>& list) {
    std::map<Eigen::Index, Eigen::Index> first;
    std::map<Eigen::Index, std::vector<Eigen::Index>> places;
    for (const Stretch& s : list) {
        const Eigen::Index row = s.rows.front();
        const Eigen::Index place = first.try_emplace(s.before, s.before).first->second;
        first[row] = place;
        std::vector<Eigen::Index>& rows = places[place];
        if (rows.empty()) rows.push_back(s.before);
        rows.push_back(row);
    }
    return places;
}

/// The values of one place that are far from their median, by more than a digit; of two, both or
/// none.
std::vector<std::size_t> refuted_of(const std::vector<double>& values, double digit) {
    std::vector<std::size_t> list;
    if (values.size() == 2) {
        if (std::abs(values[0] - values[1]) > far_from_others * std::sqrt(2.0) + digit)
            list = {0, 1};
        return list;
    }
    const double middle = estimation::median(values);
    for (std::size_t k = 0; k < values.size(); ++k)
        if (std::abs(values[k] - middle) > far_from_others + digit) list.push_back(k);
    return list;
}

/// True when most of these rows are neighbours: more than two spoiled ones rarely are.
bool are_neighbours(const std::vector<std::size_t>& rows) {
    std::size_t pairs = 0;
    for (std::size_t k = 1; k < rows.size(); ++k) pairs += rows[k] - rows[k - 1] <= 2 ? 1 : 0;
    return rows.size() > 2 && 10 * pairs > 4 * rows.size();
}

}  // namespace

std::vector<std::size_t> unrepeated_readings(const Prepared& p, const std::vector<bool>& used) {
    if (p.cycle.empty()) return {};
    const RepeatedRows rows{p.replay, p.table, p.blocks, used, p.cycle, p.rounding_mm};
    const Eigen::VectorXd digit = last_digit(p.rounding_mm, p.base.sigma_mm);
    std::vector<std::size_t> spoiled;
    for (auto& [device, list] :
         differences_of(rows, compared_rows(p.blocks, used), p.base.residual_mm, p.base.sigma_mm)) {
        if (list.size() < least_repeats) continue;
        const RepeatScatter told = scatter_beside_zeros(
            p.cycle, p.base.sigma_mm, least_scatter(rows, p.base.sigma_mm, device), list);
        for (const auto& [first, place] : places_of(list)) {
            std::vector<double> values;
            double most_digit = 0.0;
            for (const Eigen::Index row : place) {
                values.push_back((p.base.residual_mm(row) - told.zero_mm(row)) /
                                 (told.deviation * p.base.sigma_mm(row)));
                most_digit = std::max(most_digit, digit(row) / told.deviation);
            }
            for (const std::size_t k : refuted_of(values, most_digit))
                spoiled.push_back(static_cast<std::size_t>(place[k]));
        }
    }
    std::sort(spoiled.begin(), spoiled.end());
    const auto all = static_cast<double>(std::count(used.begin(), used.end(), true));
    const bool many = static_cast<double>(spoiled.size()) > rules::most_doubtful * all;
    return many || are_neighbours(spoiled) ? std::vector<std::size_t>{} : spoiled;
}

}  // namespace trunnion::diagnosis
