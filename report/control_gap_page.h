// The page of diagnose --program: verdict, causes, blocks, what the program does not determine.
#pragma once

#include <string>

#include "choices/control_gap.h"
#include "report/page.h"

namespace trunnion::report {

Page control_gap_page(const choices::ControlGap& gap, const std::string& log,
                      const std::string& program);

}  // namespace trunnion::report
