// Measured points of a table, however it is laid out: coordinates in columns or one a line.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "imports/columns.h"
#include "imports/facts.h"

namespace trunnion::imports {

using ThreeColumns = std::array<std::optional<NumberColumn>, 3>;

/// Which columns hold what.
struct PointColumns {
    ThreeColumns nominal, measured, error;            ///< error: measured - nominal
    std::vector<std::pair<Axis, NumberColumn>> axes;  ///< positions of the machine's axes
    std::optional<NumberColumn> sigma;
    std::optional<std::size_t> session;
    std::optional<std::size_t> coordinate, name;  ///< one coordinate a line: X, Y or Z; of a point
    std::vector<std::string> unused;
};
/// Throws InputError where neither measured points nor what was meant are told.
PointColumns point_columns(const TextTable& table, const setup::Setup& setup, const Facts& facts,
                           const TimeColumn& time);

/// One point, mm; what the table does not hold is empty.
struct MeasuredPoint {
    std::size_t row = 0;  ///< its first
    std::array<std::optional<double>, 3> nominal, measured;
    std::array<std::size_t, 3> rows{};  ///< of each coordinate
};
/// In the order of the table. `left_out` counts coordinates without a value.
std::vector<MeasuredPoint> measured_points(const TextTable& table, const PointColumns& columns,
                                           std::size_t& left_out);

}  // namespace trunnion::imports
