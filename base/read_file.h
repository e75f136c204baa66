// Files are read completely and at once, so later changes on disk have no effect.
#pragma once

#include <string>

namespace trunnion::inline base {

/// The bytes of a file, a pipe or a device. Throws InputError with the path and the system's reason
/// when it is missing, is a folder, cannot be read, or changes while being read. At most 1 GiB from
/// a pipe or a device.
std::string read_file(const std::string& path);
/// The same; "-" is standard input.
std::string read_file_or_input(const std::string& path);

}  // namespace trunnion::inline base
