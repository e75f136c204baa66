#include "diagnosis/prepare/turning_points.h"

#include <algorithm>
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
    std::vector<std::size_t> starts;
    for (std::size_t i = 0; i < p.replay.size(); ++i) {
        const AxisSample& sample = p.replay.sample(i);
        const bool starts_there =
            std::any_of(p.table.axes.begin(), p.table.axes.end(), [&](Axis axis) {
                return sample.run_up_unknown[index_of(axis)] &&
                       sample.since_reversal[index_of(axis)] == 0.0;
            });
        if (p.replay.contact(i).device == records::Device::ballbar && starts_there)
            starts.push_back(i);
    }
    return starts;
}

}  // namespace trunnion::diagnosis
