// Prints parsed blocks as canonical text; parsing that text gives the same blocks.
#pragma once

#include <string>

#include "interpreter/parse.h"

namespace trunnion::interpreter {

/// A number that the control reads back as the same double: `10.`, `-0.5`; without point when
/// `decimal_point` is false.
std::string print_number(double value, bool decimal_point);

/// One line without line end: O or <name>, N, leading comments, items, other comments.
std::string print_block(const ParsedProgram& program, const Block& block);

/// All blocks, one block a line.
std::string print_program(const ParsedProgram& program);

}  // namespace trunnion::interpreter
