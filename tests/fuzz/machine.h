// The machine that fuzz targets run on: a table B-C with a probe, a sphere, a ballbar and a target
// of laser and tracker.
#pragma once

#include "base/read_file.h"
#include "setup/setup.h"

namespace trunnion::fuzz {

inline const setup::Setup& machine() {
    static const setup::Setup setup = [] {
        std::vector<std::string> notes;
        const std::string path = std::string(TRUNNION_SOURCE_DIR) + "/machines/bc_table.toml";
        const std::string target =
            "\n[[artefact]]\nname = \"R1\"\nkind = \"target\"\ntool_mm = [0, 0, -150]\n";
        return setup::parse_setup(read_file(path) + target, path, notes);
    }();
    return setup;
}

}  // namespace trunnion::fuzz
