// Files that are no NC program, whatever a control would make of their first line.
#pragma once

#include <string_view>

#include "interpreter/program_source.h"

namespace trunnion::interpreter {

/// True for a line that may be a block: words, a macro statement, a comment, the head of a program.
/// False for numbers between commas, a sentence, a key with a value.
bool may_be_block(std::string_view line);

/// Throws InputError for bytes that are no text, and where most lines may not be blocks: a table, a
/// setup, a letter. A program with some lines that a control refuses is one.
void refuse_other_files(const ProgramText& program);

}  // namespace trunnion::interpreter
