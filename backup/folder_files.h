// What each file of a backup folder is, and which of them are copied as they are.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "backup/control_files.h"

namespace trunnion::backup {

/// Files with values are obeyed; programs and lists of the control are known. `name`: upper case.
Standing standing_of_file(const std::string& name);
/// "parameters", "macro variables", ...; "binary" or "text" by the bytes when the name is not
/// known.
std::string kind_of_file(const std::string& name, std::string_view bytes);

/// Files of the backup's folder that `read_backup` does not read, as paths from that folder,
/// sorted. Throws InputError for a folder in it that cannot be read.
std::vector<std::string> other_files(const ControlBackup& backup);

}  // namespace trunnion::backup
