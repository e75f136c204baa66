// How --help looks: 80 columns, an example for each command.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace trunnion::cli {

/// Gives the program and all its commands the form of the help and their examples. To be called
/// when all options are there.
void set_help(CLI::App& app);

/// "--setup FILE", "PROGRAM".
std::string option_words(const CLI::Option& option);
/// What stands behind the name: FILE, NUMBER, N, TEXT; empty for a switch.
std::string value_word(const CLI::Option& option);

/// Examples of a command, as typed; none for a name that is no command.
std::vector<std::string> examples_of(const std::string& command);

}  // namespace trunnion::cli
