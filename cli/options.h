// Common checks of options of all commands: finite numbers, files without conflicts.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace trunnion::cli {

/// Marks an option that names a file (or folder) to read, a file or a folder to write, as shown by
/// --help.
CLI::Option* reads_file(CLI::Option* option);
CLI::Option* writes_file(CLI::Option* option);
CLI::Option* writes_folder(CLI::Option* option);
/// Requires a number >= 0.
CLI::Option* not_negative(CLI::Option* option);

/// Requires finite numbers for all options of all commands, and integers for counts.
/// Call it after all options have been added.
void check_numbers(CLI::App& app);
/// Throws InputError when an output file of the given options is also an input or another output.
void refuse_clashing_files(const CLI::App& app);
/// Throws InputError when an output of the given options cannot be written: before the work, not
/// after hours of it.
void refuse_unwritable_files(const CLI::App& app);

}  // namespace trunnion::cli
