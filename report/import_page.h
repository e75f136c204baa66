// The page of imported readings: what was understood, what was assumed, the values.
#pragma once

#include "records/readings.h"
#include "report/page.h"

namespace trunnion::report {

/// `understood` and `assumed` are the importer's lines.
Page import_page(const records::ReadingTable& readings, const std::vector<std::string>& understood,
                 const std::vector<std::string>& assumed);

}  // namespace trunnion::report
