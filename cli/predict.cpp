// trunnion predict: the same table with the noise-free predictions of the emulator.
#include <CLI/CLI.hpp>
#include <memory>

#include "base/numbers.h"
#include "base/output_files.h"
#include "base/read_file.h"
#include "cli/command.h"
#include "cli/notes.h"
#include "cli/options.h"
#include "cli/readings_command.h"
#include "effects/settings.h"
#include "emulator/declared.h"
#include "emulator/replay.h"
#include "identification/sensitivity.h"
#include "identification/simulated.h"
#include "identification/unknown_sides.h"
#include "records/with_values.h"
#include "report/parameters_json.h"
#include "report/readings_json.h"

namespace trunnion::cli {
namespace {

struct PredictOptions {
    std::string readings, setup, jacobian, effects;
    std::vector<std::string> inject;
    bool noise = false, json = false;
    std::uint64_t seed = 1;
};

/// One row for each device row: its index, then d value / d parameter in mm (rad) per unit of the
/// parameter.
std::string jacobian_text(const identification::Sensitivity& found) {
    std::string out = "index";
    for (const identification::FitParameter& p : found.parameters)
        out += ',' + p.effect + '.' + report::with_component(p) + " [" + p.unit + ']';
    out += '\n';
    for (Eigen::Index i = 0; i < found.jacobian.rows(); ++i) {
        out += std::to_string(found.index[static_cast<std::size_t>(i)]);
        for (const double derivative : found.jacobian.row(i)) out += ',' + shortest(derivative);
        out += '\n';
    }
    return out;
}

/// Computes the derivatives only when they are requested.
std::optional<identification::Sensitivity> derivatives(const PredictOptions& options,
                                                       const setup::Setup& setup,
                                                       const records::ReadingTable& table) {
    if (options.jacobian.empty() && !(options.json && !options.effects.empty())) return {};
    return identification::sensitivity(setup, table, split_names(options.effects));
}

int predict(const PredictOptions& options) {
    const setup::Setup setup = load_setup_option(options.setup, options.inject);
    const std::string text = read_file_or_input(options.readings);
    const records::ReadingTable table = parse_readings(text, options.readings, setup);
    if (const std::string list = emulator::declared_otherwise(setup, table); !list.empty())
        print_notes({options.readings +
                     ": these points were imported with another declared "
                     "geometry (" +
                     list + "); predicted is what this setup reads at their positions"});
    if (const std::string axes = identification::sides_taken_as_plus(setup, table); !axes.empty())
        print_notes({options.readings + ": no row tells from which side " + axes +
                     " came before the first motion: taken as + (head line `# side = ..`)"});
    const auto found = derivatives(options, setup, table);
    const records::ReadingTable read =
        options.noise ? identification::simulated(setup, table, options.seed)
                      : emulator::predicted(setup, table, effects::active_models(setup));
    OutputFiles files;
    if (!options.jacobian.empty()) files.add(options.jacobian, jacobian_text(*found));
    files.add("-", options.json    ? report::prediction_json(read, found, ReadRecord::files())
                   : options.noise ? records::format_readings(read)
                                   : records::with_values(text, read));
    files.write();
    return exit_done;
}

}  // namespace

void add_predict(CLI::App& app, Run& run) {
    auto* command = app.add_subcommand("predict", "simulate the readings at given positions");
    const auto options = std::make_shared<PredictOptions>();
    reads_file(command->add_option("readings", options->readings, "table of readings (CSV)"))
        ->required();
    reads_file(command->add_option("--setup", options->setup, "setup file (required)"));
    writes_file(command->add_option(
        "--jacobian", options->jacobian,
        "write the derivative of each reading with respect to each parameter (CSV)"));
    command->add_option("--effects", options->effects,
                        "effects of --jacobian, separated by commas (default: [model].modelled)");
    command->add_flag("--noise", options->noise,
                      "add noise with the sigma of each row or of [model]");
    command->add_option("--seed", options->seed, "seed of the noise (1)");
    command->add_option("--inject", options->inject, "switch an effect on: 'C.backlash=60urad'");
    command->add_flag(
        "--json", options->json,
        "print the result as one JSON object, with --effects including the derivatives");
    command->callback([options, &run] { run = [options] { return predict(*options); }; });
}

}  // namespace trunnion::cli
