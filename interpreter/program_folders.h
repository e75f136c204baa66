// Program folders on disk as the control's program memory.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "interpreter/program_source.h"

namespace trunnion::interpreter {

/// True for the usual endings of NC programs, in upper or lower case, and for none.
bool has_program_ending(const std::string& path);

/// The present content of a file; "-" is standard input. Later changes of the file have no effect.
/// Throws InputError when the file cannot be read.
ProgramText read_program(const std::string& path);

/// The same for a program to be run or checked. A program without any block is refused, so that an
/// empty file from a post processor or a failed copy does not pass.
ProgramText read_main_program(const std::string& path);
/// Throws InputError when there is no block.
void refuse_empty(const ProgramText& program);

/// Searches O1234 in the folders: first files named O1234, O1234.nc (or .txt .tap .min .mpf .cnc
/// .ngc .eia .iso .prg), 1234, 1234.nc, <O1234>, with any number of leading zeros, in upper or
/// lower case; then any file with a line that starts with O1234, :1234 or <O1234>, as in files with
/// several programs. A name is searched likewise: files of this name, then a line <NAME>. The
/// user's folders come first, then their subfolders, then the shipped folders.
class ProgramFolders : public ProgramSource {
  public:
    /// `shipped`: folders of the product. Throws InputError when a folder is missing.
    explicit ProgramFolders(std::vector<std::string> folders,
                            std::vector<std::string> shipped = {});

    /// Programs of this file have priority over all others (the file being run). It is searched at
    /// the first subprogram call.
    void add_file(const ProgramText& file);
    /// Takes over what `searched`, of the same folders, knows of them: which programs which file
    /// holds. They are then not read again.
    void learn_from(const ProgramFolders& searched) { shelves_ = searched.shelves_; }
    /// The files given and those found by calls, each with the content that was read.
    std::vector<ProgramText> used() const;

    bool holds(int o_number) { return look_up(o_number).has_value(); }
    /// The user's folders or their subfolders hold it.
    bool holds_own(int o_number);
    /// One line for each program that a call found only in a subfolder or in the shipped folders,
    /// and one when there were too many subfolders to search.
    const std::vector<std::string>& announcements() const { return announcements_; }

    std::optional<ProgramText> find(int o_number) override;
    std::optional<ProgramText> find(std::string_view name) override;

  private:
    /// Folders that are searched together.
    struct Shelf {
        std::vector<std::string> folders;
        bool listed = false, scanned = false;
        std::vector<std::string> files;  ///< in the order of folders, then of names
        std::map<int, std::vector<std::string>> by_name, by_content;
        std::map<std::string, std::string, std::less<>> by_title;  ///< of `<NAME>`
    };
    enum Place : std::size_t { own, below, shipped, place_count };
    /// The files that hold a program, in order of the search.
    struct Found {
        std::size_t place = own;
        std::vector<std::string> paths;
    };
    /// Each file is read at its first call; later changes have no effect.
    const ProgramText& read_once(const std::string& path);
    void scan_own_files();
    std::optional<ProgramText> look_up(int o_number);
    std::optional<Found> search(int o_number);
    std::optional<Found> search(std::string_view name);
    ProgramText take(const Found& found, const std::string& program);
    void announce(std::string line);
    void list(std::size_t place);
    void list_below();
    static void scan(Shelf& shelf);

    std::array<Shelf, place_count> shelves_;
    std::vector<std::string> announcements_;
    std::vector<ProgramText> given_;      ///< by add_file
    std::vector<ProgramText> own_files_;  ///< of these, not yet searched
    std::map<int, ProgramText> own_;
    std::map<std::string, ProgramText> read_;  ///< by path
};

}  // namespace trunnion::interpreter
