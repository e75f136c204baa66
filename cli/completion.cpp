// trunnion completion: input for shells and man, generated from the program's own options.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <map>
#include <memory>

#include "base/console.h"
#include "cli/command.h"
#include "cli/help_text.h"

namespace trunnion::cli {
namespace {

/// Long names of a command's switches and options: "--setup".
std::vector<std::string> long_names(const CLI::App& command) {
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options())
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    return names;
}

std::vector<std::string> command_names(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
    return names;
}

std::string bash_text(const CLI::App& app) {
    std::string cases;
    for (const CLI::App* command : app.get_subcommands({}))
        cases += fmt::format("    {}) words=\"{}\" ;;\n", command->get_name(),
                             fmt::join(long_names(*command), " "));
    return fmt::format(
        "# bash completion of trunnion\n_trunnion() {{\n"
        "  local cur=\"${{COMP_WORDS[COMP_CWORD]}}\" words=\"\"\n"
        "  if [ \"$COMP_CWORD\" -eq 1 ]; then\n"
        "    COMPREPLY=($(compgen -W \"{} --help --version\" -- \"$cur\"))\n    return\n  fi\n"
        "  case \"${{COMP_WORDS[1]}}\" in\n{}  esac\n"
        "  case \"$cur\" in\n    -*) COMPREPLY=($(compgen -W \"$words\" -- \"$cur\")) ;;\n"
        "    *) COMPREPLY=($(compgen -f -- \"$cur\")) ;;\n  esac\n}}\n"
        "complete -o filenames -F _trunnion trunnion\n",
        fmt::join(command_names(app), " "), cases);
}

/// Escapes text for single quotes and the brackets of zsh.
std::string plain(std::string text) {
    for (char& c : text)
        if (c == '\'' || c == '[' || c == ']' || c == ':' || c == '\n') c = ' ';
    return text;
}

std::string zsh_text(const CLI::App& app) {
    std::string commands, cases;
    for (const CLI::App* command : app.get_subcommands({})) {
        commands +=
            fmt::format("    '{}:{}'\n", command->get_name(), plain(command->get_description()));
        cases += fmt::format("    {})\n      _arguments", command->get_name());
        for (const CLI::Option* option : command->get_options())
            for (const std::string& name : option->get_lnames())
                cases +=
                    fmt::format(" \\\n        '--{}[{}]{}'", name, plain(option->get_description()),
                                value_word(*option).empty()     ? ""
                                : value_word(*option) == "FILE" ? ":file:_files"
                                                                : ":value:");
        cases += " \\\n        '*:file:_files' ;;\n";
    }
    return fmt::format(
        "#compdef trunnion\n_trunnion() {{\n  local -a commands=(\n{}  )\n"
        "  if (( CURRENT == 2 )); then\n    _describe command commands\n    return\n  fi\n"
        "  local command=$words[2]\n  shift words\n  (( CURRENT-- ))\n  case $command in\n{}  "
        "esac\n"
        "}}\n_trunnion \"$@\"\n",
        commands, cases);
}

std::string fish_text(const CLI::App& app) {
    std::string out = "# fish completion of trunnion\n";
    for (const CLI::App* command : app.get_subcommands({})) {
        out += fmt::format("complete -c trunnion -n __fish_use_subcommand -f -a {} -d '{}'\n",
                           command->get_name(), plain(command->get_description()));
        for (const CLI::Option* option : command->get_options())
            for (const std::string& name : option->get_lnames())
                out += fmt::format(
                    "complete -c trunnion -n '__fish_seen_subcommand_from {}' -l {}{} -d '{}'\n",
                    command->get_name(), name, value_word(*option).empty() ? "" : " -r",
                    plain(option->get_description()));
    }
    return out;
}

/// Escapes text for a man page: backslash, and a leading point or quote.
std::string roff(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if (c == '\\')
            out += "\\e";
        else if (c == '-')
            out += "\\-";
        else
            out += c;
    }
    return !out.empty() && (out[0] == '.' || out[0] == '\'') ? "\\&" + out : out;
}

std::string man_command(const CLI::App& command) {
    std::string out =
        fmt::format(".SS {}\n{}.\n", roff(command.get_name()), roff(command.get_description()));
    for (const CLI::Option* option : command.get_options())
        out += fmt::format(".TP\n.B {}\n{}\n", roff(option_words(*option)),
                           roff(option->get_description()));
    const auto examples = examples_of(command.get_name());
    if (!examples.empty()) out += ".PP\nExample:\n.PP\n.nf\n";
    for (const std::string& line : examples) out += roff(line) + "\n";
    return examples.empty() ? out : out + ".fi\n";
}

std::string man_text(const CLI::App& app) {
    std::string out = fmt::format(
        ".TH TRUNNION 1 \"\" \"trunnion {}\" \"User commands\"\n.SH NAME\n"
        "trunnion \\- {}\n.SH SYNOPSIS\n.B trunnion\n.I COMMAND\n[OPTIONS]\n.SH COMMANDS\n",
        TRUNNION_VERSION, roff("offline CNC control with a physical five-axis machine behind it"));
    for (const CLI::App* command : app.get_subcommands({})) out += man_command(*command);
    out +=
        ".SH EXIT STATUS\n0 done, equal or nothing found; 1 differs or found something; 2 bad "
        "input or usage; 3 NC alarm; 4 a limit was hit or Ctrl\\-C; 5 internal error.\n"
        ".SH ENVIRONMENT\n.TP\n.B TRUNNION_HOME\nfolder that holds machines/ and programs/\n"
        ".TP\n.B SOURCE_DATE_EPOCH\ndate in the foot of pages\n";
    return out;
}

using Form = std::string (*)(const CLI::App&);
const std::map<std::string, Form>& forms() {
    static const std::map<std::string, Form> table{
        {"bash", bash_text}, {"fish", fish_text}, {"man", man_text}, {"zsh", zsh_text}};
    return table;
}

}  // namespace

void add_completion(CLI::App& app, Run& run) {
    const auto form = std::make_shared<std::string>();
    CLI::App* command = app.add_subcommand("completion", "print shell completions or the man page");
    command->add_option("FORM", *form, "bash, zsh, fish or man")
        ->required()
        ->check(CLI::IsMember(forms()));
    command->callback([form, &app, &run] {
        run = [form, &app] {
            write_out(forms().at(*form)(app));
            return exit_done;
        };
    });
}

}  // namespace trunnion::cli
