// The single-set-up ballbar procedure as text and CSV.
#pragma once

#include <string>

#include "ballbar/test/ballbar_procedure.h"

namespace trunnion::report {

/// Tables like Table 2 of the 2015 paper (at the setup's point_mm, and at the nominal
/// intersection), set-up, inseparable parameters, residual, ISO 230-4 parameters, diagnosis, times.
std::string ballbar_table(const ballbar::test::BallbarResult& result);
/// Both error tables, one line an error: where (point_mm or intersection), name, before, u_before,
/// after, u_after, change_percent, published_before, unit (mm or rad).
std::string ballbar_csv(const ballbar::test::BallbarResult& result);

}  // namespace trunnion::report
