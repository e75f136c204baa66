// trunnion pivot: the stale pivot store and the values to enter; simulated or from readings.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>

#include "backup/control_files.h"
#include "base/console.h"
#include "base/output_files.h"
#include "base/read_file.h"
#include "base/rounded.h"
#include "base/utf8_text.h"
#include "cli/command.h"
#include "cli/notes.h"
#include "cli/options.h"
#include "cli/page_options.h"
#include "cli/readings_command.h"
#include "cli/setups.h"
#include "inputs/shipped.h"
#include "pivot/mixed_functions.h"
#include "pivot/pivot_program.h"
#include "pivot/pivot_readings.h"
#include "pivot/pivot_run.h"
#include "report/pivot_page.h"
#include "report/pivot_pictures.h"
#include "setup/control_machine.h"
#include "setup/program_language.h"

namespace trunnion::cli {

namespace {

namespace fs = std::filesystem;

struct PivotOptions {
    std::vector<std::string> readings;
    std::string setup, control, svg_folder, programs_folder, print, shop_programs;
    PageOptions page;
    const CLI::App* command = nullptr;
    unsigned long long seed = 1;
    double limit_um = 3.0;
    bool json = false, stores_alone = false;
};

/// A setup, a setup with a backup applied, or a machine from a backup alone.
setup::Setup setup_of(const PivotOptions& o) {
    if (!o.setup.empty() || o.control.empty()) {
        setup::Setup setup = open_setup(o.setup);
        if (!o.control.empty()) backup::apply_backup(backup::read_backup(o.control), setup.stores);
        return setup;
    }
    offsets::Stores stores;
    backup::apply_backup(backup::read_backup(o.control), stores);
    if (!setup::has_rotary_geometry(stores))
        throw InputError(
            "these files do not describe two real rotary axes (19680-19690); give --setup",
            {o.control});
    return setup::setup_of_control(stores, o.control);
}

bool is_table(const std::string& text) {
    return text.starts_with("#") || text.starts_with("index,") || text.starts_with("index\t") ||
           text.starts_with("index;");
}

/// Converts prints and tables of readings into error maps.
pivot::PivotPrints read_maps(const PivotOptions& o, const setup::Setup& setup,
                             const setup::RotaryStores& stores) {
    const Axis first = stores.pivot.first.axis, second = stores.pivot.second.axis;
    std::vector<pivot::PrintedFile> printed;
    std::vector<records::ReadingTable> tables;
    for (const std::string& path : o.readings) {
        std::string text = utf8_of(read_file_or_input(path), path);
        if (is_table(text))
            tables.push_back(parse_readings(text, path, setup));
        else
            printed.push_back({path, std::move(text)});
    }
    if (tables.empty()) return pivot::parse_pivot_prints(printed, first, second);
    if (!printed.empty())
        throw InputError("printed output and tables of readings cannot be combined",
                         {printed[0].path});
    const auto sphere = std::find_if(
        setup.artefacts.begin(), setup.artefacts.end(),
        [](const setup::Artefact& a) { return a.kind == setup::Artefact::Kind::sphere; });
    if (sphere == setup.artefacts.end() || !setup.probe)
        throw InputError("these readings require [probe] and a sphere in the setup");
    return pivot::pivot_readings(records::join_readings(std::move(tables)), first, second,
                                 0.5 * (sphere->diameter_mm + setup.probe->ball_diameter_mm),
                                 setup.probe->tip_S_mm);
}

kinematics::Machine without_rotary_errors(kinematics::Machine machine) {
    for (const kinematics::AxisGeometry& axis : machine.chain.axes())
        if (axis.rotary) machine.errors.axis[index_of(axis.axis)].location = {};
    return machine;
}

Vector3 stylus_of(const setup::Setup& setup) {
    return setup.probe ? setup.probe->tip_S_mm : Vector3(0, 0, -150);
}

/// Program files below a folder, each with the functions that it uses.
std::vector<std::pair<std::string, std::vector<std::string>>> shop_programs(
    const std::string& folder, Axis first, Axis second) {
    std::vector<std::pair<std::string, std::vector<std::string>>> found;
    if (folder.empty()) return found;
    if (!fs::is_directory(folder))
        throw InputError(fs::exists(folder) ? "is a file, not a folder" : "no such folder",
                         {folder});
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (!entry.is_regular_file() || entry.file_size() > 100'000'000) continue;
        const std::string path = entry.path().string();
        auto used = pivot::functions_used(read_file(path), first, second);
        if (!used.empty()) found.emplace_back(path, std::move(used));
    }
    std::sort(found.begin(), found.end());
    return found;
}

bool is_hurco(const setup::Setup& setup) {
    return setup::is_hurco(setup::language_of(setup));
}

report::PivotResult result_of(const PivotOptions& o, const setup::Setup& setup,
                              pivot::PivotVerdict verdict, std::vector<pivot::PivotMap> maps) {
    report::PivotResult result;
    result.machine = setup.name;
    result.first = verdict.in_force.pivot.first.axis;
    result.second = verdict.in_force.pivot.second.axis;
    result.hurco = is_hurco(setup);
    std::vector<pivot::PivotFunction> functions;
    for (const pivot::PivotFunction& f : pivot::pivot_functions())
        for (const pivot::PivotMap& map : maps)
            if (std::any_of(map.arcs.begin(), map.arcs.end(),
                            [&](const pivot::PivotArc& arc) { return arc.function == f.name; })) {
                functions.push_back(f);
                break;
            }
    result.affected = pivot::affected_parts(
        verdict, functions, shop_programs(o.shop_programs, result.first, result.second));
    result.maps = std::move(maps);
    result.verdict = std::move(verdict);
    return result;
}

void refuse_mixed_functions(const PivotOptions& o, const pivot::PivotEvidence& evidence,
                            const std::vector<pivot::PivotMap>& maps, const pivot::PivotFit& fit) {
    const auto mixed = pivot::mixed_functions(evidence, maps, fit);
    if (mixed.empty()) return;
    throw InputError(fmt::format("functions are mixed up: no machine fits these readings (residual "
                                 "{}), but one does if {} used the other store",
                                 length_words(fit.noise_um), fmt::join(mixed, " and ")),
                     {o.readings.front()});
}

report::PivotResult judge_readings(const PivotOptions& o, const setup::Setup& setup) {
    const auto declared = setup::rotary_stores(setup.machine.chain, setup.stores);
    if (!declared) throw InputError("the control does not describe two rotary axes (19680-19690)");
    pivot::PivotPrints prints = read_maps(o, setup, *declared);
    std::vector<std::string> notes;
    pivot::PivotEvidence evidence;
    evidence.in_force = pivot::stores_in_force(prints, *declared, notes);
    pivot::compare_lengths(prints, setup.stores.tools, notes);
    print_notes(notes);
    evidence.known = without_rotary_errors(setup.machine);
    evidence.sphere_mm = prints.sphere_mm();
    evidence.tip_S_mm = stylus_of(setup);
    evidence.increment_mm = setup::least_increment_mm(setup.stores.parameters);
    evidence.limit_um = o.limit_um;
    evidence.hurco = is_hurco(setup);
    pivot::PivotVerdict verdict = pivot::judge_pivot(evidence, prints.maps);
    refuse_mixed_functions(o, evidence, prints.maps, verdict.fit);
    pivot::add_expected(
        {verdict.fit.machine, evidence.in_force, evidence.sphere_mm, evidence.tip_S_mm},
        evidence.in_force.pivot, prints.maps);
    report::PivotResult result = result_of(o, setup, std::move(verdict), std::move(prints.maps));
    result.date = prints.date;
    result.source =
        "measured: " + o.readings.front() +
        (o.readings.size() > 1 ? fmt::format(" and {} more", o.readings.size() - 1) : "");
    return result;
}

/// No program runs: the maps are computed for the setup's machine, measured or identified.
report::PivotResult from_known_machine(const PivotOptions& o, const setup::Setup& setup) {
    const pivot::PivotPlan plan = pivot::plan_pivot_test(setup);
    std::vector<pivot::PivotMap> maps =
        pivot::modelled_maps(plan, setup.machine, setup.probe->tip_S_mm);
    pivot::PivotEvidence evidence;
    evidence.in_force = plan.stores;
    evidence.known = without_rotary_errors(setup.machine);
    evidence.sphere_mm = plan.sphere_mm;
    evidence.tip_S_mm = setup.probe->tip_S_mm;
    evidence.increment_mm = setup::least_increment_mm(setup.stores.parameters);
    evidence.limit_um = o.limit_um;
    evidence.hurco = is_hurco(setup);
    pivot::PivotVerdict verdict = pivot::judge_pivot(evidence, maps);
    pivot::add_expected({setup.machine, plan.stores, plan.sphere_mm, evidence.tip_S_mm},
                        plan.stores.pivot, maps);
    report::PivotResult result = result_of(o, setup, std::move(verdict), std::move(maps));
    result.source = "worked out from the machine in the setup";
    return result;
}

report::PivotResult simulate(const PivotOptions& o, const setup::Setup& setup, OutputFiles& files) {
    pivot::PivotDemonstration demo =
        pivot::demonstrate_pivot(setup, pivot::pivot_programs(pivot::plan_pivot_test(setup)),
                                 {inputs::shipped("programs")}, o.seed);
    if (!o.print.empty()) files.add(o.print, demo.printed);
    report::PivotResult result = result_of(o, setup, std::move(demo.verdict), std::move(demo.maps));
    result.true_right = demo.true_right;
    result.source = "simulated";
    return result;
}

int write_programs(const PivotOptions& o, const setup::Setup& setup) {
    OutputFiles files;
    files.add_folder(o.programs_folder);
    for (const auto& [name, text] : pivot::pivot_programs(pivot::plan_pivot_test(setup)))
        files.add((fs::path(o.programs_folder) / name).string(), text);
    files.add((fs::path(o.programs_folder) / "sphere9.nc").string(),
              read_file(inputs::shipped("programs") + "/sphere9.nc"));
    files.write();
    return exit_done;
}

std::string page_of(const PivotOptions& o, const report::PivotResult& result) {
    report::Page page = report::pivot_page(result);
    if (o.readings.empty() && !o.stores_alone) page.origin.seed = o.seed;
    return finished_page(std::move(page), *o.command, o.page);
}

int run_pivot(const PivotOptions& o) {
    if (!o.readings.empty() && o.setup.empty() && o.control.empty())
        throw InputError(
            "readings need the machine that they come from: give --setup or --control");
    const setup::Setup setup = setup_of(o);
    if (!o.programs_folder.empty()) return write_programs(o, setup);
    OutputFiles files;
    const report::PivotResult result = !o.readings.empty() ? judge_readings(o, setup)
                                       : o.stores_alone    ? from_known_machine(o, setup)
                                                           : simulate(o, setup, files);
    files.add("-", o.json ? report::pivot_json(result, ReadRecord::files())
                          : report::pivot_table(result));
    if (!o.page.html.empty()) files.add(o.page.html, page_of(o, result));
    if (!o.svg_folder.empty()) {
        files.add_folder(o.svg_folder);
        for (const auto& [name, text] : report::pivot_pictures(result))
            files.add((fs::path(o.svg_folder) / name).string(), text);
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
        "pivot", "find the stale pivot store and the values to enter, simulated or from readings");
    reads_file(command->add_option(
        "READINGS", o->readings,
        "output of the test programs, or tables of readings (default: simulate the test)"));
    reads_file(command->add_option("--setup", o->setup, "setup file (machines/bc_table.toml)"));
    reads_file(command->add_option("--control", o->control,
                                   "backup folder of a real control, which gives the stores"));
    reads_file(command->add_option("--programs", o->shop_programs,
                                   "folder of your programs: list those affected"));
    writes_folder(command->add_option("--write-programs", o->programs_folder,
                                      "only write the NC programs of the test for this machine"));
    writes_file(command->add_option("--print", o->print, "file for the output of the programs"));
    command->add_option("--seed", o->seed, "seed of the noise of the probe (1)");
    not_negative(command->add_option(
        "--limit-um", o->limit_um,
        "largest error that a store may cause without being called stale, um (3)"));
    writes_folder(command->add_option("--svg", o->svg_folder, "folder for pictures"));
    command->add_flag("--stores", o->stores_alone,
                      "do not run the test: compare the stores with the machine of the setup");
    command->add_flag("--json", o->json, "print the result as one JSON object");
    add_page_options(*command, o->page);
    o->command = command;
    command->callback([o, &run] { run = [o] { return run_pivot(*o); }; });
}

}  // namespace trunnion::cli
