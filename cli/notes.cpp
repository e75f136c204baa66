#include "cli/notes.h"

#include "base/console.h"
#include "base/text.h"

namespace trunnion::cli {
namespace {

/// Global, like the streams that it concerns.
Talk chosen = Talk::usual;

}  // namespace

void set_talk(Talk talk) {
    chosen = talk;
}

Talk talk() {
    return chosen;
}

void print_notes(const std::vector<std::string>& notes) {
    if (chosen == Talk::quiet) return;
    for (const std::string& note : notes) print_error("{}\n", printable(note));
}

}  // namespace trunnion::cli
