// trunnion identify: fits effects to readings.
#include "identification/identify.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <mutex>
#include <thread>

#include "base/console.h"
#include "base/output_files.h"
#include "base/sha256.h"
#include "cli/budget_options.h"
#include "cli/command.h"
#include "cli/long_work.h"
#include "cli/notes.h"
#include "cli/options.h"
#include "cli/page_options.h"
#include "cli/readings_command.h"
#include "cli/shards.h"
#include "diagnosis/store_causes.h"
#include "diagnosis/stores/store_gap.h"
#include "effects/settings.h"
#include "emulator/declared.h"
#include "emulator/replay.h"
#include "identification/monte_carlo.h"
#include "report/identification_page.h"
#include "report/identification_report.h"
#include "report/stores_text.h"
#include "report/undetermined_stores.h"

namespace trunnion::cli {
namespace {

struct IdentifyOptions {
    std::vector<std::string> readings;
    std::string setup, effects, out, shard;
    int runs = 0;
    std::uint64_t seed = 1;
    double max_seconds = 0.0;
    bool json = false, allow_large = false;
    PageOptions page;
    const CLI::App* command = nullptr;
};

/// The effects to fit, and the readings.
struct Inputs {
    setup::Setup setup;
    records::ReadingTable table;
    std::vector<std::string> effects;
};

/// Number of repetitions of `runs` done by a shard.
int planned(int runs, const regression::Shard& shard) {
    return (runs - shard.index + shard.count) / shard.count;
}

/// The values to enter for the axis locations, if they were fitted and the control has stores for
/// them.
std::string stores_text(const setup::Setup& identified,
                        const identification::Identification& result) {
    const bool located =
        std::any_of(result.parameters.begin(), result.parameters.end(),
                    [](const identification::FitParameter& p) { return p.location.has_value(); });
    if (!located || identified.artefacts.empty()) return {};
    const Vector3 tip_S_mm = identified.probe     ? identified.probe->tip_S_mm
                             : identified.ballbar ? identified.ballbar->cup_S_mm
                                                  : Vector3(0, 0, -150);
    const auto stores = setup::stores_to_type(identified, identified.machine,
                                              identified.artefacts.front().center_W_mm, tip_S_mm);
    if (!stores) return {};
    return report::stores_text(*stores, identified.dialect.family,
                               report::undetermined_stores(identified, result.parameters));
}

/// Shows how far it is; a limit leaves what the repetitions done so far say.
std::vector<identification::Repetition> repeat(const Inputs& in, const IdentifyOptions& options,
                                               const identification::Identification& fitted,
                                               const regression::Shard& shard, BudgetMeter& meter) {
    Progress progress;
    std::mutex showing;
    identification::RepetitionPlan plan{options.runs,
                                        options.seed,
                                        shard.index - 1,
                                        shard.count,
                                        std::max(1U, std::thread::hardware_concurrency()),
                                        {}};
    const int mine = planned(options.runs, shard);
    plan.go_on = [&](int done) {
        const std::lock_guard lock(showing);
        progress.count(static_cast<std::uint64_t>(done), static_cast<std::uint64_t>(mine),
                       "repetitions");
        return meter.allows({});
    };
    return identification::repeat_identification(in.setup, in.table, in.effects, plan, fitted);
}

/// One hash of all inputs of a repetition.
std::string hash_of(const Inputs& in) {
    std::string text = setup::format_setup(in.setup);
    for (const std::string& effect : in.effects) text += effect + '\n';
    return sha256(text + records::format_readings(in.table));
}

/// Exit code; says what was left undone.
int report_done(const identification::Identification& fitted, std::size_t done, int planned,
                BudgetLimit limit) {
    const std::vector<std::string>& left = fitted.not_searched;
    if (!left.empty())
        print_error("trunnion: {}: the keys of {} keep their usual values\n", reason_of(limit),
                    fmt::join(left, ", "));
    if (done < static_cast<std::size_t>(planned))
        print_error("trunnion: {}: {} of {} repetitions completed\n", reason_of(limit), done,
                    planned);
    return left.empty() && done == static_cast<std::size_t>(planned) ? exit_done : exit_limit;
}

/// A shard of the repetitions: its part alone is written, for 'merge'; none when the fit was ended,
/// for parts of other shards belong to another fit.
int identify_part(const Inputs& in, const IdentifyOptions& options,
                  const identification::Identification& fitted, const regression::Shard& shard,
                  BudgetMeter& meter) {
    if (!fitted.not_searched.empty()) return report_done(fitted, 0, 0, meter.reached());
    report::RepetitionPart part{hash_of(in), options.runs, options.seed,
                                fitted,      {},           ReadRecord::files()};
    part.repetitions = repeat(in, options, fitted, shard, meter);
    write_output(shard_path(options.out.empty() ? "-" : options.out, shard),
                 report::format_part(part));
    return report_done(fitted, part.repetitions.size(), planned(options.runs, shard),
                       meter.reached());
}

/// Residuals of the identified setup alone, as `predict` computes them.
std::string page_of(const IdentifyOptions& options, const identification::Identification& result,
                    const records::ReadingTable& table) {
    const records::ReadingTable predicted =
        emulator::predicted(result.setup, table, effects::active_models(result.setup));
    report::Page page = report::identification_page(result, table, predicted);
    if (options.runs > 0) page.origin.seed = options.seed;
    return finished_page(std::move(page), *options.command, options.page);
}

int identify_command(const IdentifyOptions& options) {
    const Interruption interruption;  // while the tables are read too
    if (!options.shard.empty() && options.runs == 0)
        throw InputError("--shard requires --monte-carlo");
    Inputs in{load_setup_option(options.setup), {}, split_names(options.effects)};
    in.setup.model.allow_large = options.allow_large;
    in.table = load_readings(options.readings, in.setup);
    emulator::refuse_declared_otherwise(in.setup, in.table);
    BudgetMeter meter = fit_meter(options.max_seconds);
    identification::Identification result = [&] {
        Progress progress;
        const std::string work = fmt::format("fit to {} rows", in.table.rows.size());
        progress.stage(work);
        return identification::identify(in.setup, in.table, in.effects, [&] {
            progress.lasting(work);
            return meter.allows({});
        });
    }();
    print_notes(result.notes);
    if (const auto gap = diagnosis::store_gap(in.setup, in.table))
        print_notes({"the programmed points (px_mm ..) name other stores than the setup: " +
                     diagnosis::words_of(*gap) +
                     ". The fit is of the machine, at the positions in force; diagnose adds the "
                     "stores"});
    std::vector<identification::Repetition> repetitions;
    if (options.runs > 0) {
        if (const auto shard = shard_of(options.shard))
            return identify_part(in, options, result, *shard, meter);
        repetitions = repeat(in, options, result, {}, meter);
        identification::enter_spread(repetitions, result);
    }
    OutputFiles files;
    if (!options.out.empty()) files.add(options.out, setup::format_setup(result.setup));
    if (!options.page.html.empty())
        files.add(options.page.html, page_of(options, result, in.table));
    files.add("-", options.json ? report::identification_json(result, ReadRecord::files())
                                : report::identification_text(result, repetitions.size() > 1) +
                                      stores_text(result.setup, result));
    files.write();
    return report_done(result, repetitions.size(), options.runs, meter.reached());
}

}  // namespace

void add_identify(CLI::App& app, Run& run) {
    auto* command = app.add_subcommand("identify", "fit effects to readings");
    const auto options = std::make_shared<IdentifyOptions>();
    reads_file(
        command->add_option("readings", options->readings,
                            "table of readings (CSV); several tables are joined in this order"))
        ->required();
    reads_file(command->add_option("--setup", options->setup, "setup file (required)"));
    command->add_option("--effects", options->effects,
                        "names of effects, separated by commas (default: [model].modelled)");
    writes_file(command->add_option("--out", options->out,
                                    "write the setup with the identified values; with --shard the "
                                    "part ({i}: number of the shard)"));
    command
        ->add_option("--monte-carlo", options->runs,
                     "also compute the uncertainty from this number of simulated repetitions")
        ->check(CLI::Range(2, 100000));
    command->add_option("--shard", options->shard,
                        "run one part of the repetitions, for 'merge': i/n, /n or env");
    command->add_option("--seed", options->seed, "seed of the noise of the repetitions (1)");
    add_fit_seconds(*command, options->max_seconds);
    command->add_flag(
        "--allow-large", options->allow_large,
        "accept residuals larger than those of any machine tool, otherwise taken for wrong units");
    command->add_flag("--json", options->json, "print the result as one JSON object");
    add_page_options(*command, options->page);
    options->command = command;
    command->callback([options, &run] { run = [options] { return identify_command(*options); }; });
}

}  // namespace trunnion::cli
