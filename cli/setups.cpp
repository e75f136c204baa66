#include "cli/setups.h"

#include "backup/control_files.h"
#include "base/read_file.h"
#include "cli/files.h"

namespace trunnion::cli {

setup::Setup open_setup(const std::string& path) {
    std::vector<std::string> notes;
    const auto read_files = [](const std::string& folder, offsets::Stores& stores) {
        backup::apply_backup(backup::read_backup(folder), stores);
    };
    setup::Setup setup = setup::load_setup(path.empty() ? shipped("machines/bc_table.toml") : path,
                                           notes, read_files);
    print_notes(notes);
    return setup;
}

}  // namespace trunnion::cli
