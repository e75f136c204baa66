// What options of all commands have in common: numbers that are finite, files that do not clash.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace trunnion::cli {

/// Marks an option that names a file (or folder) to read, or to write: shown so by --help.
CLI::Option* reads_file(CLI::Option* option);
CLI::Option* writes_file(CLI::Option* option);
/// The number given is 0 or more.
CLI::Option* not_negative(CLI::Option* option);

/// Every number that an option of any command takes is finite, and whole without sign where it
/// counts. To be called when all options are there.
void check_numbers(CLI::App& app);
/// Throws InputError when the options given would write a file that another reads or writes too.
void refuse_clashing_files(const CLI::App& app);
/// What the command line names to be read, in the order of the help; folders and "-" included.
std::vector<std::string> files_read(const CLI::App& command);

}  // namespace trunnion::cli
