#include "cli/notes.h"

#include "base/console.h"
#include "base/text.h"

namespace trunnion::cli {

void print_notes(const std::vector<std::string>& notes) {
    for (const std::string& note : notes) print_error("{}\n", printable(note));
}

}  // namespace trunnion::cli
