// The columns of a table of readings, with conversion to and from a row.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "records/readings.h"
#include "records/table_line.h"

namespace trunnion::records {

/// Stores one cell in a row; throws InputError with the cell's position.
using StoreCell = std::function<void(Reading&, const TableLine&, const TableCell&)>;
using WriteCell = std::function<std::string(const Reading&)>;

struct ReadingColumn {
    std::string_view name;
    StoreCell store;
    WriteCell text;
    bool optional = true;  ///< false: in every table, or (dir_x ..) when a row needs it
};

/// All columns except those of the axes.
const std::vector<ReadingColumn>& reading_columns();
/// nullptr when no column has this name.
const ReadingColumn* find_reading_column(std::string_view name);

/// The axis of a column "x_mm", "j1_deg". Throws InputError for a column that means an axis (a
/// letter of ISO 841, or a letter with a number) that is not in `names`.
std::optional<Axis> axis_of_column(const TableLine& line, const TableCell& cell,
                                   const AxisNames& names);
StoreCell axis_store(Axis axis, bool rotary);
std::string axis_text(const Reading& row, Axis axis, bool rotary);

/// True when the device reads along or about `dir_x dir_y dir_z`.
bool has_direction(Device device);

}  // namespace trunnion::records
