// The page of the four-function test: what to type, then the maps measured beside the expected
// ones.
#pragma once

#include "report/page.h"
#include "report/pivot_report.h"

namespace trunnion::report {

/// Verdict, numbers to type, maps, who is affected, what cannot be told, how to read it.
Page pivot_page(const PivotResult& result);

}  // namespace trunnion::report
