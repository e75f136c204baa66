// trunnion predict: the same table with what the emulator reads, without noise.
#include <CLI/CLI.hpp>
#include <memory>

#include "base/output_files.h"
#include "cli/command.h"
#include "cli/options.h"
#include "cli/readings_command.h"
#include "effects/settings.h"
#include "emulator/replay.h"

namespace trunnion {
namespace {

struct Options {
    std::string readings, setup;
    std::vector<std::string> inject;
};

int predict(const Options& options) {
    const Setup setup = load_setup_option(options.setup, options.inject);
    const ReadingTable table = load_readings(options.readings);
    OutputFiles files;
    files.add("-", format_readings(predicted(setup, table, active_models(setup))));
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
    command->add_option("--inject", options->inject, "switch an effect on: 'C.backlash=60urad'");
    command->callback([options, &run] { run = [options] { return predict(*options); }; });
}

}  // namespace trunnion
