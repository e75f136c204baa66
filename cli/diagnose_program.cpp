#include "cli/diagnose_program.h"

#include "base/alarm.h"
#include "base/console.h"
#include "base/output_files.h"
#include "base/read_file.h"
#include "choices/control_gap.h"
#include "cli/budget_options.h"
#include "cli/command.h"
#include "cli/long_work.h"
#include "cli/notes.h"
#include "cli/setups.h"
#include "imports/position_log.h"
#include "inputs/program_choice.h"
#include "interpreter/program_likeness.h"
#include "report/control_gap_page.h"
#include "report/control_gap_report.h"

namespace trunnion::cli {

namespace {

choices::ControlGap found_gap(const ProgramDiagnosis& options, const setup::Setup& setup) {
    const records::PositionLog log =
        imports::read_position_log(read_file_or_input(options.log), options.log, setup);
    const interpreter::ProgramText program = interpreter::read_main_program(options.program);
    interpreter::refuse_other_files(program);
    interpreter::ProgramFolders folders = inputs::folders_of_file(program, options.folders);
    Progress progress;
    const choices::GapQuestion question{setup, log, program, options.max_blocks,
                                        [&](const char* stage) { progress.stage(stage); }};
    choices::ControlGap gap =
        choices::control_gap(question, folders, [&folders] { return folders.used(); });
    print_notes(folders.announcements());
    print_notes(gap.notes);
    return gap;
}

/// A search that is not finished has no rivals to weigh and names no cause.
int report_ended(bool by_blocks) {
    if (by_blocks)
        print_error(
            "trunnion: {}: the program does not end within it: nothing is judged and "
            "written\n",
            reason_of(BudgetLimit::blocks));
    else
        print_error(
            "trunnion: {}: the search was not finished: nothing is judged and written\n",
            reason_of(Interruption::asked() ? BudgetLimit::interruption : BudgetLimit::time));
    return exit_limit;
}

int write_gap(const ProgramDiagnosis& options, const choices::ControlGap& gap) {
    OutputFiles files;
    if (!options.out.empty()) files.add(options.out, setup::format_setup(gap.setup));
    if (!options.page.html.empty())
        files.add(options.page.html,
                  finished_page(report::control_gap_page(gap, options.log, options.program),
                                *options.command, options.page));
    files.add("-", options.json ? report::control_gap_json(gap, ReadRecord::files())
                                : report::control_gap_text(gap));
    files.write();
    return options.limit_um >= 0.0 && gap.excess_um > options.limit_um ? exit_differs : exit_done;
}

}  // namespace

int diagnose_program(const ProgramDiagnosis& options) {
    if (options.setup.empty())
        throw InputError(
            "--setup is missing: a log must be evaluated with the control that wrote it");
    const setup::Setup setup = open_setup(options.setup);
    const Interruption interruption;
    try {
        return write_gap(options, found_gap(options, setup));
    } catch (const choices::PathEnded& ended) {
        return report_ended(ended.by_blocks);
    }
}

}  // namespace trunnion::cli
