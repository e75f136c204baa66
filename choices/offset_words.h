// Numbers of tools and offsets in the text of programs.
#pragma once

#include <set>
#include <vector>

#include "interpreter/program_source.h"

namespace trunnion::choices {

/// Numbers behind H, D and T outside of comments: an offset that is empty on this control may be
/// one that the other control has. An expression (H#1) names none.
std::set<int> offset_words(const std::vector<interpreter::ProgramText>& texts);

/// The same of P behind G54.1, G54 or G154, and of G10 L20.
std::set<int> additional_offsets(const std::vector<interpreter::ProgramText>& texts);

/// The same of P behind G54.2, and of G10 L21.
std::set<int> fixture_offset_words(const std::vector<interpreter::ProgramText>& texts);

}  // namespace trunnion::choices
