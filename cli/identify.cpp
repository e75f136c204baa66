// trunnion identify: fits effects to readings.
#include "identification/identify.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/console.h"
#include "base/output_files.h"
#include "cli/command.h"
#include "cli/files.h"
#include "cli/json_output.h"
#include "cli/long_work.h"
#include "cli/options.h"
#include "cli/readings_command.h"
#include "identification/monte_carlo.h"
#include "report/stores_text.h"

namespace trunnion::cli {
namespace {

struct Options {
    std::vector<std::string> readings;
    std::string setup, effects, out;
    int runs = 0;
    std::uint64_t seed = 1;
    bool json = false, allow_large = false;
};

nlohmann::ordered_json to_json(const identification::Identification& result) {
    nlohmann::ordered_json json;
    json["schema"] = "trunnion.identification/1";
    json["parameters"] = json_parameters(result.parameters);
    json["inseparable"] = json_inseparable(result.inseparable);
    json["covariance"] = json_covariance(result.parameters, result.covariance);
    json["rms_before_um"] = result.rms_before_um;
    json["rms_after_um"] = result.rms_after_um;
    json["dof"] = result.dof;
    return json;
}

void print_table(const identification::Identification& result, bool monte_carlo) {
    const auto number = [](double v) {
        return std::isfinite(v) ? fmt::format("{:.2g}", v) : std::string("-");
    };
    print_out("{:<18} {:<22} {:>14} {:>12} {:>12} {}\n", "effect", "parameter", "value", "sigma",
              monte_carlo ? "Monte Carlo" : "", "unit");
    for (const identification::FitParameter& p : result.parameters)
        print_out("{:<18} {:<22} {:>14.7g} {:>12} {:>12} {}\n", p.effect, with_component(p),
                  p.value, number(p.sigma), monte_carlo ? number(p.sigma_monte_carlo) : "", p.unit);
    for (const identification::Inseparable& group : result.inseparable)
        print_out("no reading here sees: {}\n", to_string(group));
    print_out("rms {:.3f} um before, {:.3f} um after, {} degrees of freedom\n",
              result.rms_before_um, result.rms_after_um, result.dof);
}

/// What to type for the axes' places, where they were fitted and the control has a place for them.
void print_stores(const setup::Setup& identified, const identification::Identification& result) {
    const bool located =
        std::any_of(result.parameters.begin(), result.parameters.end(),
                    [](const identification::FitParameter& p) { return p.effect == "location"; });
    if (!located || identified.artefacts.empty()) return;
    const Vector3 tip_S_mm = identified.probe     ? identified.probe->tip_S_mm
                             : identified.ballbar ? identified.ballbar->cup_S_mm
                                                  : Vector3(0, 0, -150);
    const auto stores = setup::stores_to_type(identified, identified.machine,
                                              identified.artefacts.front().center_W_mm, tip_S_mm);
    if (stores) print_out("{}", report::stores_text(*stores, identified.dialect.family));
}

/// Shows how far it is; Ctrl-C leaves what the repetitions done so far say.
int repeat(const setup::Setup& setup, const records::ReadingTable& table,
           const std::vector<std::string>& effects, const Options& options,
           identification::Identification& result) {
    const Interruption interruption;
    Progress progress;
    return identification::add_monte_carlo(
        setup, table, effects, options.runs, options.seed, result, [&](int done) {
            progress.show([&] { return fmt::format("repetition {} of {}", done, options.runs); });
            return !Interruption::asked();
        });
}

int identify_command(const Options& options) {
    setup::Setup setup = load_setup_option(options.setup);
    setup.model.allow_large = options.allow_large;
    const records::ReadingTable table = load_readings(options.readings, setup);
    const std::vector<std::string> effects = split_names(options.effects);
    identification::Identification result = [&] {
        Progress progress;
        progress.stage(fmt::format("fit to {} rows", table.rows.size()));
        return identification::identify(setup, table, effects);
    }();
    print_notes(result.notes);
    const int repetitions = options.runs > 0 ? repeat(setup, table, effects, options, result) : 0;
    OutputFiles files;
    if (!options.out.empty()) files.add(options.out, setup::format_setup(result.setup));
    if (options.json) files.add("-", to_json(result).dump(1) + "\n");
    files.write();
    if (!options.json) {
        print_table(result, repetitions > 1);
        print_stores(result.setup, result);
    }
    if (repetitions == options.runs) return exit_done;
    print_error("trunnion: interrupted: {} of {} repetitions are done\n", repetitions,
                options.runs);
    return exit_limit;
}

}  // namespace

void add_identify(CLI::App& app, Run& run) {
    auto* command = app.add_subcommand("identify", "fits effects to readings");
    const auto options = std::make_shared<Options>();
    reads_file(command->add_option("readings", options->readings,
                                   "table of readings (CSV); several are joined in this order"))
        ->required();
    reads_file(command->add_option("--setup", options->setup, "setup file (TOML), needed"));
    command->add_option("--effects", options->effects,
                        "names, comma between; without it those of [model].modelled");
    writes_file(command->add_option("--out", options->out, "setup with the values entered"));
    command
        ->add_option("--monte-carlo", options->runs,
                     "also the uncertainty by so many simulated repetitions")
        ->check(CLI::Range(2, 100000));
    command->add_option("--seed", options->seed, "of the repetitions' noise (1)");
    command->add_flag("--allow-large", options->allow_large,
                      "residuals that no machine tool has are meant, no slip of units");
    command->add_flag("--json", options->json, "result as JSON on stdout");
    command->callback([options, &run] { run = [options] { return identify_command(*options); }; });
}

}  // namespace trunnion::cli
