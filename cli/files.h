// Files a command reads by name and writes whole.
#pragma once

#include <iosfwd>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace trunnion {

/// A folder or file that ships with the product ("machines/bc_table.toml", "programs"): next to a
/// parent folder of the executable (a build inside the source tree), or in share/trunnion of an
/// installation. Throws InputError when it is nowhere.
std::string shipped(const std::string& relative);

void make_folder(const std::string& path);        ///< throws InputError with the path
std::string read_whole(const std::string& path);  ///< throws InputError with the path

/// Output files of one command: collected, then written under another name and renamed, so that
/// each appears whole or not at all. "-" is standard output.
class OutputFiles {
  public:
    OutputFiles();
    ~OutputFiles();
    void add(const std::string& path, std::string text);
    /// A file that grows while the command works; it gets its name in `write` and goes without it.
    std::ostream& open(const std::string& path);
    void write();  ///< throws InputError with the path that cannot be written

  private:
    struct Growing;
    std::vector<std::pair<std::string, std::string>> files_;
    std::vector<std::unique_ptr<Growing>> growing_;
};

/// One line for each note on stderr; a note brings its own place.
void print_notes(const std::vector<std::string>& notes);

}  // namespace trunnion
