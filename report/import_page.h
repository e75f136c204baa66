// The page of imported readings: interpretation, assumptions, values.
#pragma once

#include "records/readings.h"
#include "report/page.h"

namespace trunnion::report {

/// `understood` and `assumed`: lines of the importer.
Page import_page(const records::ReadingTable& readings, const std::vector<std::string>& understood,
                 const std::vector<std::string>& assumed);

}  // namespace trunnion::report
