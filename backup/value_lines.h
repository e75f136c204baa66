// The lines of a backup file as values: parameter records, G10 blocks, macro variables.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "backup/control_files.h"

namespace trunnion::backup {

struct ValueFile {
    std::string name, path;  ///< the path is for messages
    bool inch = false;       ///< unit of its offsets until a G20 or G21
};
/// All values of one file.
std::vector<BackupValue> scan_values(const ValueFile& file, std::string_view bytes);

}  // namespace trunnion::backup
