// Amount of messages besides the result: --quiet, --verbose.
#pragma once

#include <string>
#include <vector>

namespace trunnion::cli {

enum class Talk : unsigned char { quiet, usual, verbose };
/// Set once by main from the options.
void set_talk(Talk talk);
Talk talk();

/// Prints each note on stderr, none with --quiet; a note contains its own position.
void print_notes(const std::vector<std::string>& notes);

}  // namespace trunnion::cli
