// The output files of a command: each appears completely or not at all.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace trunnion::inline base {

/// A file being written. A regular file has no name until `publish`, which replaces the file at its
/// path in one step, with that file's mode, owner and group (where the system permits it) and
/// behind its symbolic links; other hard links keep the old text. Without `publish` nothing
/// remains, even when the process is killed. (On a file system without unnamed files it is
/// `.trunnion_PID_N` in the same folder, and SIGKILL leaves it there.) A device or a pipe gets the
/// text at once. All functions throw InputError with the path.
class OutputFile {
  public:
    explicit OutputFile(std::string path);
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    void append(std::string_view text);
    /// Writes all bytes to the disk; only the name is then missing.
    void complete();
    /// Gives it a hidden name in its folder and closes it; `publish` then only renames it.
    void give_name();
    void publish();
    const std::string& path() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

/// The output files of one command, collected and then written together: when one cannot be
/// written, none gets its name. "-" is standard output.
class OutputFiles {
  public:
    OutputFiles() = default;
    ~OutputFiles();
    OutputFiles(const OutputFiles&) = delete;
    OutputFiles& operator=(const OutputFiles&) = delete;

    /// Makes the folder and those above it; those that are still empty go again if `write` fails or
    /// is never called. Throws InputError with the path.
    void add_folder(const std::string& path);
    void add(const std::string& path, std::string text);
    /// A file that grows while the command works. It gets its name in `write`.
    OutputFile& open(const std::string& path);
    /// Throws InputError with the path that cannot be written.
    void write();

  private:
    std::vector<std::pair<std::string, std::string>> texts_;
    std::vector<std::unique_ptr<OutputFile>> files_;
    std::vector<std::string> made_;  ///< folders, outer ones first
};

/// Writes a single file, or standard output for "-". Throws InputError like OutputFiles.
void write_output(const std::string& path, std::string text);

}  // namespace trunnion::inline base
