// trunnion ballbar: the single-set-up ballbar test: run, identify, compensate, run again.
#include <CLI/CLI.hpp>
#include <filesystem>

#include "ballbar/test/ballbar_measured.h"
#include "base/output_files.h"
#include "cli/command.h"
#include "cli/long_work.h"
#include "cli/notes.h"
#include "cli/options.h"
#include "cli/page_options.h"
#include "cli/readings_command.h"
#include "cli/setups.h"
#include "effects/settings.h"
#include "report/ballbar_json.h"
#include "report/ballbar_page.h"
#include "report/ballbar_pictures.h"
#include "report/ballbar_report.h"

namespace trunnion::cli {

namespace {

struct BallbarOptions {
    std::vector<std::string> measured;
    std::string setup, svg_folder, csv, readings, readings_after, program, kinematic_program;
    std::vector<std::string> injections;
    std::vector<double> pivot_offset_mm;
    std::uint64_t seed = 1;
    ballbar::test::SetupTimes times;
    bool json = false, hurco = false, inside = false;
    PageOptions page;
    const CLI::App* command = nullptr;
};

/// --program and --kinematic-program only write programs; nothing is run.
int write_programs(const setup::Setup& setup, const BallbarOptions& o) {
    kinematics::Machine nominal = setup.machine;
    nominal.errors = {};
    ballbar::test::BallbarProgramData data = ballbar::test::stated_program_data(setup, o.inside);
    if (o.hurco && !setup::is_hurco(data.language)) data.language = setup::ProgramLanguage::isnc;
    OutputFiles files;
    if (!o.program.empty()) files.add(o.program, ballbar::test::ballbar_program(nominal, data));
    if (!o.kinematic_program.empty())
        files.add(o.kinematic_program, ballbar::test::kinematic_test_program(nominal, data));
    files.write();
    return exit_done;
}

/// Location errors among the effects: the true remaining errors in the table include them.
std::vector<ballbar::test::NamedError> injected_errors(const setup::Setup& setup) {
    const effects::Catalogue catalogue = effects::make_catalogue(setup);
    std::vector<ballbar::test::NamedError> errors;
    for (const setup::EffectSetting& setting : setup.effects) {
        const effects::Effect* effect = effects::find_effect(catalogue, setting.name);
        if (!effect) continue;
        const std::vector<double> values = effects::values_of(*effect, setting);
        for (std::size_t k = 0; k < values.size(); ++k)
            if (effect->parameters[k].location)
                errors.push_back({*effect->parameters[k].location, values[k]});
    }
    return errors;
}

ballbar::test::BallbarResult simulate(const BallbarOptions& o, const setup::Setup& setup) {
    ballbar::test::BallbarProcedureOptions options;
    options.seed = o.seed;
    options.effects = effects::active_models(setup);
    options.injected_errors = injected_errors(setup);
    options.times = o.times;
    options.inside = o.inside;
    if (!o.pivot_offset_mm.empty())
        options.pivot_offset_mm = {o.pivot_offset_mm[0], o.pivot_offset_mm[1],
                                   o.pivot_offset_mm[2]};
    Progress progress;
    options.watch = [&](int done, const char* what) {
        progress.step(done, ballbar::test::ballbar_steps, what);
    };
    return ballbar::test::run_ballbar(setup, options);
}

ballbar::test::BallbarResult evaluate(const BallbarOptions& o, const setup::Setup& setup) {
    const records::ReadingTable before = load_readings(o.measured[0], setup);
    std::optional<records::ReadingTable> after;
    if (o.measured.size() > 1) after = load_readings(o.measured[1], setup);
    return ballbar::test::evaluate_ballbar(setup, before, after);
}

/// Refuses options of the simulation together with real passes.
void refuse_simulation_options(const BallbarOptions& o) {
    if (o.measured.size() > 2)
        throw InputError("ballbar takes one table of readings, or one before and one after");
    if (o.setup.empty())
        throw InputError("readings need the machine that they come from: give --setup",
                         {o.measured[0]});
    if (!o.readings.empty() || !o.readings_after.empty() || !o.injections.empty() ||
        !o.pivot_offset_mm.empty() || !o.program.empty() || !o.kinematic_program.empty())
        throw InputError(
            "--write-readings, --inject, --pivot-offset and --program are for a simulated test, "
            "not for readings",
            {o.measured[0]});
}

std::string page_of(const BallbarOptions& o, const ballbar::test::BallbarResult& result) {
    report::Page page = report::ballbar_page(result);
    if (result.simulated) page.origin.seed = o.seed;
    return finished_page(std::move(page), *o.command, o.page);
}

int run_command(const BallbarOptions& o) {
    if (!o.measured.empty()) refuse_simulation_options(o);
    setup::Setup setup = open_setup(o.setup);
    const effects::Catalogue catalogue = effects::make_catalogue(setup);
    for (const std::string& text : o.injections)
        setup.effects.push_back(effects::parse_injection(text, catalogue));
    if (!o.program.empty() || !o.kinematic_program.empty()) return write_programs(setup, o);
    const ballbar::test::BallbarResult result =
        o.measured.empty() ? simulate(o, setup) : evaluate(o, setup);
    print_notes(result.notes);
    OutputFiles files;
    files.add("-", o.json ? report::ballbar_json(result, ReadRecord::files())
                          : report::ballbar_table(result));
    if (!o.page.html.empty()) files.add(o.page.html, page_of(o, result));
    if (!o.csv.empty()) files.add(o.csv, report::ballbar_csv(result));
    if (!o.readings.empty())
        files.add(o.readings, records::format_readings(result.before.readings));
    if (!o.readings_after.empty())
        files.add(o.readings_after, records::format_readings(result.after.readings));
    if (!o.svg_folder.empty()) {
        files.add_folder(o.svg_folder);
        for (const auto& [name, text] : report::ballbar_pictures(result))
            files.add((std::filesystem::path(o.svg_folder) / name).string(), text);
    }
    files.write();
    return exit_done;
}

}  // namespace

void add_ballbar(CLI::App& app, Run& run) {
    const auto o = std::make_shared<BallbarOptions>();
    CLI::App* command = app.add_subcommand("ballbar",
                                           "single-set-up ballbar test, simulated (run, identify, "
                                           "compensate, run again) or from real passes");
    reads_file(command->add_option("READINGS", o->measured,
                                   "table of real passes, or two tables: before and after"));
    reads_file(command->add_option("--setup", o->setup, "setup file (machines/bc_table.toml)"));
    command->add_option("--seed", o->seed,
                        "seed of the noise (1); the second run uses the next one");
    command->add_option("--inject", o->injections,
                        "add an effect to the machine, as in trunnion run");
    writes_folder(command->add_option("--svg", o->svg_folder, "folder for polar plots"));
    writes_file(command->add_option("--csv", o->csv, "write the table of errors (CSV)"));
    writes_file(command->add_option("--write-readings", o->readings,
                                    "write the readings of the simulated first run (CSV)"));
    writes_file(command->add_option("--write-readings-after", o->readings_after,
                                    "write the readings of the run after compensation (CSV)"));
    writes_file(command->add_option("--program", o->program,
                                    "only write the NC program of the test for this machine"));
    writes_file(
        command->add_option("--kinematic-program", o->kinematic_program,
                            "only write the NC program of BK1, BK2 and BK4 for this machine"));
    command->add_flag("--hurco", o->hurco, "use M128 and M129 in the written program");
    command->add_flag("--inside", o->inside,
                      "point the bar towards the second rotary axis where it lies flat");
    command
        ->add_option("--pivot-offset", o->pivot_offset_mm,
                     "true position of the pivot relative to the stated one: X,Y,Z in mm")
        ->delimiter(',')
        ->expected(3);
    not_negative(
        command->add_option("--setup-time", o->times.setup_s, "assumed time of one set-up, s"));
    not_negative(command->add_option("--remount-time", o->times.remount_s,
                                     "assumed time to move the bar between two tests, s"));
    command->add_flag("--json", o->json, "print the result as one JSON object");
    add_page_options(*command, o->page);
    o->command = command;
    command->callback([o, &run] { run = [o] { return run_command(*o); }; });
}

}  // namespace trunnion::cli
