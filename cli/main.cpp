// trunnion: parses the command line, runs one command, converts exceptions into messages and exit
// codes.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <new>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "base/alarm.h"
#include "base/console.h"
#include "base/nearest.h"
#include "base/read_file.h"
#include "base/text.h"
#include "base/waiting.h"
#include "cli/budget_options.h"
#include "cli/command.h"
#include "cli/heap.h"
#include "cli/help_text.h"
#include "cli/long_work.h"
#include "cli/notes.h"
#include "cli/options.h"
#include "cli/page_options.h"
#include "emulator/run.h"

namespace trunnion::cli {

namespace {

struct Command {
    std::string_view name;
    void (*add)(CLI::App&, Run&);
    bool tells_of_all = false;  ///< what it prints depends on all commands
};

/// One line a command: file cli/NAME.cpp, declared in cli/command.h.
// clang-format off
constexpr Command commands[] = {
    {"backup", add_backup},
    {"ballbar", add_ballbar},
    {"check", add_check},
    {"compare", add_compare},
    {"compensate", add_compensate},
    {"completion", add_completion, true},
    {"diagnose", add_diagnose},
    {"effects", add_effects},
    {"help", add_help, true},
    {"identify", add_identify},
    {"import", add_import},
    {"merge", add_merge},
    {"pivot", add_pivot},
    {"predict", add_predict},
    {"run", add_run},
    {"volumetric", add_volumetric},
};
// clang-format on

/// The command that the first word names, or all: the options of one command are quick to declare,
/// those of all take longer than a short program runs.
void add_commands(CLI::App& app, Run& run, const std::vector<std::string>& words) {
    const auto is_asked = [&](const Command& c) { return !words.empty() && c.name == words[0]; };
    const auto asked = std::find_if(std::begin(commands), std::end(commands), is_asked);
    const bool all = asked == std::end(commands) || asked->tells_of_all;
    for (const Command& command : commands)
        if (all || &command == asked) command.add(app, run);
}

int report_alarm(const Alarm& alarm) {
    print_error("{}\n", format_diagnostic(alarm.where, emulator::title_of(alarm), alarm.block));
    return exit_alarm;
}

int report_input_error(const InputError& e) {
    print_error("{}\n", format_diagnostic(e.where, e.message, e.line_text));
    return exit_bad_input;
}

int report_usage_error(const std::string& message) {
    print_error("trunnion: {} (trunnion --help lists commands and options)\n", printable(message));
    return exit_bad_input;
}

/// The command named by the words, and the first word in the position of a command that is not one.
struct NamedCommand {
    const CLI::App* command = nullptr;
    std::string unknown;  ///< empty: all are known
};

NamedCommand named_command(const CLI::App& app, const std::vector<std::string>& words) {
    NamedCommand out{&app, {}};
    for (const std::string& word : words) {
        if (word.starts_with('-') || out.command->get_subcommands({}).empty()) break;
        const auto named = out.command->get_subcommands(
            [&](const CLI::App* command) { return command->check_name(word); });
        if (named.empty()) return {out.command, word};
        out.command = named.front();
    }
    return out;
}

std::string no_such_command(const NamedCommand& named) {
    std::vector<std::string> names;
    for (const CLI::App* command : named.command->get_subcommands({}))
        names.push_back(command->get_name());
    if (named.unknown.empty())
        return fmt::format("a command is missing: {}", fmt::join(names, ", "));
    return fmt::format("there is no command '{}'{}", named.unknown,
                       did_you_mean(named.unknown, names));
}

/// Names the first option that the command does not have; what the parser said where there is none.
std::string no_such_option(const CLI::App& command, const std::vector<std::string>& words,
                           const std::string& parser_says) {
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options())
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const std::string& word : words) {
        const std::string name = word.substr(0, word.find('='));
        if (name.starts_with("--") && std::find(names.begin(), names.end(), name) == names.end())
            return fmt::format("{} has no option '{}'{}", command.get_name(), name,
                               did_you_mean(name, names));
    }
    return parser_says;
}

/// An option in the place of another one's value, as in `--svg --json`; empty if there is none.
std::string option_as_value(const CLI::App& command, const std::vector<std::string>& words) {
    for (std::size_t k = 1; k < words.size(); ++k) {
        const CLI::Option* before = command.get_option_no_throw(words[k - 1]);
        const bool takes_value =
            words[k - 1].starts_with("--") && before && before->get_items_expected_min() > 0;
        if (takes_value && words[k].starts_with("--") && command.get_option_no_throw(words[k]))
            return fmt::format("{} needs a value, and {} is an option", words[k - 1], words[k]);
    }
    return {};
}

/// Adds --quiet, --verbose and --max-memory to every command.
void add_common(CLI::App& app) {
    for (CLI::App* command : app.get_subcommands({})) {
        CLI::Option* quiet = command->add_flag(
            "-q,--quiet", [](std::int64_t) { set_talk(Talk::quiet); },
            "print results and errors only, no notes and no progress");
        command
            ->add_flag(
                "--verbose", [](std::int64_t) { set_talk(Talk::verbose); },
                "also print the files read with their SHA-256, and the elapsed time")
            ->excludes(quiet);
        add_memory_limit(*command);
    }
}

/// What --verbose says when the work is done.
void tell_work(double passed_s) {
    for (const FileRead& file : ReadRecord::files())
        print_error("read {} (sha256 {})\n", printable(file.path), file.sha256);
    print_error("{:.3f} s\n", passed_s);
}

/// Reports in these forms name their inputs by hash.
bool tells_inputs(const CLI::App& app) {
    const auto given = [](const CLI::App& command, const char* name) {
        const CLI::Option* option = command.get_option_no_throw(name);
        return option && option->count() > 0;
    };
    const auto commands = app.get_subcommands();
    return std::any_of(commands.begin(), commands.end(), [&](const CLI::App* command) {
        return given(*command, "--json") || given(*command, "--html") ||
               given(*command, "--format") || given(*command, "--shard");
    });
}

/// --max-seconds of the command, or 0.
double time_limit_s(const CLI::App& app) {
    for (const CLI::App* command : app.get_subcommands())
        if (const CLI::Option* given = command->get_option_no_throw("--max-seconds"))
            return given->count() > 0 ? given->as<double>() : 0.0;
    return 0.0;
}

int run_guarded(const CLI::App& app, const Run& run) {
    std::optional<ReadRecord> record;
    if (tells_inputs(app) || talk() == Talk::verbose) record.emplace();
    try {
        refuse_clashing_files(app);
        refuse_unwritable_files(app);
        const WaitLimits waits(time_limit_s(app), Interruption::asked);
        const auto begin = std::chrono::steady_clock::now();
        const int code = run();
        const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin;
        if (talk() == Talk::verbose) tell_work(passed.count());
        finish_out();
        return code;
    } catch (const InputError& e) {
        return report_input_error(e);
    } catch (const Alarm& alarm) {
        return report_alarm(alarm);
    } catch (const std::filesystem::filesystem_error& e) {
        return report_input_error({e.code().message(), {e.path1().string(), 0, 0}});
    }
}

/// Help and version go to standard output.
int show_help(const CLI::App& app, const CLI::Success& asked) {
    std::ostringstream text;
    app.exit(asked, text, text);
    write_out(text.str());
    finish_out();
    return exit_done;
}

int parse_and_run(int argc, char** argv) {
    CLI::App app{"trunnion: an offline CNC control with a physical five-axis machine behind it",
                 "trunnion"};
    app.require_subcommand(1);
    app.set_version_flag("--version", TRUNNION_VERSION);
    Run run;
    const std::vector<std::string> words(argv + 1, argv + argc);
    add_commands(app, run, words);
    add_common(app);
    check_numbers(app);
    set_help(app);
    const NamedCommand named = named_command(app, words);
    if (!named.unknown.empty()) return report_usage_error(no_such_command(named));
    if (const std::string fault = option_as_value(*named.command, words); !fault.empty())
        return report_usage_error(fault);
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& asked) {
        return show_help(app, asked);
    } catch (const CLI::ParseError& e) {
        const bool lacks_command =
            e.get_name() == "RequiredError" && !named.command->get_subcommands({}).empty();
        const std::string says = lacks_command ? no_such_command(named) : e.what();
        return report_usage_error(no_such_option(*named.command, words, says));
    }
    return run_guarded(app, run);
}

}  // namespace

}  // namespace trunnion::cli

using namespace trunnion;

namespace {

/// The only object that the handlers below share.
std::atomic<bool> memory_is_missing = false;

constexpr const char* not_enough_memory =
    "trunnion: there is not enough memory (--max-memory, or this computer)\n";

void note_missing_memory() {
    memory_is_missing = true;
    throw std::bad_alloc();
}

/// Libraries end the program where memory is missing inside a noexcept function (CLI11, toml++,
/// std::filesystem): that is a limit, too. Code of GCC before 13 tells the handler no exception
/// then, so the note decides.
[[noreturn]] void end_without_memory() {
    try {
        if (const auto failure = std::current_exception()) std::rethrow_exception(failure);
    } catch (const std::bad_alloc&) {  // Eigen throws without asking for more
        memory_is_missing = true;
    } catch (...) {
    }
    if (!memory_is_missing) std::abort();
    write_error(not_enough_memory);
    std::_Exit(exit_limit);
}

/// nlohmann::json 3.11.2 and lists in braces of GCC 12 destroy what could not be made, by a null
/// pointer, where memory is missing: that is a limit, too. Any other fault happens again at the
/// return, without this handler.
void end_at_missing_object(int signal) {
    if (!memory_is_missing) {
        std::signal(signal, SIG_DFL);
        return;
    }
    write_error(not_enough_memory);
    std::_Exit(exit_limit);
}

}  // namespace

int main(int argc, char** argv) {
    cli::keep_freed_memory();
    std::set_new_handler(note_missing_memory);
    std::set_terminate(end_without_memory);
    std::signal(SIGSEGV, end_at_missing_object);
    prepare_streams();
    try {
        return cli::parse_and_run(argc, argv);
    } catch (const std::bad_alloc&) {
        write_error(not_enough_memory);
        return exit_limit;
    } catch (const InputError& e) {  // of the help
        return cli::report_input_error(e);
    } catch (const std::exception& e) {
        write_error("trunnion: internal error: ");
        write_error(e.what());
        write_error("\n");
        return exit_internal;
    }
}
