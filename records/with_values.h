// A table of readings as its file has it, with other values.
#pragma once

#include <string>
#include <string_view>

#include "records/readings.h"

namespace trunnion::records {

/// `text`, the table that `read` was parsed from, with the values of `read` (mm, deg) in the rows
/// with a device. All else stays as written: lines with #, the order of the columns, columns that
/// are not known, number forms, separators; but the digests of `# declared` are those of `read`. A
/// column of values that a row needs and the table lacks is added as the last one. UTF-16 becomes
/// UTF-8. Throws InputError as parse_readings does.
std::string with_values(std::string_view text, const ReadingTable& read);

}  // namespace trunnion::records
