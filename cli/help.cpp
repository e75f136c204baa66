// trunnion help: the help of a command, or a page on common topics.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "base/alarm.h"
#include "base/console.h"
#include "base/nearest.h"
#include "cli/command.h"
#include "cli/help_text.h"

namespace trunnion::cli {
namespace {

struct Topic {
    const char *name, *text;
};

constexpr Topic topics[] = {
    {"exit-codes",
     "0  done, equal, nothing found\n"
     "1  differs, findings, or a gap above --limit-um\n"
     "2  bad input or usage: one message with file, line and column\n"
     "3  NC alarm\n"
     "4  a limit was hit, or Ctrl-C\n"
     "5  internal error: please report it\n"},
    {"files",
     "An output never overwrites an input, and appears whole or not at all. - as a\n"
     "program or a table of readings is standard input. The machine is\n"
     "machines/bc_table.toml unless --setup names another; readings are never judged\n"
     "without --setup. machines/ and programs/ are found beside the program, or in\n"
     "the folder that TRUNNION_HOME names.\n"},
    {"frames",
     "M  fixed to the bed, axes along the nominal linear axes, tool-motion sense\n"
     "W  fixed to the table, equal to M when all axes are at zero\n"
     "S  fixed to the spindle, parallel to M when all axes are at zero, origin at the\n"
     "   gauge point\n"
     "Errors have ISO 230 names, along and about the + axes of M: EX0C is the place of\n"
     "the C axis along X, EA0C its tilt about X, EXX the positioning error of X.\n"},
    {"functions",
     "DPP    the post turns the points about the pivot in G54\n"
     "RTDFO  G54.2, rotary table dynamic fixture offset, about G54\n"
     "RTCP   G43.4, on a Hurco M128: pivot from 19700-19714\n"
     "TW     G68.2 with G53.1: pivot from 19700-19714\n"},
    {"units",
     "Files hold mm, rad (deg where the name says so), s, mm/min. A name ends in its\n"
     "unit: error_mm, gap_rad, time_s. --inject takes any of um mm m urad mrad rad\n"
     "arcsec deg ppm us ms s behind a number: --inject 'C.backlash=60urad'.\n"}};

std::vector<std::string> names_of(const CLI::App& app) {
    std::vector<std::string> names;
    for (const Topic& topic : topics) names.emplace_back(topic.name);
    for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
    return names;
}

int help_command(const CLI::App& app, const std::string& name) {
    if (name.empty()) {
        print_out("{}\nTopics of trunnion help:",
                  app.get_formatter()->make_help(&app, "trunnion", CLI::AppFormatMode::Normal));
        for (const Topic& topic : topics) print_out(" {}", topic.name);
        print_out("\n");
        return exit_done;
    }
    for (const Topic& topic : topics)
        if (name == topic.name) {
            print_out("{}", topic.text);
            return exit_done;
        }
    for (const CLI::App* command : app.get_subcommands({}))
        if (command->get_name() == name) {
            print_out("{}", command->help("trunnion"));
            return exit_done;
        }
    const std::string near = did_you_mean(name, names_of(app));
    throw InputError("no help on '" + name + "'" +
                     (near.empty() ? "; 'trunnion help' lists commands and topics" : near));
}

}  // namespace

void add_help(CLI::App& app, Run& run) {
    const auto name = std::make_shared<std::string>();
    CLI::App* command = app.add_subcommand("help", "print help on a command or a topic");
    command->add_option("TOPIC", *name, "a command, exit-codes, files, frames, functions or units");
    command->callback(
        [name, &app, &run] { run = [name, &app] { return help_command(app, *name); }; });
}

}  // namespace trunnion::cli
