#include "inputs/shipped.h"

#include <cstdlib>
#include <filesystem>
#include <vector>

#include "base/alarm.h"

namespace trunnion::inputs {
namespace fs = std::filesystem;
namespace {

/// The folders that may contain machines/ and programs/, in search order.
std::vector<fs::path> homes() {
    std::vector<fs::path> folders;
    if (const char* home = std::getenv("TRUNNION_HOME"); home && *home) folders.emplace_back(home);
    std::error_code unknown;
    const fs::path program = fs::read_symlink("/proc/self/exe", unknown);
    for (fs::path folder = program.parent_path(); !folder.empty(); folder = folder.parent_path()) {
        folders.push_back(folder);
        folders.push_back(folder / "share/trunnion");
        if (folder == folder.root_path()) break;
    }
    folders.emplace_back(TRUNNION_INSTALLED_DATA);
    folders.emplace_back("/usr/share/trunnion");  // the package, where /proc is not mounted
    folders.emplace_back(TRUNNION_SOURCE_FOLDER);
    return folders;
}

}  // namespace

std::string shipped(const std::string& relative) {
    std::string places;
    for (const fs::path& folder : homes()) {
        std::error_code unknown;
        const fs::path candidate = folder / relative;
        if (fs::exists(candidate, unknown)) {
            const fs::path near = fs::proximate(candidate, unknown);
            const bool below = !unknown && *near.begin() != "..";
            return (below ? near : candidate).string();
        }
        places += (places.empty() ? "" : ", ") + folder.string();
    }
    throw InputError("is not in any of these folders: " + places +
                         "; set TRUNNION_HOME to the folder that holds machines and programs",
                     {relative, 0, 0});
}

}  // namespace trunnion::inputs
