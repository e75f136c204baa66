// The page of a compensated program.
#pragma once

#include "compensation/compensation.h"
#include "report/page.h"

namespace trunnion::report {

/// `machine`: name of the setup; `program`: of the original.
Page compensation_page(const compensation::CompensatedProgram& result, const std::string& machine,
                       const std::string& program);

}  // namespace trunnion::report
