// The page of the four-function test: values to enter, then measured and expected maps.
#pragma once

#include "report/page.h"
#include "report/pivot_report.h"

namespace trunnion::report {

/// Verdict, values to enter, maps, affected programs, what cannot be determined, explanations.
Page pivot_page(const PivotResult& result);

}  // namespace trunnion::report
