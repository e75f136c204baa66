// Files of a control's backup that are not programs.
#pragma once

#include <string>

#include "interpreter/program_source.h"

namespace trunnion::inputs {

/// "parameter file", "work offset file", ... of a backup, by content and, for lists of G10 lines,
/// by name; empty for a program.
std::string backup_part(const interpreter::ProgramText& file);

}  // namespace trunnion::inputs
