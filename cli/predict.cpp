// trunnion predict: the same table with what the emulator reads, without noise.
#include <CLI/CLI.hpp>
#include <memory>

#include "base/numbers.h"
#include "base/output_files.h"
#include "base/random.h"
#include "cli/command.h"
#include "cli/options.h"
#include "cli/readings_command.h"
#include "effects/settings.h"
#include "emulator/replay.h"
#include "identification/base_model.h"
#include "report/parameters_json.h"

namespace trunnion::cli {
namespace {

struct Options {
    std::string readings, setup, jacobian, effects;
    std::vector<std::string> inject;
    bool noise = false;
    std::uint64_t seed = 1;
};

/// The readings as a device would take them: with one draw of its noise each.
void add_noise(const setup::Setup& setup, std::uint64_t seed, records::ReadingTable& table) {
    const emulator::Replay replay(setup, table);
    const identification::RowNoise noise = identification::row_noise(setup, table, replay);
    SeededNoise source(seed);
    for (std::size_t i = 0; i < replay.size(); ++i)
        *table.rows[replay.table_row(i)].value_mm +=
            noise.sigma_mm(static_cast<Eigen::Index>(i)) * source.normal();
    table.comment["source"] = "simulated";
    table.comment["seed"] = std::to_string(seed);
}

/// One row for each device row: its index, then d value / d parameter in mm (rad) for each unit.
std::string jacobian_text(const setup::Setup& setup, const records::ReadingTable& table,
                          const std::vector<std::string>& effects) {
    const emulator::Replay replay(setup, table);
    const kinematics::ForwardModel model(setup.machine);
    std::vector<kinematics::Perturbation> gradient;
    for (std::size_t i = 0; i < replay.size(); ++i)
        gradient.push_back(replay.gradient(i, model, {}));
    const identification::BaseColumns base = identification::base_columns(
        setup, replay, effects::make_catalogue(setup), effects, gradient);
    std::string out = "index";
    for (const identification::FitParameter& p : base.parameters)
        out += ',' + p.effect + '.' + report::with_component(p) + " [" + p.unit + ']';
    out += '\n';
    for (std::size_t i = 0; i < replay.size(); ++i) {
        out += std::to_string(table.rows[replay.table_row(i)].index);
        for (std::size_t j = 0; j < base.parameters.size(); ++j)
            out += ',' + shortest(base.columns(static_cast<Eigen::Index>(i),
                                               static_cast<Eigen::Index>(j)) /
                                  base.parameters[j].typical);
        out += '\n';
    }
    return out;
}

int predict(const Options& options) {
    const setup::Setup setup = load_setup_option(options.setup, options.inject);
    const records::ReadingTable table = load_readings(options.readings, setup);
    OutputFiles files;
    if (!options.jacobian.empty()) {
        const auto named = split_names(options.effects);
        files.add(options.jacobian,
                  jacobian_text(setup, table, named.empty() ? setup.model.modelled : named));
    }
    records::ReadingTable read = emulator::predicted(setup, table, effects::active_models(setup));
    if (options.noise) add_noise(setup, options.seed, read);
    files.add("-", records::format_readings(read));
    files.write();
    return exit_done;
}

}  // namespace

void add_predict(CLI::App& app, Run& run) {
    auto* command = app.add_subcommand("predict", "what the emulator reads at these positions");
    const auto options = std::make_shared<Options>();
    reads_file(command->add_option("readings", options->readings, "table of readings (CSV)"))
        ->required();
    reads_file(command->add_option("--setup", options->setup, "setup file (TOML), needed"));
    writes_file(command->add_option("--jacobian", options->jacobian,
                                    "also CSV: derivatives of each reading by each parameter"));
    command->add_option("--effects", options->effects,
                        "of --jacobian; without it those of [model].modelled");
    command->add_flag("--noise", options->noise,
                      "as a device would read: with the noise of the rows or of [model]");
    command->add_option("--seed", options->seed, "of the noise (1)");
    command->add_option("--inject", options->inject, "switch an effect on: 'C.backlash=60urad'");
    command->callback([options, &run] { run = [options] { return predict(*options); }; });
}

}  // namespace trunnion::cli
