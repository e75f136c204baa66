#include "diagnosis/prepare/turning_points.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "records/samples.h"

namespace trunnion::diagnosis {
namespace {

constexpr std::size_t least_rows_for_each = 4;  ///< a coarser circle keeps them (assumed)

/// True where an axis that this reading depends on stands exactly at a turning point. A servo log
/// is of the axis in `feature` alone.
bool is_turning(const records::ReadingTable& table, const records::Reading& row,
                const AxisSample& sample) {
    return std::any_of(table.axes.begin(), table.axes.end(), [&](Axis axis) {
        const bool counts = row.device != records::Device::axis ||
                            table.names.find(row.feature) == std::optional(axis);
        return counts && sample.travel[index_of(axis)] == 0 && !sample.side_unknown[index_of(axis)];
    });
}

/// True where an axis sets off from its turning point at the first of three rows, or passes it
/// before the second one: it goes three times as far from the second to the third, or farther. From
/// a twentieth of a step behind it, the ratio is 2.8. By the positions alone: the sides in the
/// replay go on from the test before, where the last row of that was left out.
bool begins_at_vertex(const records::ReadingTable& table, std::size_t first) {
    constexpr double at_vertex = 2.8, least_mm = 1e-6;  // assumed
    return std::any_of(table.axes.begin(), table.axes.end(), [&](Axis axis) {
        const auto at = [&](std::size_t k) { return table.rows[first + k].commanded[axis]; };
        const double near = at(1) - at(0), far = at(2) - at(1);
        return std::abs(far) > least_mm && near * far >= 0.0 &&
               std::abs(far) >= at_vertex * std::abs(near);
    });
}

}  // namespace

std::optional<WithoutTurningPoints> without_turning_points(const records::ReadingTable& table) {
    const auto is_dense = [](const records::Reading& row) {
        return records::is_continuous(row.device);
    };
    if (std::none_of(table.rows.begin(), table.rows.end(), is_dense)) return std::nullopt;
    const std::vector<AxisSample> samples = records::samples_of(table);
    std::vector<std::size_t> turning;
    std::size_t dense = 0;
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        if (!is_dense(table.rows[i])) continue;
        ++dense;
        if (is_turning(table, table.rows[i], samples[i])) turning.push_back(i);
    }
    if (turning.empty() || turning.size() * least_rows_for_each > dense) return std::nullopt;
    WithoutTurningPoints rest{table, turning.size()};
    for (const std::size_t i : turning) {
        rest.table.rows[i].device = records::Device::none;
        rest.table.rows[i].value_mm.reset();
    }
    return rest;
}

std::vector<std::size_t> turning_starts(const Prepared& p) {
    const auto& rows = p.table.rows;
    std::vector<std::size_t> starts;
    for (std::size_t i = 0; i < p.replay.size(); ++i) {
        const std::size_t k = p.replay.table_row(i);
        if (rows[k].device == records::Device::ballbar && k + 2 < rows.size() &&
            (k == 0 || rows[k - 1].test != rows[k].test) && rows[k + 2].test == rows[k].test &&
            begins_at_vertex(p.table, k))
            starts.push_back(i);
    }
    return starts;
}

}  // namespace trunnion::diagnosis
