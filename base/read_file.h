// Files read whole and at once: what changes on disk later does not change what was read.
#pragma once

#include <string>

namespace trunnion::inline base {

/// The bytes of a file, a pipe or a device. Throws InputError with the path and the system's
/// reason: when it is missing, is a folder, a read fails, or the file changes while it is read. A
/// pipe or a device may give 1 GiB at most.
std::string read_file(const std::string& path);
/// The same; "-" is standard input.
std::string read_file_or_input(const std::string& path);

}  // namespace trunnion::inline base
