// Files are read completely and at once, so later changes on disk have no effect.
#pragma once

#include <string>
#include <vector>

namespace trunnion::inline base {

/// The bytes of a file, a pipe or a device. Throws InputError with the path and the system's reason
/// when it is missing, is a folder, cannot be read, or changes while being read. At most 1 GiB from
/// a pipe or a device. A named pipe without a writer and a silent device are errors after a few
/// seconds (base/waiting.h).
std::string read_file(const std::string& path);
/// The same; "-" is standard input.
std::string read_file_or_input(const std::string& path);

/// What was read, for reports: the hash is that of the bytes that were worked on, not of what the
/// file holds later.
struct FileRead {
    std::string path;    ///< as given; "standard input" for "-"
    std::string sha256;  ///< 64 hexadecimal digits
};

/// While it lives, every file read in this process is noted, from any thread. One at a time.
class ReadRecord {
  public:
    ReadRecord();
    ~ReadRecord();
    ReadRecord(const ReadRecord&) = delete;
    ReadRecord& operator=(const ReadRecord&) = delete;

    /// By path; a file that was read twice stands there once, twice where it had changed. Empty
    /// while no record lives.
    static std::vector<FileRead> files();
};

}  // namespace trunnion::inline base
