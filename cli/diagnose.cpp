// trunnion diagnose: location of the sim-to-real gap, its causes, and its reduction.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>

#include "base/alarm.h"
#include "base/console.h"
#include "base/output_files.h"
#include "cli/budget_options.h"
#include "cli/command.h"
#include "cli/diagnose_program.h"
#include "cli/heap.h"
#include "cli/long_work.h"
#include "cli/notes.h"
#include "cli/options.h"
#include "cli/page_options.h"
#include "cli/readings_command.h"
#include "diagnosis/diagnosis.h"
#include "emulator/declared.h"
#include "records/same_readings.h"
#include "report/diagnosis_json.h"
#include "report/diagnosis_page.h"
#include "report/diagnosis_text.h"

namespace trunnion::cli {
namespace {

struct DiagnoseOptions {
    std::vector<std::string> readings;
    std::string setup, holdout, out, over;
    PageOptions page;
    const CLI::App* command = nullptr;
    std::optional<double> limit_um;
    double max_seconds = 0.0;
    bool json = false, allow_large = false;
    std::string program;  ///< not empty: the readings are a control's log of this program
    std::vector<std::string> folders;
    std::uint64_t max_blocks = 10'000'000;
};

std::string title_of(const std::vector<std::string>& readings) {
    return fmt::format("{}", fmt::join(readings, " + "));
}

/// Shows what it works on; as long as `meter` allows.
diagnosis::Diagnosis diagnose_watched(const setup::Setup& setup, const records::ReadingTable& table,
                                      diagnosis::DiagnosisOptions how, BudgetMeter& meter) {
    use_large_pages();
    Progress progress;
    std::string now;
    how.watch = [&](const char* stage) { progress.stage(now = stage); };
    how.go_on = how.plan_on = [&] {
        progress.lasting(now);
        return meter.allows({});
    };
    return diagnosis::diagnose(setup, table, how);
}

int diagnose_log(const DiagnoseOptions& options) {
    if (!options.holdout.empty() || options.allow_large || !options.over.empty() ||
        options.readings.size() != 1)
        throw InputError(
            "--program takes one log of axis positions, without --holdout, --over and "
            "--allow-large");
    return diagnose_program({options.readings.front(), options.setup, options.program, options.out,
                             options.folders, options.max_blocks, options.page, options.command,
                             options.limit_um.value_or(-1.0), options.json});
}

/// What was not done, when a limit ended the work.
int report_unfinished(const diagnosis::Diagnosis& d, BudgetLimit limit) {
    print_error("trunnion: {}: {}\n", reason_of(limit),
                d.unfinished ? "the search was not finished: the verdict is that of the best model "
                               "so far, without a plan for the next measurement"
                             : "without a plan for the next measurement");
    return exit_limit;
}

int diagnose_command(const DiagnoseOptions& options) {
    if (!options.program.empty()) return diagnose_log(options);
    if (!options.folders.empty()) throw InputError("--programs requires --program");
    const Interruption interruption;  // while the tables are read too
    setup::Setup setup = load_setup_option(options.setup);
    setup.model.allow_large = options.allow_large;
    const records::ReadingTable table = load_readings(options.readings, setup);
    std::optional<records::ReadingTable> holdout;
    if (!options.holdout.empty()) holdout = load_readings(options.holdout, setup);
    emulator::refuse_declared_otherwise(setup, table);
    if (holdout) emulator::refuse_declared_otherwise(setup, *holdout);
    if (holdout) records::refuse_same_readings(table, *holdout);
    diagnosis::DiagnosisOptions how;
    how.holdout = holdout ? &*holdout : nullptr;
    how.over_sessions = !options.over.empty();
    BudgetMeter meter = fit_meter(options.max_seconds);
    const diagnosis::Diagnosis result = diagnose_watched(setup, table, how, meter);
    print_notes(result.notes);
    OutputFiles files;
    if (!options.out.empty()) files.add(options.out, setup::format_setup(result.setup));
    if (!options.page.html.empty())
        files.add(options.page.html,
                  finished_page(report::diagnosis_page(result, title_of(options.readings)),
                                *options.command, options.page));
    files.add("-", options.json ? report::diagnosis_json(result, ReadRecord::files())
                                : report::diagnosis_text(result));
    files.write();
    if (meter.reached() != BudgetLimit::none) return report_unfinished(result, meter.reached());
    return options.limit_um && result.excess_um > *options.limit_um ? exit_differs : exit_done;
}

}  // namespace

void add_diagnose(CLI::App& app, Run& run) {
    auto* command = app.add_subcommand(
        "diagnose", "find the causes of the gap between simulation and readings");
    const auto options = std::make_shared<DiagnoseOptions>();
    reads_file(
        command->add_option("readings", options->readings,
                            "table of readings (CSV); several tables are joined in this order"))
        ->required();
    reads_file(command->add_option("--setup", options->setup, "setup file (required)"));
    reads_file(command->add_option("--holdout", options->holdout,
                                   "readings for validation, excluded from the fit"));
    reads_file(
        command->add_option("--program", options->program,
                            "find the control option or store that differs: the readings are axis "
                            "positions that a control logged while running this program"));
    reads_file(
        command->add_option("--programs", options->folders, "folder of subprograms, repeatable"));
    command->add_option("--max-blocks", options->max_blocks,
                        "stop a run of the program after this number of blocks");
    not_negative(command->add_option("--limit-um", options->limit_um,
                                     "exit with 1 when the gap exceeds this limit"));
    writes_file(
        command->add_option("--out", options->out, "write the setup with the effects added"));
    command
        ->add_option(
            "--over", options->over,
            "'sessions': find what changed between sessions (column session, or one file for each)")
        ->check(CLI::IsMember({"sessions"}));
    add_fit_seconds(*command, options->max_seconds);
    add_page_options(*command, options->page);
    options->command = command;
    command->add_flag(
        "--allow-large", options->allow_large,
        "accept residuals larger than those of any machine tool, otherwise taken for wrong units");
    command->add_flag("--json", options->json, "print the result as one JSON object");
    command->callback([options, &run] { run = [options] { return diagnose_command(*options); }; });
}

}  // namespace trunnion::cli
