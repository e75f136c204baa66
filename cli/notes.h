// How much a command says beside its result: --quiet, --verbose.
#pragma once

#include <string>
#include <vector>

namespace trunnion::cli {

enum class Talk : unsigned char { quiet, usual, verbose };
/// Said once by main, as the options ask for it.
void set_talk(Talk talk);
Talk talk();

/// One line for each note on stderr, none with --quiet; a note brings its own place.
void print_notes(const std::vector<std::string>& notes);

}  // namespace trunnion::cli
