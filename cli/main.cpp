// trunnion: parses the command line, runs one command, turns what it throws into messages and
// codes.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <initializer_list>

#include "cli/command.h"
#include "geometry/alarm.h"

namespace {

using namespace trunnion;

/// One line a command: file cli/NAME.cpp, declared in cli/command.h.
// clang-format off
const std::initializer_list<void (*)(CLI::App&, Run&)> commands = {
    add_backup,
    add_ballbar,
    add_check,
    add_compare,
    add_compensate,
    add_diagnose,
    add_identify,
    add_merge,
    add_pivot,
    add_predict,
    add_run,
    add_volumetric,
};
// clang-format on

int report_alarm(const Alarm& alarm) {
    fmt::print(stderr, "{}\n",
               format_diagnostic(alarm.where, fmt::format("alarm {} {}", alarm.number, alarm.text),
                                 alarm.block));
    return exit_alarm;
}

int run_guarded(const Run& run) {
    try {
        return run();
    } catch (const InputError& e) {
        fmt::print(stderr, "{}\n", format_diagnostic(e.where, e.message, e.line_text));
        return exit_bad_input;
    } catch (const Alarm& alarm) {
        return report_alarm(alarm);
    } catch (const std::exception& e) {
        fmt::print(stderr, "trunnion: internal error: {}\n", e.what());
        return exit_internal;
    }
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{"trunnion: an offline CNC control with a physical five-axis machine behind it"};
    app.require_subcommand(1);
    app.set_version_flag("--version", TRUNNION_VERSION);
    Run run;
    for (const auto add : commands) add(app, run);
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& e) {
        return app.exit(e);
    } catch (const CLI::ParseError& e) {
        fmt::print(stderr, "trunnion: {} (trunnion --help lists commands and options)\n", e.what());
        return exit_bad_input;
    }
    return run_guarded(run);
}
