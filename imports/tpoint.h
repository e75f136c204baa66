// A pointing run of a telescope in azimuth and altitude, in the form of TPOINT: caption, options
// (: ALTAZ), a line about site and weather, lines of star and telescope, END; ! begins a comment.
// Known from published runs (assumed): the star comes first, then the telescope.
#pragma once

#include "imports/file_tables.h"
#include "imports/import.h"

namespace trunnion::imports {

/// True for a text whose first lines have an option of such a run.
bool is_tpoint(std::string_view text);

/// Lines of a table: angles that the telescope's encoders read as commanded, those of the star as
/// actual, in degrees as they stand, in the axes of the setup. Throws InputError (line) for a mount
/// of another kind, for a machine of other axes than two that carry the line of sight, and for a
/// line without four numbers.
MadeTable tpoint_table(const ImportFile& file, const setup::Setup& setup);

}  // namespace trunnion::imports
