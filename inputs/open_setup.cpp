#include "inputs/open_setup.h"

#include "backup/control_files.h"
#include "inputs/shipped.h"

namespace trunnion::inputs {

setup::Setup open_setup(const std::string& path, std::vector<std::string>& notes) {
    const auto read_files = [](const std::string& folder, offsets::Stores& stores) {
        backup::apply_backup(backup::read_backup(folder), stores);
    };
    return setup::load_setup(path.empty() ? shipped("machines/bc_table.toml") : path, notes,
                             read_files);
}

}  // namespace trunnion::inputs
