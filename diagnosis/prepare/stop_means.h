// Readings that an instrument takes several times while the axes stand (stop_means.cpp).
#pragma once

#include <cstddef>
#include <functional>
#include <optional>

#include "records/readings.h"

namespace trunnion::diagnosis {

struct StopMeans {
    records::ReadingTable table;
    std::size_t readings = 0;  ///< that stand for the means
    std::size_t means = 0;
};

/// The table with one reading for each target of a laser, an angle sensor or an instrument that
/// reads points, and each stop of the axes: the mean of those taken there. What the machine does
/// not repeat is the same in all of them, so that their scatter is not its noise and each of them
/// no proof of its own. Empty without such readings, where their noise is stated (then it is that
/// of a reading), and where the axes stand for long: a watch of time. `is_stated`: of the noise of
/// a row.
std::optional<StopMeans> means_of_stops(
    const records::ReadingTable& table,
    const std::function<bool(const records::Reading&)>& is_stated);

}  // namespace trunnion::diagnosis
