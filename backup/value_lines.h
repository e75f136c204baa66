// Conversion of one line of a backup file to values and back: parameter records, G10 blocks, macro
// variables.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "backup/control_files.h"

namespace trunnion::backup {

/// All values of one file. `path` is for messages.
std::vector<BackupValue> scan_values(const std::string& file, std::string_view bytes,
                                     const std::string& path);

/// The value in the unit of the stores (mm, deg; bit parameters as a byte); NaN for a vacant
/// variable.
double stored_value(const BackupValue& value);
void store_value(const BackupValue& value, offsets::Stores& stores);
/// The present content of the stores for that value.
double value_in(const BackupValue& value, const offsets::Stores& stores);
bool same_value(double a, double b);  ///< two vacant values are equal
/// `number` in the form of `like`: bits, integer, decimal point, hex double.
std::string format_value(const BackupValue& like, double number);

}  // namespace trunnion::backup
