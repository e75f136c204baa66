// The page of a compensated program.
#pragma once

#include "compensation/compensation.h"
#include "report/page.h"

namespace trunnion::report {

/// `machine` is the setup's name, `program` the original's.
Page compensation_page(const compensation::CompensatedProgram& result, const std::string& machine,
                       const std::string& program);

}  // namespace trunnion::report
