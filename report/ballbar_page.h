// The page of the ballbar test: errors before and after, values to enter, polar plots,
// verification.
#pragma once

#include "ballbar/test/ballbar_procedure.h"
#include "report/page.h"

namespace trunnion::report {

Page ballbar_page(const ballbar::test::BallbarResult& result);

}  // namespace trunnion::report
