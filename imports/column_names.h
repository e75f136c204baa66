// Names of the columns of a table, and the units in them.
#pragma once

#include <string>
#include <vector>

#include "records/table_line.h"

namespace trunnion::imports {

/// One column of the header line: "Pos X [mm]" has the name "Pos X" and the unit "mm".
struct TextColumn {
    std::string name, unit;  ///< unit: as written, empty if the file gives none
    int column = 1;          ///< position of the name, from 1
};
/// Splits "Pos X [mm]", "Pos X (mm)", "pos_x / mm".
TextColumn column_named(const std::string& text, int column);

/// One column for each cell, without the path before every name.
std::vector<TextColumn> columns_named(const std::vector<records::TableCell>& names);
/// Names in two lines: "Target;Run 1;;Run 2;" above "[mm];+;-;+;-" or ";vor;zurueck;..". Sets the
/// names of `columns` to both and returns true.
bool join_names(const std::vector<records::TableCell>& above,
                const std::vector<records::TableCell>& below, std::vector<TextColumn>& columns);

}  // namespace trunnion::imports
