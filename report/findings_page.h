// The page of findings of check.
#pragma once

#include "check/check.h"
#include "report/page.h"

namespace trunnion::report {

/// `files`: all files that were checked.
Page findings_page(const std::vector<check::Finding>& findings,
                   const std::vector<std::string>& files);

}  // namespace trunnion::report
