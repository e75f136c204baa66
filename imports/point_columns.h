// Measured points of a table, for any layout: coordinates in columns or one a line.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "imports/columns.h"
#include "imports/facts.h"
#include "imports/missing_values.h"
#include "imports/time_column.h"

namespace trunnion::imports {

using ThreeColumns = std::array<std::optional<NumberColumn>, 3>;

/// Assignment of the columns.
struct PointColumns {
    ThreeColumns nominal, measured, error;            ///< error: measured - nominal
    std::vector<std::pair<Axis, NumberColumn>> axes;  ///< positions of the machine's axes
    std::optional<NumberColumn> sigma;
    std::optional<std::size_t> session, feature;
    std::optional<std::size_t> coordinate, name;  ///< one coordinate a line: X, Y or Z, and the
                                                  ///< name of the point
    std::vector<std::string> unused;
};
/// Throws InputError when measured or nominal points are missing.
PointColumns point_columns(const TextTable& table, const setup::Setup& setup, const Facts& facts,
                           const TimeColumn& time);

/// One point, mm; values not in the table are empty.
struct MeasuredPoint {
    std::size_t row = 0;  ///< first row of the point
    std::array<std::optional<double>, 3> nominal, measured;
    std::array<std::size_t, 3> rows{};  ///< of each coordinate
};
/// What is not read of a table.
struct LeftOut {
    MissingValues values;
    std::vector<std::string> names;  ///< in place of a coordinate: a diameter, a distance

    void note(const std::string& path, std::vector<std::string>& notes) const;
};
/// In table order. Of coordinates one a line those of one name are one point, wherever they stand.
/// Throws InputError where such lines have no names and stand sorted by coordinate.
std::vector<MeasuredPoint> measured_points(const TextTable& table, const PointColumns& columns,
                                           LeftOut& left_out);
/// True where the nominal point is not known: a coordinate that the table has for the others is
/// missing.
bool lacks_nominal(const PointColumns& columns, const MeasuredPoint& point);

}  // namespace trunnion::imports
