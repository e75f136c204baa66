// The page of an identification: values with intervals, correlations, residuals by axis and time.
#pragma once

#include "identification/identify.h"
#include "records/readings.h"
#include "report/page.h"

namespace trunnion::report {

/// `measured`: the readings; `predicted`: the same rows, predicted by the identified setup.
Page identification_page(const identification::Identification& result,
                         const records::ReadingTable& measured,
                         const records::ReadingTable& predicted);

}  // namespace trunnion::report
