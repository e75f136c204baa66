// A run as JSON and as text.
#pragma once

#include <string>
#include <vector>

#include "emulator/run.h"

namespace trunnion {

/// trunnion.run/1, one object; `programs`: the files that the run read, with their SHA-256.
std::string run_json(const RunLog& log, const Chain& chain,
                     const std::vector<ProgramText>& programs);
/// One line: status, blocks, moves, time, path.
std::string run_summary(const RunLog& log);
/// "#100 = 1.5" lines; vacant ones without a value.
std::string variables_text(const RunLog& log);

}  // namespace trunnion
