// The text of one value of a backup as a number, in the stores, and written back in its own form.
#pragma once

#include <string>
#include <string_view>

#include "backup/control_files.h"

namespace trunnion::backup {

constexpr std::string_view vacant_text = "#0";  ///< of `#500=#0`
bool is_hex(std::string_view text);
/// Sixteen hexadecimal digits of a big-endian double.
double number_from_hex(std::string_view digits);

/// The value in the unit of the stores (mm, deg; bit parameters as a byte); NaN for a vacant
/// variable.
double stored_value(const BackupValue& value);
void store_value(const BackupValue& value, offsets::Stores& stores);
/// The present content of the stores for that value.
double value_in(const BackupValue& value, const offsets::Stores& stores);
/// How the emulator treats it: an offset that no store has is ignored, the value of a further path
/// or spindle is known alone.
Standing standing_of_value(const BackupValue& value);
bool same_value(double a, double b);  ///< two vacant values are equal
/// `number` in the form of `like`: bits, integer, decimal point, hex double. Throws InputError
/// where that form has no text for a vacant variable.
std::string format_value(const BackupValue& like, double number);

}  // namespace trunnion::backup
