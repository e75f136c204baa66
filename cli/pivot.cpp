// trunnion pivot: the mismatched-pivot demonstration.
#include <CLI/CLI.hpp>
#include <filesystem>

#include "base/console.h"
#include "base/output_files.h"
#include "cli/command.h"
#include "cli/files.h"
#include "cli/options.h"
#include "cli/setups.h"
#include "report/pivot_report.h"

namespace trunnion {

namespace {

struct PivotOptions {
    std::string setup, svg_folder;
    unsigned long long seed = 1;
    bool json = false;
};

int run_pivot(const PivotOptions& o) {
    const Setup setup = open_setup(o.setup);
    const std::string programs = shipped("programs");
    const PivotDemonstration demo =
        demonstrate_pivot(setup, {programs, programs + "/pivot"}, o.seed);
    OutputFiles files;
    files.add("-", o.json ? pivot_json(demo) : pivot_table(demo));
    if (!o.svg_folder.empty()) {
        make_folder(o.svg_folder);
        for (const auto& [name, text] : pivot_pictures(demo))
            files.add((std::filesystem::path(o.svg_folder) / name).string(), text);
    }
    files.write();
    if (!o.svg_folder.empty())
        print_error("pictures: {0}/distances.svg {0}/circles.svg\n", o.svg_folder);
    return exit_done;
}

}  // namespace

void add_pivot(CLI::App& app, Run& run) {
    const auto o = std::make_shared<PivotOptions>();
    CLI::App* command = app.add_subcommand(
        "pivot",
        "what mismatched pivot parameters do: four positioning functions, four error maps");
    reads_file(
        command->add_option("--setup", o->setup, "setup file (default machines/bc_table.toml)"));
    command->add_option("--seed", o->seed, "of the probe's repeatability");
    writes_file(command->add_option("--svg", o->svg_folder, "folder for the pictures"));
    command->add_flag("--json", o->json, "one JSON object on stdout");
    command->callback([o, &run] { run = [o] { return run_pivot(*o); }; });
}

}  // namespace trunnion
