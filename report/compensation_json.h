// Result of compensate as JSON.
#pragma once

#include <string>
#include <vector>

#include "base/read_file.h"
#include "compensation/compensation.h"

namespace trunnion::report {

/// trunnion.compensate/1: blocks, the largest errors before and after in um and urad, notes.
std::string compensation_json(const compensation::CompensatedProgram& result,
                              const std::vector<FileRead>& inputs = {});

}  // namespace trunnion::report
