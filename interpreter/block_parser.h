// Parses the text of one block into a Block with its items and expressions in a Code.
#pragma once

#include <array>
#include <map>
#include <string>
#include <string_view>

#include "interpreter/code.h"
#include "interpreter/dialect.h"

namespace trunnion::interpreter {

/// Names assigned to variables by SETVN: `#[#NAME]`.
using VariableNames = std::map<std::string, int, std::less<>>;
/// Adds `NAME,NAME,,NAME` of SETVN to `names`, starting with variable `number`.
void read_names(std::string_view list, int number, VariableNames& names);

struct ParseOptions {
    Dialect dialect;
    /// Block skip switches [1]..[9]; an active switch drops the rest of the block.
    std::array<bool, 10> skip{};
    bool keep_skips = false;  ///< keep `/n` as items (for printing and checking)
    const VariableNames* names = nullptr;
};

/// Maximum nesting of brackets (control.md 2.8); function brackets do not count (assumed).
constexpr int bracket_levels = 5;
/// Maximum nesting of brackets of any kind, which bounds the stack (assumed).
constexpr int function_levels = 30;
/// No expression needs a deeper evaluation stack.
constexpr int expression_stack = 48;

/// Parses the block that starts at `byte` (its line number is given) and appends its parts to
/// `out`. Errors are thrown as Alarm with the column. At the end of the text: end_of_record.
Block parse_block(std::string_view text, std::uint64_t byte, int line, const ParseOptions& options,
                  Code& out);

}  // namespace trunnion::interpreter
