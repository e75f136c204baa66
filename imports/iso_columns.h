// Columns of an ISO 230-2 table by their names: targets and values.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "imports/text_table.h"

namespace trunnion::imports {

std::optional<std::size_t> target_column(const TextTable& table);
/// A name of targets: the same ones in another unit may stand beside them.
bool has_role_of_target(const TextColumn& column);

/// The column of values in a list with one value a line: the words of docs/readings.md come before
/// those of other programs. Throws InputError when only names that two columns have are left.
std::optional<std::size_t> find_value_column(const TextTable& table, std::size_t target);
/// A note on the column taken, if others could be the value too.
void note_other_values(const TextTable& table, std::size_t target, std::size_t value,
                       std::vector<std::string>& notes);
/// A name that the column of values of a list may have.
bool may_be_value(const TextColumn& column);
/// True for a name that may be a direction or not: "r" (resolver), "f", "pos".
bool may_be_no_direction(const std::string& name);

}  // namespace trunnion::imports
