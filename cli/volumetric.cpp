// trunnion volumetric: error of the tool point over the working volume, and its causes.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>

#include "base/alarm.h"
#include "base/console.h"
#include "base/output_files.h"
#include "cli/budget_options.h"
#include "cli/command.h"
#include "cli/long_work.h"
#include "cli/options.h"
#include "cli/page_options.h"
#include "cli/setups.h"
#include "effects/settings.h"
#include "report/volumetric_page.h"
#include "report/volumetric_pictures.h"
#include "report/volumetric_report.h"

namespace trunnion::cli {
namespace {

struct VolumetricCommandOptions {
    std::string setup, csv, svg;
    volumetric::VolumetricOptions map;
    bool json = false;
    double time_s = 0.0;
    PageOptions page;
    const CLI::App* command = nullptr;
};

/// A grid of five axes grows fast, and every pose is stored.
void check_size(const setup::Setup& setup, const volumetric::VolumetricOptions& options) {
    constexpr double most_poses = 3e6;
    double poses = 1.0;
    for (const kinematics::AxisGeometry& axis : setup.machine.chain.axes())
        poses *= axis.rotary ? options.rotary_grid : options.grid;
    if (poses > most_poses)
        throw InputError(fmt::format("--grid and --rotary-grid give {:.0f} poses, more than {:.0f}",
                                     poses, most_poses));
}

/// Shows progress; Ctrl-C and --max-seconds end the map with the completed poses.
volumetric::VolumetricMap watched_map(const setup::Setup& setup,
                                      const std::vector<std::string>& names,
                                      volumetric::VolumetricOptions options, BudgetMeter& meter) {
    Progress progress;
    options.go_on = [&](std::size_t done, std::size_t total) {
        progress.count(done, total, "poses");
        return meter.allows({});
    };
    return volumetric::volumetric_map(setup, names, effects::active_models(setup), options);
}

int run_command(const VolumetricCommandOptions& o) {
    if (o.map.grid < 2 || o.map.grid > 50) throw InputError("--grid must be 2 to 50");
    if (o.map.rotary_grid < 1 || o.map.rotary_grid > 72)
        throw InputError("--rotary-grid must be 1 to 72");
    const setup::Setup setup = open_setup(o.setup);
    check_size(setup, o.map);
    std::vector<std::string> names;
    for (const setup::EffectSetting& effect : setup.effects) names.push_back(effect.name);
    const Interruption interruption;
    BudgetMeter meter = fit_meter(o.time_s);
    const volumetric::VolumetricMap map = watched_map(setup, names, o.map, meter);
    const bool whole = meter.reached() == BudgetLimit::none;
    OutputFiles files;
    if (!o.csv.empty()) files.add(o.csv, report::volumetric_csv(map));
    if (!o.svg.empty() && whole) {
        files.add_folder(o.svg);
        for (auto& [name, text] : report::volumetric_pictures(map))
            files.add(o.svg + '/' + name, text);
    }
    if (!o.page.html.empty() && whole)
        files.add(o.page.html, finished_page(report::volumetric_page(map), *o.command, o.page));
    if (o.json)
        files.add("-", report::volumetric_json(map, ReadRecord::files()));
    else if (o.csv != "-")
        files.add("-", report::volumetric_text(map));
    files.write();
    if (whole) return exit_done;
    print_error("trunnion: {}: these are the first {} poses of the grid{}\n",
                reason_of(meter.reached()), map.points.size(),
                o.svg.empty() && o.page.html.empty() ? "" : ", without pictures");
    return exit_limit;
}

}  // namespace

void add_volumetric(CLI::App& app, Run& run) {
    const auto o = std::make_shared<VolumetricCommandOptions>();
    CLI::App* command =
        app.add_subcommand("volumetric",
                           "map the tool point errors over the working volume: each axis over its "
                           "limits (+-200 mm and +-180 deg without limits in the setup). Beyond "
                           "the end of an error table its last value holds");
    reads_file(command->add_option("--setup", o->setup, "setup file (machines/bc_table.toml)"));
    command->add_option("--grid", o->map.grid, "number of points along each linear axis (5)");
    command->add_option("--rotary-grid", o->map.rotary_grid,
                        "number of angles of each rotary axis (5; 1: zero only)");
    not_negative(command->add_option("--length", o->map.length_mm, "tool length, mm (150)"));
    writes_file(command->add_option("--csv", o->csv, "write every pose with its error (CSV)"));
    writes_folder(command->add_option(
        "--svg", o->svg, "folder for pictures: one for each height, and one of the axes"));
    command->add_flag("--json", o->json, "print the result as one JSON object");
    not_negative(command->add_option("--max-seconds", o->time_s,
                                     "stop after this time, s, with the poses so far (0: never)"));
    add_page_options(*command, o->page);
    o->command = command;
    command->callback([o, &run] { run = [o] { return run_command(*o); }; });
}

}  // namespace trunnion::cli
