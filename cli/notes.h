// Notes on files that were read.
#pragma once

#include <string>
#include <vector>

namespace trunnion::cli {

/// One line for each note on stderr; a note brings its own place.
void print_notes(const std::vector<std::string>& notes);

}  // namespace trunnion::cli
