#include "cli/setups.h"

#include "cli/notes.h"
#include "inputs/open_setup.h"

namespace trunnion::cli {

setup::Setup open_setup(const std::string& path) {
    std::vector<std::string> notes;
    setup::Setup setup = inputs::open_setup(path, notes);
    print_notes(notes);
    return setup;
}

}  // namespace trunnion::cli
