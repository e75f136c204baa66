// The text file of a laser's linear measurement (.rtl) as a table of targets, runs and deviations.
#pragma once

#include "imports/import.h"

namespace trunnion::imports {

/// True for a text that begins with HEADER:: and has a part DEVIATIONS::.
bool is_rtl(std::string_view text);

/// The same lines as a table for the reader of ISO 230-2: each stays where it is, so that messages
/// and sources name the line of the file. Targets in mm or deg; deviations in the unit that `facts`
/// tell, else um. A run rises or falls with its targets; where the flags say one direction, the
/// even runs are fillers and are left out with a note. Throws InputError for a part that is missing
/// and for a target that is not listed.
std::string table_of_rtl(const ImportFile& file, const Facts& facts,
                         std::vector<std::string>& notes);

}  // namespace trunnion::imports
