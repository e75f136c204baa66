// trunnion diagnose: where the sim-to-real gap lies, which effect causes it, how far it shrinks.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>
#include <optional>

#include "base/console.h"
#include "base/output_files.h"
#include "cli/command.h"
#include "cli/long_work.h"
#include "cli/notes.h"
#include "cli/options.h"
#include "cli/page_options.h"
#include "cli/readings_command.h"
#include "diagnosis/diagnosis.h"
#include "report/diagnosis_json.h"
#include "report/diagnosis_page.h"
#include "report/diagnosis_words.h"
#include "report/error_table.h"
#include "report/parameters_json.h"

namespace trunnion::cli {
namespace {

struct Options {
    std::vector<std::string> readings;
    std::string setup, holdout, out;
    PageOptions page;
    const CLI::App* command = nullptr;
    std::optional<double> limit_um;
    bool json = false, allow_large = false;
};

void print_cause(const diagnosis::Cause& cause) {
    print_out("\n{}  {:.0f} % of the gap, probability {:.2f}\n", cause.effect, 100 * cause.share,
              cause.probability);
    print_out("  {}.\n", cause.what);
    if (!cause.usual_cause.empty())
        print_out("  Usual cause: {}. What to do: {}.\n", cause.usual_cause, cause.remedy);
    for (const identification::FitParameter& p : cause.parameters)
        print_out("  {:<20} {:>12.4g} {} {}\n", report::with_component(p), p.value, p.unit,
                  std::isfinite(p.sigma) ? fmt::format("(sigma {:.2g})", p.sigma)
                                         : std::string("(no sigma of its own)"));
    for (const identification::Inseparable& group : cause.unseen)
        print_out("  no reading here sees: {}\n", to_string(group));
    if (!cause.points.empty())
        print_out("  a table of {} values{}\n{}", cause.points.size(),
                  cause.holds_between ? "" : ": at the measured places only",
                  report::error_table(cause));
    if (!cause.rivals.empty())
        print_out("  cannot be told apart here from: {}\n", fmt::join(cause.rivals, ", "));
    print_out(
        "  held out: {:.3f} -> {:.3f} um (noise {:.3f}): shrinks by {:.0f} % ({:.0f} to {:.0f})\n",
        cause.heldout.rms_before_um, cause.heldout.rms_after_um, cause.heldout.noise_um,
        100 * cause.heldout.shrink, 100 * cause.heldout.low, 100 * cause.heldout.high);
}

void print_report(const diagnosis::Diagnosis& d) {
    print_out("verdict: {}\n{}\n", to_string(d.verdict), report::verdict_sentence(d));
    print_out("{} readings ({} set aside), rms {:.3f} um, noise {:.3f} um ({}), excess {:.3f} um\n",
              d.readings, d.outliers, d.rms_um, d.noise_um, to_string(d.noise.source), d.excess_um);
    for (const identification::FoundSide& s : d.sides) print_out("  {}\n", to_string(s));
    if (d.chosen_from > 0) print_out("  chosen evenly from {} readings\n", d.chosen_from);
    for (const diagnosis::DriverShare& w : d.where) print_out("  {}\n", w.text);
    for (const diagnosis::Cause& cause : d.causes) print_cause(cause);
    if (!d.causes.empty())
        print_out(
            "\nafter: rms {:.3f} um; of readings left out the causes explain {:.0f} %{}; the gap "
            "shrinks by {:.0f} % ({:.0f} to {:.0f})\n",
            d.after_rms_um, 100 * d.explained, d.between_places ? "" : " at the measured places",
            100 * d.after.shrink, 100 * d.after.low, 100 * d.after.high);
    if (d.causes.empty())
        for (const identification::Inseparable& group : d.inseparable)
            print_out("no reading here sees: {}\n", to_string(group));
    for (const diagnosis::NextMeasurement& next : d.next) print_out("next: {}\n", next.text);
}

std::string title_of(const std::vector<std::string>& readings) {
    return fmt::format("{}", fmt::join(readings, " + "));
}

/// Shows what it works on. Ctrl-C ends it; once the verdict stands only what is planned after it,
/// `planning` lives then.
diagnosis::Diagnosis diagnose_watched(const setup::Setup& setup, const records::ReadingTable& table,
                                      diagnosis::DiagnosisOptions how,
                                      std::optional<Interruption>& planning) {
    Progress progress;
    how.watch = [&](const char* stage) { progress.stage(stage); };
    how.plan_on = [&] {
        if (!planning) planning.emplace();
        return !Interruption::asked();
    };
    return diagnosis::diagnose(setup, table, how);
}

int diagnose_command(const Options& options) {
    setup::Setup setup = load_setup_option(options.setup);
    setup.model.allow_large = options.allow_large;
    const records::ReadingTable table = load_readings(options.readings, setup);
    std::optional<records::ReadingTable> holdout;
    if (!options.holdout.empty()) holdout = load_readings(options.holdout, setup);
    diagnosis::DiagnosisOptions how;
    how.holdout = holdout ? &*holdout : nullptr;
    std::optional<Interruption> planning;
    const diagnosis::Diagnosis result = diagnose_watched(setup, table, how, planning);
    print_notes(result.notes);
    OutputFiles files;
    if (!options.out.empty()) files.add(options.out, setup::format_setup(result.setup));
    if (!options.page.html.empty())
        files.add(options.page.html,
                  finished_page(report::diagnosis_page(result, title_of(options.readings)),
                                *options.command, options.page));
    if (options.json) files.add("-", report::diagnosis_json(result));
    files.write();
    if (!options.json) print_report(result);
    if (planning && Interruption::asked()) {
        print_error("trunnion: interrupted: no plan of the next measurement\n");
        return exit_limit;
    }
    return options.limit_um && result.excess_um > *options.limit_um ? exit_differs : exit_done;
}

}  // namespace

void add_diagnose(CLI::App& app, Run& run) {
    auto* command = app.add_subcommand("diagnose", "the gap between simulation and readings");
    const auto options = std::make_shared<Options>();
    reads_file(command->add_option("readings", options->readings,
                                   "table of readings (CSV); several are joined in this order"))
        ->required();
    reads_file(command->add_option("--setup", options->setup, "setup file (TOML), needed"));
    reads_file(command->add_option("--holdout", options->holdout,
                                   "readings that take no part in the fit"));
    not_negative(
        command->add_option("--limit-um", options->limit_um, "exit 1 when the gap is larger"));
    writes_file(command->add_option("--out", options->out, "setup with the effects added"));
    add_page_options(*command, options->page);
    options->command = command;
    command->add_flag("--allow-large", options->allow_large,
                      "residuals that no machine tool has are meant, no slip of units");
    command->add_flag("--json", options->json, "result as JSON on stdout");
    command->callback([options, &run] { run = [options] { return diagnose_command(*options); }; });
}

}  // namespace trunnion::cli
