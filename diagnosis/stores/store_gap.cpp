#include "diagnosis/stores/store_gap.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "diagnosis/rules/rules.h"
#include "diagnosis/stores/store_sets.h"

namespace trunnion::diagnosis {
namespace {

using effects::EffectKind;

constexpr double least_mm = 1e-6;       ///< of a change
constexpr double resolution_mm = 1e-9;  ///< of its value: rounding of the equations

std::string name_of(const setup::StoreNumber& number) {
    const bool tool = number.place == tool_place;
    return identification::full_name({effects::word_of(kind_of(number)), parameter_of(number), "mm",
                                      tool ? -1 : number.component, 1.0, 0.0});
}

bool has(const std::vector<std::size_t>& members, std::size_t k) {
    return std::find(members.begin(), members.end(), k) != members.end();
}

std::vector<EffectKind> kinds_of(const PointEquations& e, const NumberSet& set) {
    std::vector<EffectKind> kinds;
    for (const std::size_t k : set.members)
        if (const EffectKind kind = kind_of(e.numbers[k]);
            std::find(kinds.begin(), kinds.end(), kind) == kinds.end())
            kinds.push_back(kind);
    return kinds;
}

/// Changes of all numbers together that no point shows.
void tell_null_space(const PointEquations& e, const NumberSet& set, StoreGap& gap) {
    for (const Eigen::VectorXd& v : set.null_space) {
        identification::Inseparable same;
        for (Eigen::Index k = 0; k < v.size(); ++k) {
            if (v(k) == 0.0) continue;
            same.names.push_back(name_of(e.numbers[set.members[static_cast<std::size_t>(k)]]));
            same.direction.push_back(v(k));
        }
        gap.unseen.push_back(std::move(same));
    }
}

/// Other sets that do the same: of the same stores (not told apart), or of others (rivals).
void compare_sets(const PointEquations& e, const std::vector<NumberSet>& sets, StoreGap& gap) {
    const std::vector<EffectKind> kinds = kinds_of(e, sets.front());
    for (std::size_t s = 1; s < sets.size(); ++s) {
        identification::Inseparable same;
        for (std::size_t k = 0; k < e.numbers.size(); ++k) {
            const int sign = static_cast<int>(has(sets.front().members, k)) -
                             static_cast<int>(has(sets[s].members, k));
            if (sign == 0) continue;
            same.names.push_back(name_of(e.numbers[k]));
            same.direction.push_back(sign);
        }
        gap.unseen.push_back(std::move(same));
        for (const EffectKind kind : kinds_of(e, sets[s]))
            if (std::find(kinds.begin(), kinds.end(), kind) == kinds.end() &&
                std::find(gap.rivals.begin(), gap.rivals.end(), kind) == gap.rivals.end())
                gap.rivals.push_back(kind);
    }
}

std::vector<DriverShare> shares_by_mode(const records::ReadingTable& table, const PointRows& rows,
                                        const std::vector<double>& before_um) {
    std::map<PositioningMode, double> squares;
    double sum = 0.0;
    for (std::size_t k = 0; k < rows.row.size(); ++k) {
        const double square = std::pow(before_um[rows.device[k]], 2);
        squares[table.rows[rows.row[k]].mode] += square;
        sum += square;
    }
    std::vector<DriverShare> list;
    for (const auto& [mode, square] : squares) {
        const std::string name(records::name_of(mode));
        if (square < 0.05 * sum) continue;
        list.push_back({"mode", name,
                        fmt::format("{:.0f} % of the gap are positions of another store under {}",
                                    100.0 * square / sum, name),
                        square / sum, 0.0});
    }
    return list;
}

/// The numbers of the set that are beyond their uncertainty; returns the differences left.
Eigen::VectorXd take_changes(const PointEquations& e, const NumberSet& set, StoreGap& gap) {
    Eigen::VectorXd left = e.difference;
    for (std::size_t k = 0; k < set.members.size(); ++k) {
        const auto at = static_cast<Eigen::Index>(set.members[k]);
        const auto own = static_cast<Eigen::Index>(k);
        const double change_mm = std::round(set.change_mm(own) / resolution_mm) * resolution_mm;
        const double sigma_mm = std::isnan(set.sigma_mm(own)) ? 0.0 : set.sigma_mm(own);
        if (std::abs(change_mm) < std::max(least_mm, rules::store_sigmas * sigma_mm)) continue;
        left -= e.columns.col(at) * change_mm;
        const setup::StoreNumber& number = e.numbers[set.members[k]];
        gap.changes.push_back({kind_of(number), number, change_mm, set.sigma_mm(own)});
    }
    return left;
}

/// Differences of the points that the change makes.
Eigen::VectorXd column_of(const PointEquations& e, const StoreChange& change) {
    const auto at = std::find_if(
        e.numbers.begin(), e.numbers.end(),
        [&](const setup::StoreNumber& number) { return number.name == change.store.name; });
    return e.columns.col(at - e.numbers.begin()) * change.change_mm;
}

}  // namespace

double mean_square_of(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double value : values) sum += value * value;
    return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
}

std::optional<StoreGap> store_gap(const setup::Setup& setup, const records::ReadingTable& table) {
    const PointRows rows = point_rows(table);
    if (!setup.probe || rows.row.empty()) return std::nullopt;
    const PointEquations e = point_equations(setup, table, rows);
    const std::vector<NumberSet> sets = smallest_sets(e);
    StoreGap gap;
    gap.places = static_cast<double>(rows.row.size()) / e.repeats;
    const Eigen::VectorXd left = take_changes(e, sets.front(), gap);
    const double size_mm = std::sqrt(e.square / static_cast<double>(e.difference.size()));
    if (gap.changes.empty() && size_mm < rules::strange_mm) return std::nullopt;
    gap.before_um = readings_um(setup, table, rows, e.difference);
    gap.after_um = readings_um(setup, table, rows, left);
    for (StoreChange& change : gap.changes)
        change.square_um2 = mean_square_of(readings_um(setup, table, rows, column_of(e, change)));
    gap.where = shares_by_mode(table, rows, gap.before_um);
    compare_sets(e, sets, gap);
    if (sets.front().members.size() > most_numbers) tell_null_space(e, sets.front(), gap);
    return gap;
}

std::vector<double> points_um(const setup::Setup& setup, const records::ReadingTable& table) {
    const PointRows rows = point_rows(table);
    if (!setup.probe || rows.row.empty()) return {};
    return readings_um(setup, table, rows, point_equations(setup, table, rows).difference);
}

setup::Setup with_stores(setup::Setup setup, const StoreGap& gap) {
    for (const StoreChange& change : gap.changes) add_to(setup, change.store, change.change_mm);
    return setup;
}

}  // namespace trunnion::diagnosis
