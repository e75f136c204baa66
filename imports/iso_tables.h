// The tables of a report that hold readings; those of results and gear ratios are passed over.
#pragma once

#include <string>
#include <vector>

#include "imports/text_table.h"

namespace trunnion::imports {

/// The tables to read, of each file in order. A table that may hold readings, but is broken, is
/// among them; so is the first table of a file without any readings: reading it tells what is
/// wrong. `notes` gets a line for each table that is passed over.
std::vector<const TextTable*> tables_with_readings(const std::vector<TextTable>& tables,
                                                   std::vector<std::string>& notes);

}  // namespace trunnion::imports
