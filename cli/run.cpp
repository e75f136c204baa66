// trunnion run: an NC program on the emulated control and the physical machine.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "backup/control_files.h"
#include "base/console.h"
#include "base/numbers.h"
#include "base/output_files.h"
#include "cli/budget_options.h"
#include "cli/command.h"
#include "cli/long_work.h"
#include "cli/notes.h"
#include "cli/options.h"
#include "cli/page_options.h"
#include "cli/setups.h"
#include "effects/settings.h"
#include "inputs/program_choice.h"
#include "report/run_page.h"
#include "report/run_report.h"
#include "setup/control_axes.h"

namespace trunnion::cli {
namespace {

struct RunCommandOptions {
    std::string program, setup, control, trace, readings, print, variables;
    std::vector<std::string> folders, sets, injections, measure;
    std::uint64_t seed = 1;
    BudgetOptions limits;
    double trace_step_mm = 0.0, trace_chord_mm = 0.0;
    bool truth = false, ballbar = false, json = false;
    PageOptions page;
    const CLI::App* command = nullptr;  ///< as parsed, for the footer of the page
};

int whole(const std::string& text, const char* option) {
    const auto n = parse_number(text);
    if (!n || *n < 1 || *n > 999999 || *n != static_cast<int>(*n))
        throw InputError(fmt::format("{}: '{}' is not a variable number", option, text));
    return static_cast<int>(*n);
}

std::string without_hash(const std::string& text) {
    return text.starts_with("#") ? text.substr(1) : text;
}

std::map<int, double> parse_sets(const std::vector<std::string>& sets) {
    std::map<int, double> values;
    for (const std::string& set : sets) {
        const std::size_t equal = set.find('=');
        const auto value =
            equal == std::string::npos ? std::nullopt : parse_number(set.substr(equal + 1));
        if (!value)
            throw InputError(fmt::format("--set: '{}' does not have the form '#100=3.5'", set));
        values[whole(without_hash(set.substr(0, equal)), "--set")] = *value;
    }
    return values;
}

/// "100-149,500"
std::vector<int> parse_variables(const std::string& text) {
    std::vector<int> numbers;
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t end = std::min(text.find(',', i), text.size());
        const std::string part = text.substr(i, end - i);
        const std::size_t dash = part.find('-');
        const int first = whole(without_hash(part.substr(0, dash)), "--vars");
        const int last = dash == std::string::npos
                             ? first
                             : whole(without_hash(part.substr(dash + 1)), "--vars");
        if (last < first)
            throw InputError(
                fmt::format("--vars: '{}' is a descending range; write {}-{}", part, last, first));
        for (int n = first; n <= last; ++n) numbers.push_back(n);
        i = end + 1;
    }
    return numbers;
}

setup::Setup setup_of(const RunCommandOptions& o) {
    setup::Setup setup = open_setup(o.setup);
    if (!o.control.empty()) backup::apply_backup(backup::read_backup(o.control), setup.stores);
    const effects::Catalogue catalogue = effects::make_catalogue(setup);
    for (const std::string& text : o.injections)
        setup.effects.push_back(effects::parse_injection(text, catalogue));
    return setup;
}

/// The programs of a backup lie in its control's memory.
std::vector<std::string> folders_of(const RunCommandOptions& o) {
    std::vector<std::string> folders = o.folders;
    if (!o.control.empty()) folders.push_back(o.control);
    return folders;
}

emulator::RunOptions run_options(const RunCommandOptions& o, const setup::Setup& setup) {
    emulator::RunOptions options;
    options.seed = o.seed;
    options.trace = !o.trace.empty();
    options.trace_step_mm = o.trace_step_mm;
    options.trace_chord_mm = o.trace_chord_mm;
    options.truth = o.truth;
    options.automatic_ballbar = o.ballbar;
    options.measure = o.measure;
    options.budget = budget_of(o.limits);
    options.variables = parse_sets(o.sets);
    options.wanted_variables = parse_variables(o.variables);
    options.effects = effects::active_models(setup);
    return options;
}

/// An alarm or a limit ends a run like M30: the files contain everything up to that point.
void write_files(const RunCommandOptions& o, const emulator::RunLog& log, OutputFiles& files) {
    if (!o.readings.empty()) files.add(o.readings, records::format_readings(log.readings));
    if (!o.print.empty()) files.add(o.print, log.printed);
    files.write();
}

int exit_code(const emulator::RunLog& log) {
    const controller::RunResult& result = log.result;
    if (result.status == controller::RunStatus::limit)
        return report_limit(log.limit, result.blocks);
    if (!result.alarm) return exit_done;
    const Alarm& alarm = *result.alarm;
    print_error("{}\n", format_diagnostic(alarm.where, emulator::title_of(alarm), alarm.block));
    return exit_alarm;
}

/// Shows progress; Ctrl-C ends the run like a limit.
emulator::RunLog run_watched(const setup::Setup& setup, inputs::ProgramAndFolders& program,
                             emulator::RunOptions options) {
    Progress progress;
    options.budget.progress = [&](std::uint64_t blocks) { progress.count(blocks, 0, "blocks"); };
    return emulator::run_program(setup, program.folders, program.program, options);
}

/// The page of a run requires the physical tip, and samples dense enough for smooth curves.
constexpr double page_chord_mm = 0.05;

void follow_path(emulator::RunOptions& options, report::RunPath& path) {
    options.trace = options.truth = true;
    if (options.trace_chord_mm == 0.0) options.trace_chord_mm = page_chord_mm;
    options.trace_chunk = [&path](std::string_view text) { path.add(text); };
}

std::string page_of_run(const RunCommandOptions& o, const setup::Setup& setup,
                        const emulator::RunLog& log, const report::RunPath& path,
                        const std::vector<interpreter::ProgramText>& programs) {
    report::ProgramTexts texts;
    for (const interpreter::ProgramText& program : programs)
        texts[program.name] = std::string(program.text);
    report::Page page = report::run_page(setup, log, path, texts);
    page.title = "Run of " + o.program;
    page.origin = page_origin(*o.command, o.page);
    page.origin.seed = o.seed;
    return report::page_html(page);
}

int run_command(const RunCommandOptions& o) {
    if (!o.page.html.empty() && !o.trace.empty())
        throw InputError(
            "--html and --trace cannot be combined: the page samples the curves itself");
    if ((o.truth || o.trace_step_mm > 0.0 || o.trace_chord_mm > 0.0) && o.trace.empty())
        throw InputError("--truth, --trace-step and --trace-chord require --trace FILE");
    const setup::Setup setup = setup_of(o);
    inputs::ProgramAndFolders program = inputs::open_program(o.program, folders_of(o));
    emulator::RunOptions options = run_options(o, setup);
    const Interruption interruption;
    OutputFiles files;
    if (options.trace)
        options.trace_chunk = [&out = files.open(o.trace)](std::string_view text) {
            out.append(text);
        };
    report::RunPath path;
    if (!o.page.html.empty()) follow_path(options, path);
    const emulator::RunLog log = run_watched(setup, program, options);
    print_notes(log.notes);
    print_notes(program.folders.announcements());
    if (o.json)
        print_out("{}", report::run_json(log, setup::all_machine_axes(setup),
                                         program.folders.used(), ReadRecord::files()));
    else if (o.print.empty())
        print_out("{}", log.printed);
    if (!o.json && !o.variables.empty()) print_out("{}", report::variables_text(log));
    if (!o.json) print_notes({report::run_summary(log)});
    if (!o.page.html.empty())
        files.add(o.page.html, page_of_run(o, setup, log, path, program.folders.used()));
    write_files(o, log, files);
    return exit_code(log);
}

}  // namespace

void add_run(CLI::App& app, Run& run) {
    const auto o = std::make_shared<RunCommandOptions>();
    CLI::App* command = app.add_subcommand("run", "run an NC program on the emulated machine");
    reads_file(command->add_option("PROGRAM", o->program, "program file or O number"))->required();
    reads_file(command->add_option("--setup", o->setup, "setup file (machines/bc_table.toml)"));
    reads_file(
        command->add_option("--programs", o->folders, "folder of further programs, repeatable"))
        ->allow_extra_args(false);
    reads_file(command->add_option("--control", o->control,
                                   "backup folder of a real control: its values replace those of "
                                   "the setup, its programs can be called"));
    command->add_option("--seed", o->seed, "seed of the noise of the devices (1)");
    writes_file(command->add_option("--trace", o->trace, "write a CSV with one row for each move"));
    // Each move is sampled completely: smaller steps would fill the memory without benefit.
    command->add_option("--trace-step", o->trace_step_mm, "add SAMPLE rows at this distance, mm")
        ->check(CLI::Range(1e-3, 1e6, "0.001 to 1e6"));
    command
        ->add_option("--trace-chord", o->trace_chord_mm,
                     "add SAMPLE rows that follow arcs and G43.4 within this tolerance, mm")
        ->check(CLI::Range(1e-6, 1e6, "1e-6 to 1e6"));
    command->add_flag("--truth", o->truth, "add the position of the physical tool tip");
    writes_file(
        command->add_option("--readings", o->readings, "write the readings of the devices (CSV)"));
    writes_file(command->add_option("--print", o->print, "file for the output of DPRNT"));
    command->add_option("--set", o->sets, "set a variable before the run: '#100=3.5'")
        ->allow_extra_args(false);
    command->add_option("--vars", o->variables, "variables to report: 100-149,500");
    command
        ->add_option("--inject", o->injections, "switch an effect on: 'C.backlash: gap_rad=6e-5'")
        ->allow_extra_args(false);
    command->add_flag("--ballbar", o->ballbar,
                      "record ballbar readings on all feed moves in its range, without BALLBAR ON");
    command
        ->add_option("--measure", o->measure,
                     "add a measuring device: 'linear R1 X' reads at each dwell (G4), 'axis X 250' "
                     "logs an axis at 250 Hz (docs/readings.md)")
        ->allow_extra_args(false);
    add_budget(*command, o->limits);
    command->add_flag("--json", o->json, "print the result as one JSON object");
    add_page_options(*command, o->page);
    o->command = command;
    command->callback([o, &run] { run = [o] { return run_command(*o); }; });
}

}  // namespace trunnion::cli
