// The height map of a printer's bed in its configuration ([bed_mesh default]) as a table of points.
#pragma once

#include "imports/file_tables.h"
#include "imports/import.h"

namespace trunnion::imports {

/// A section [bed_mesh NAME] with points.
bool is_bed_mesh(std::string_view text);

/// Lines of a table: nominal x, y and z = 0, and the measured z, mm. Lines of saved values may be
/// marked by #*#. Throws InputError (line) for rows or columns that are missing, and for limits
/// that are not told.
MadeTable bed_mesh_table(const ImportFile& file);

}  // namespace trunnion::imports
