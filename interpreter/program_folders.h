// Program folders on disk as the control's program memory.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "interpreter/program_source.h"

namespace trunnion::interpreter {

/// What a file holds now; "-" is standard input. What is written to the file later changes nothing.
/// Throws InputError when it cannot be read.
ProgramText read_program(const std::string& path);

/// The same for a program that is to be run or judged: one without any block is refused, because a
/// file that a post or a copy left empty must not pass.
ProgramText read_main_program(const std::string& path);

/// Looks for O1234 in the folders: files named O1234, O1234.nc (or .txt .tap .min .mpf .cnc .ngc
/// .eia .iso .prg), 1234, 1234.nc, leading zeros free, upper or lower case; then any file that
/// holds a line starting with O1234 or :1234, the way one file carries several programs. The user's
/// folders are searched so, names and contents, before the shipped ones.
class ProgramFolders : public ProgramSource {
  public:
    /// `shipped`: folders of the product. Throws InputError when a folder is missing.
    explicit ProgramFolders(std::vector<std::string> folders,
                            std::vector<std::string> shipped = {});

    /// Programs of this file are found before all others (the file that runs). It is searched when
    /// the first subprogram is called, not before.
    void add_file(const ProgramText& file);
    /// The files given and those that calls found, each as it was read.
    std::vector<ProgramText> used() const;

    bool holds(int o_number) { return look_up(o_number).has_value(); }
    /// One line for each program that a call found only among the shipped ones.
    const std::vector<std::string>& announcements() const { return announcements_; }

    std::optional<ProgramText> find(int o_number) override;
    std::optional<ProgramText> find(std::string_view name) override;

  private:
    /// Folders that are searched together.
    struct Shelf {
        std::vector<std::string> folders;
        bool listed = false, scanned = false;
        std::vector<std::string> files;  ///< in order of folders, then of names
        std::map<int, std::string> by_name, by_content;
    };
    /// Each file is read when it is first called, and stays as it was then.
    const ProgramText& read_once(const std::string& path);
    void scan_own_files();
    std::optional<ProgramText> look_up(int o_number);
    void announce(const std::string& program, const ProgramText& text);

    static void list(Shelf& shelf);
    static const std::string* path_of(Shelf& shelf, int o_number);
    static const std::string* path_of(Shelf& shelf, const std::string& wanted);

    Shelf own_shelf_, shipped_;
    std::vector<std::string> announcements_;
    std::vector<ProgramText> given_;      ///< by add_file
    std::vector<ProgramText> own_files_;  ///< of them, not yet searched
    std::map<int, ProgramText> own_;
    std::map<std::string, ProgramText> read_;  ///< by path
};

}  // namespace trunnion::interpreter
