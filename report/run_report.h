// A run as JSON and as text.
#pragma once

#include <string>

#include "emulator/run.h"

namespace trunnion {

/// trunnion.run/1 of formats.md, one object.
std::string run_json(const RunLog& log, const Chain& chain);
/// One line: status, blocks, moves, time, path.
std::string run_summary(const RunLog& log);
/// "#100 = 1.5" lines; vacant ones without a value.
std::string variables_text(const RunLog& log);

}  // namespace trunnion
