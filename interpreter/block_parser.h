// Text of one block -> Block and its items and expressions in a Code.
#pragma once

#include <array>
#include <map>
#include <string>
#include <string_view>

#include "interpreter/code.h"
#include "interpreter/dialect.h"

namespace trunnion::interpreter {

/// Names that SETVN gave to variables: `#[#NAME]`.
using VariableNames = std::map<std::string, int, std::less<>>;
/// Takes `NAME,NAME,,NAME` of SETVN into `names`, the first for variable `number`.
void read_names(std::string_view list, int number, VariableNames& names);

struct ParseOptions {
    Dialect dialect;
    /// Block skip switches [1]..[9]; a set one drops the rest of the block.
    std::array<bool, 10> skip{};
    bool keep_skips = false;  ///< keep `/n` as items (for printing and checking)
    const VariableNames* names = nullptr;
};

/// Brackets may be nested this deep (control.md 2.8); those of functions do not count (assumed).
constexpr int bracket_levels = 5;
/// Brackets of any kind, so that no text exhausts the stack (assumed).
constexpr int function_levels = 30;
/// No expression needs more places on the evaluation stack.
constexpr int expression_stack = 48;

/// Reads the block that starts at `byte` (its line number is given) and appends its parts to `out`.
/// Faults are thrown as Alarm with the column. `byte` at the end of the text: end_of_record.
Block parse_block(std::string_view text, std::uint64_t byte, int line, const ParseOptions& options,
                  Code& out);

}  // namespace trunnion::interpreter
