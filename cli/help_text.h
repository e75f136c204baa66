// Layout of --help: 80 columns, an example for each command.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace trunnion::cli {

/// Sets layout and examples of the help for the program and all its commands. Call it after all
/// options have been added.
void set_help(CLI::App& app);

/// "--setup FILE", "PROGRAM".
std::string option_words(const CLI::Option& option);
/// The placeholder after the name: FILE, NUMBER, N, TEXT; empty for a switch.
std::string value_word(const CLI::Option& option);

/// Examples of a command as typed; empty for a name that is not a command.
std::vector<std::string> examples_of(const std::string& command);

}  // namespace trunnion::cli
