#include "cli/setups.h"

#include <fmt/format.h>

#include "cli/notes.h"
#include "inputs/open_setup.h"

namespace trunnion::cli {

setup::Setup open_setup(const std::string& path) {
    std::vector<std::string> notes;
    setup::Setup setup = inputs::open_setup(path, notes);
    tell_setup(setup, notes);
    return setup;
}

void tell_setup(const setup::Setup& setup, const std::vector<std::string>& notes) {
    print_notes(notes);
    if (talk() == Talk::verbose && setup.derived_parameters > 0)
        print_notes(
            {fmt::format("{}: {} parameter{} derived from [machine]", setup.path,
                         setup.derived_parameters, setup.derived_parameters == 1 ? "" : "s")});
}

}  // namespace trunnion::cli
