// Result of compensate as JSON.
#pragma once

#include <string>

#include "compensation/compensation.h"

namespace trunnion::report {

/// trunnion.compensate/1: blocks, the largest errors before and after in um and urad, notes.
std::string compensation_json(const compensation::CompensatedProgram& result);

}  // namespace trunnion::report
