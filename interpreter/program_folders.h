// Program folders on disk as the control's program memory.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "interpreter/program_source.h"

namespace trunnion {

/// A file mapped into memory: any length, no memory of its own. Throws InputError when it cannot be
/// read.
ProgramText map_program(const std::string& path);

/// Looks for O1234 in each folder in turn: files named O1234, O1234.nc (or .txt .tap .min .mpf .cnc
/// .ngc .eia .iso .prg), 1234, 1234.nc, leading zeros free, upper or lower case; then any file that
/// holds a line starting with O1234 or :1234, the way one file carries several programs.
class ProgramFolders : public ProgramSource {
  public:
    explicit ProgramFolders(std::vector<std::string> folders);

    /// Programs of this file are found before all others (the file that runs). It is searched when
    /// the first subprogram is called, not before.
    void add_file(const ProgramText& file) { own_files_.push_back(file); }

    std::optional<ProgramText> find(int o_number) override;
    std::optional<ProgramText> find(std::string_view name) override;

  private:
    void list_folders();
    void scan_own_files();
    void scan_contents();

    std::vector<std::string> folders_;
    bool listed_ = false, scanned_ = false;
    std::vector<std::string> files_;  ///< in order of folders, then of names
    std::map<int, std::string> by_name_, by_content_;
    std::vector<ProgramText> own_files_;  ///< not yet searched
    std::map<int, ProgramText> own_;
};

}  // namespace trunnion
