// trunnion compensate: compensation of a program for the known errors of the machine.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "base/alarm.h"
#include "base/console.h"
#include "base/output_files.h"
#include "base/rounded.h"
#include "base/units.h"
#include "cli/budget_options.h"
#include "cli/command.h"
#include "cli/long_work.h"
#include "cli/notes.h"
#include "cli/options.h"
#include "cli/page_options.h"
#include "cli/setups.h"
#include "compensation/compensation.h"
#include "effects/settings.h"
#include "inputs/program_choice.h"
#include "report/compensation_json.h"
#include "report/compensation_page.h"

namespace trunnion::cli {
namespace {

struct CompensateOptions {
    std::string program, setup, out = "-";
    std::vector<std::string> folders;
    double tolerance_um = 0.05, largest_turn_deg = 0.1;
    int decimals = 6;
    BudgetOptions limits;
    bool json = false;
    PageOptions page;
    const CLI::App* command = nullptr;
};

void print_direction(const char* where, double before_rad, double after_rad) {
    if (before_rad <= 0.0 && after_rad <= 0.0) return;
    print_error("tool direction {}: {} µrad before, {} µrad after\n", where,
                three_digits(urad_from_rad(before_rad), 3),
                three_digits(urad_from_rad(after_rad), 3));
}

int run_command(const CompensateOptions& o) {
    if (o.json && o.out == "-") throw InputError("--json needs --out FILE for the program");
    if (o.tolerance_um <= 0.0) throw InputError("--tol-um must be above 0");
    if (o.largest_turn_deg < 0.0) throw InputError("--max-turn-deg must be 0 or more");
    if (o.decimals < 1 || o.decimals > 9) throw InputError("--decimals must be 1 to 9");
    const setup::Setup setup = open_setup(o.setup);
    inputs::ProgramAndFolders program = inputs::open_program(o.program, o.folders);
    const Interruption interruption;
    const compensation::CompensatedProgram c = compensation::compensate_program(
        setup, program.folders, program.program, effects::active_models(setup),
        {mm_from_um(o.tolerance_um), o.decimals, rad_from_deg(o.largest_turn_deg),
         budget_of(o.limits)});
    print_notes(c.notes);
    if (c.original.alarm) throw Alarm(*c.original.alarm);
    if (c.executed.alarm) throw Alarm(*c.executed.alarm);
    if (c.limit != BudgetLimit::none) return report_limit(c.limit, c.original.blocks);
    OutputFiles files;
    files.add(o.out, c.program);
    if (!o.page.html.empty())
        files.add(o.page.html, finished_page(report::compensation_page(c, setup.name, o.program),
                                             *o.command, o.page));
    if (o.json) files.add("-", report::compensation_json(c, ReadRecord::files()));
    files.write();
    print_error("{} blocks; largest tip error at the end of a block {} before, {} after\n",
                c.blocks.size(), length_words(um_from_mm(c.before.tip_mm)),
                length_words(um_from_mm(c.after.tip_mm)));
    if (c.in_gap.tip_mm > 0.0)
        print_error(
            "after a reversal, until the axis has crossed its gap: tip {}, direction {} µrad\n",
            length_words(um_from_mm(c.in_gap.tip_mm)),
            three_digits(urad_from_rad(c.in_gap.turned_rad), 3));
    print_direction("where rotary axes correct it", c.before.turned_rad, c.after.turned_rad);
    print_direction("where rotary words are unchanged", c.before.kept_rad, c.after.kept_rad);
    return exit_done;
}

}  // namespace

void add_compensate(CLI::App& app, Run& run) {
    const auto o = std::make_shared<CompensateOptions>();
    CLI::App* command = app.add_subcommand(
        "compensate", "write a program that compensates the known errors of the machine");
    reads_file(command->add_option("PROGRAM", o->program, "program file or O number"))->required();
    reads_file(command->add_option("--setup", o->setup,
                                   "setup file that contains the errors (machines/bc_table.toml)"));
    writes_file(command->add_option("--out", o->out, "output program (stdout)"));
    reads_file(
        command->add_option("--programs", o->folders, "folder of further programs, repeatable"))
        ->allow_extra_args(false);
    command->add_option("--tol-um", o->tolerance_um,
                        "path tolerance between exact points, um (0.05)");
    command->add_option("--max-turn-deg", o->largest_turn_deg,
                        "maximum correction of a rotary axis for the tool direction, deg (0.1; 0: "
                        "rotary words stay)");
    command->add_option("--decimals", o->decimals, "decimals of the written words (6)");
    add_budget(*command, o->limits);
    command->add_flag("--json", o->json, "print the result as one JSON object");
    add_page_options(*command, o->page);
    o->command = command;
    command->callback([o, &run] { run = [o] { return run_command(*o); }; });
}

}  // namespace trunnion::cli
