// CNC parameters that the emulator obeys or knows, with short names.
#pragma once

#include <span>
#include <string>

#include "backup/control_files.h"

namespace trunnion::backup {

struct ParameterRow {
    int first, last;  ///< first and last number, inclusive
    Standing standing;
    const char* name;
};
/// By number; all other numbers are ignored (kept, written back, without effect).
std::span<const ParameterRow> parameter_rows();

Standing standing_of_parameter(int number);
/// Empty when the number is not in the table.
std::string name_of_parameter(int number);

}  // namespace trunnion::backup
