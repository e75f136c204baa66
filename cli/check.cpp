// trunnion check: static findings on programs, and with --run the alarm that stops them.
#include "check/check.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <memory>

#include "base/alarm.h"
#include "base/console.h"
#include "base/output_files.h"
#include "cli/against.h"
#include "cli/budget_options.h"
#include "cli/command.h"
#include "cli/long_work.h"
#include "cli/notes.h"
#include "cli/options.h"
#include "cli/page_options.h"
#include "cli/setup_rules.h"
#include "cli/setups.h"
#include "controller/alarms.h"
#include "controller/controller.h"
#include "emulator/run.h"
#include "inputs/backup_part.h"
#include "inputs/program_choice.h"
#include "inputs/shipped.h"
#include "interpreter/program_folders.h"
#include "regression/suite.h"
#include "report/findings_page.h"
#include "report/findings_report.h"

namespace trunnion::cli {

namespace {

struct CheckCommand {
    std::vector<std::string> paths, folders;
    std::string setup, against, format = "text", out = "-";
    bool run = false;
    RunLimits limits;
    double time_s = 0.0;
    PageOptions page;
    const CLI::App* command = nullptr;
};

std::vector<std::string> files_of(const std::vector<std::string>& paths) {
    std::vector<std::string> files;
    for (const std::string& path : paths) {
        if (!std::filesystem::is_directory(path)) {
            files.push_back(path);
            continue;
        }
        const auto names = regression::programs_below(path);
        if (names.empty()) throw InputError("no NC program in this folder", {path, 0, 0});
        for (const std::string& name : names)
            files.push_back((std::filesystem::path(path) / name).generic_string());
    }
    return files;
}

constexpr std::uint64_t trial_blocks = 1'000'000;  ///< limit of a run without --run

class NoDevices : public motion::MotionSink {
  public:
    motion::MoveResult move(const motion::AxisMove&) override { return {}; }
};

controller::RunResult run_without_devices(const setup::Setup& setup,
                                          const interpreter::ProgramText& program,
                                          interpreter::ProgramFolders& programs,
                                          const CheckCommand& c) {
    offsets::Stores stores = setup.stores;
    NoDevices sink;
    controller::ControlConfig config = emulator::control_config(setup);
    config.max_blocks = c.run ? c.limits.max_blocks : std::min(c.limits.max_blocks, trial_blocks);
    config.go_on = c.limits.go_on;
    controller::Controller controller(std::move(config), stores, programs, sink,
                                      [](std::string_view) {});
    return controller.run(program);
}

/// The alarm that ends a run, as a finding.
void add_end(const controller::RunResult& result, const interpreter::ProgramText& program,
             const CheckCommand& c, std::vector<check::Finding>& findings) {
    if (result.status == controller::RunStatus::limit && c.limits.go_on(0))
        findings.push_back({"alarm", check::Severity::error, program.name, 1, 1,
                            fmt::format("does not end within {} blocks", c.limits.max_blocks),
                            "Look for an endless loop, or give --max-blocks."});
    if (!result.alarm) return;
    const Alarm& alarm = *result.alarm;
    for (const check::Finding& known : findings)  // one finding for each cause
        if (known.path == program.name && known.line == alarm.where.line &&
            known.severity == check::Severity::error)
            return;
    const controller::AlarmRow* row = controller::find_alarm(alarm.number);
    findings.push_back(
        {"alarm", check::Severity::error,
         alarm.where.program.empty() ? program.name : alarm.where.program, alarm.where.line,
         std::max(1, alarm.where.column),
         fmt::format("running it: {}", controller::alarm_title(alarm.number, alarm.text)),
         row != nullptr ? row->remedy : ""});
}

/// True when one of the programs starts tool centre point control.
bool names_tool_centre(const std::vector<interpreter::ProgramText>& programs) {
    return std::any_of(programs.begin(), programs.end(), [](const interpreter::ProgramText& p) {
        return p.text.find("43.4") != p.text.npos || p.text.find("43.5") != p.text.npos;
    });
}

/// What shows only in a run: where the table stands at G43.4; with --run the alarm that ends it.
void check_by_run(const CheckCommand& c, const setup::Setup& setup,
                  const interpreter::ProgramText& program, interpreter::ProgramFolders& programs,
                  std::vector<check::Finding>& findings) {
    if (!c.run && !names_tool_centre(programs.used())) return;
    const controller::RunResult result = run_without_devices(setup, program, programs, c);
    for (const controller::TurnedStart& start : result.turned_starts)
        findings.push_back({"tcp-frame", check::Severity::warning, start.program, start.line, 1,
                            start.text,
                            "Set [control] tcp_frame to what the machine does: \"start\" or "
                            "\"rotary_zero\"."});
    if (c.run) add_end(result, program, c, findings);
}

/// A machine on which programs are checked, with the data common to all of them.
struct CheckedMachine {
    setup::Setup setup;
    SetupRules rules{setup};
    std::optional<setup::Setup> other;  ///< of --against

    CheckedMachine(setup::Setup setup_, const std::string& against) : setup(std::move(setup_)) {
        if (!against.empty()) other = other_reading(setup, against);
    }

    /// What shows without running it.
    std::vector<check::Finding> read(const interpreter::ProgramText& program,
                                     interpreter::ProgramFolders& programs) {
        check::CheckOptions options = rules.options();
        options.finds_program = [&](int number) { return programs.find(number).has_value(); };
        options.finds_named = [&](const std::string& name) {
            return programs.find(std::string_view(name)).has_value();
        };
        return check::check_program(program, options);
    }
};

bool names_strange_axis(const std::vector<check::Finding>& findings) {
    return std::any_of(findings.begin(), findings.end(), [](const check::Finding& f) {
        return f.rule == "alarm" && f.text.find("PS0009") != std::string::npos;
    });
}

/// M128 is a Hurco's tool centre point control.
bool names_m128(const std::vector<check::Finding>& findings) {
    return std::any_of(findings.begin(), findings.end(), [](const check::Finding& f) {
        return f.rule == "unknown-m" && f.text.starts_with("M128 ");
    });
}

/// "(.. SETUP NAME)" in a program's head: the shipped machine of that name, else empty.
std::string machine_named_in(std::string_view text) {
    constexpr std::string_view key = "SETUP ";
    const std::string_view head = text.substr(0, 400);
    const std::size_t at = head.find(key);
    std::string name;
    for (std::size_t i = at + key.size(); at != head.npos && i < head.size(); ++i) {
        const auto c = static_cast<unsigned char>(head[i]);
        if (!std::isalnum(c) && c != '_') break;
        name += static_cast<char>(std::tolower(c));
    }
    const std::string path = inputs::shipped("machines") + "/" + name + ".toml";
    return std::filesystem::exists(path) ? path : "";
}

/// The machine of --setup; without it that which the program names, else the B-C table, and the A-C
/// table for a program that commands A; with the language of a Hurco for a program with M128.
class CheckedMachines {
  public:
    explicit CheckedMachines(const CheckCommand& c) : c_(c) {
        first();
        if (concerns_hurco())
            print_notes({"--against " + c.against + ": the programs are read as a Hurco's"});
    }

    CheckedMachine& for_program(const interpreter::ProgramText& program,
                                interpreter::ProgramFolders& programs,
                                std::vector<check::Finding>& found) {
        const bool hurco = concerns_hurco();
        std::string path = c_.setup.empty() ? machine_named_in(program.text) : c_.setup;
        CheckedMachine* use = &machine(path, hurco);
        found = use->read(program, programs);
        if (!c_.setup.empty()) return *use;
        const auto try_on = [&](const std::string& other, bool as_hurco, auto is_better) {
            CheckedMachine& candidate = machine(other, as_hurco);
            auto again = candidate.read(program, programs);
            if (!is_better(again)) return false;
            found = std::move(again);
            use = &candidate;
            path = other;
            return true;
        };
        const std::string ac_table = inputs::shipped("machines/ac_trunnion.toml");
        if (names_strange_axis(found) &&
            try_on(ac_table, hurco, [](const auto& again) { return !names_strange_axis(again); }))
            print_notes(
                {program.name + ": contains words of an A axis; checked on " + use->setup.path});
        const std::size_t faults = check::count_faults(found);
        if (c_.against.empty() && names_m128(found) && try_on(path, true, [&](const auto& again) {
                return check::count_faults(again) <= faults;
            }))
            print_notes({program.name + ": contains M128; read as a program of a Hurco"});
        return *use;
    }
    CheckedMachine& first() { return machine(c_.setup, concerns_hurco()); }

    /// The folders of subprograms of a file, shared by the files of one folder.
    interpreter::ProgramFolders& folders_beside(const std::string& file) {
        const std::string folder = std::filesystem::path(file).parent_path().string();
        const auto known = folders_.find(folder);
        if (known != folders_.end()) return known->second;
        return folders_.emplace(folder, inputs::folders_beside(file, c_.folders)).first->second;
    }

  private:
    /// --against a choice of a Hurco, without a setup: the programs are a Hurco's.
    bool concerns_hurco() const { return c_.setup.empty() && c_.against.starts_with("hurco."); }

    CheckedMachine& machine(const std::string& path, bool hurco) {
        auto& known = machines_[{path, hurco}];
        if (known) return *known;
        setup::Setup setup = open_setup(path);
        if (hurco) setup.dialect = interpreter::hurco_dialect();
        known = std::make_unique<CheckedMachine>(std::move(setup), c_.against);
        return *known;
    }

    const CheckCommand& c_;
    std::map<std::pair<std::string, bool>, std::unique_ptr<CheckedMachine>> machines_;
    std::map<std::string, interpreter::ProgramFolders> folders_;
};

void check_one(const CheckCommand& c, const std::string& file, CheckedMachines& machines,
               std::vector<check::Finding>& findings) {
    const interpreter::ProgramText program = interpreter::read_program(file);
    if (const std::string part = inputs::backup_part(program); !part.empty()) {
        findings.push_back({"backup-file", check::Severity::note, file, 1, 1,
                            "this is a backup's " + part + ", not a program",
                            "trunnion backup load reads the folder."});
        return;
    }
    interpreter::refuse_empty(program);
    interpreter::ProgramFolders& beside = machines.folders_beside(file);
    interpreter::ProgramFolders programs = beside;
    programs.add_file(program);
    std::vector<check::Finding> found;
    const CheckedMachine& machine = machines.for_program(program, programs, found);
    findings.insert(findings.end(), found.begin(), found.end());
    const bool foreign = check::begins_foreign(program.text, found);
    if (!foreign) check_by_run(c, machine.setup, program, programs, findings);
    if (machine.other && !foreign) {
        const auto apart = differences_against(machine.setup, {*machine.other, c.against}, program,
                                               c.folders, c.limits);
        findings.insert(findings.end(), apart.begin(), apart.end());
    }
    beside.learn_from(programs);
    print_notes(programs.announcements());
}

void write_findings(const CheckCommand& c, const std::vector<check::Finding>& findings,
                    const std::vector<std::string>& files) {
    OutputFiles out;
    if (!c.page.html.empty()) {
        out.add(c.page.html,
                finished_page(report::findings_page(findings, files), *c.command, c.page));
    }
    out.add(c.out, report::format_findings(findings, files, c.format, ReadRecord::files()));
    out.write();
}

/// After Ctrl-C or --max-seconds: the findings of the programs that were checked whole.
int check(CheckCommand c) {
    CheckedMachines machines(c);
    const std::vector<std::string> files = files_of(c.paths);
    const Interruption interruption;
    BudgetMeter meter = fit_meter(c.time_s);
    c.limits.go_on = [&](std::uint64_t) { return meter.allows({}); };
    std::vector<check::Finding> findings;
    std::size_t done = 0;
    for (Progress progress; done < files.size() && meter.allows({}); ++done) {
        progress.count(done, files.size(), "programs");
        std::vector<check::Finding> found;
        check_one(c, files[done], machines, found);
        if (!meter.allows({})) break;
        findings.insert(findings.end(), found.begin(), found.end());
    }
    write_findings(c, findings, {files.begin(), files.begin() + static_cast<std::ptrdiff_t>(done)});
    if (done == files.size()) return check::count_faults(findings) == 0 ? exit_done : exit_differs;
    print_error("trunnion: stopped after {} of {} programs ({})\n", done, files.size(),
                reason_of(meter.reached()));
    return exit_limit;
}

}  // namespace

void add_check(CLI::App& app, Run& run) {
    const auto c = std::make_shared<CheckCommand>();
    CLI::App* command =
        app.add_subcommand("check", "check programs and folders without running them");
    reads_file(command->add_option("PATH", c->paths, "programs or folders"))->required();
    reads_file(command->add_option("--setup", c->setup, "setup file: dialect, parameters, axes"));
    reads_file(command->add_option("--programs", c->folders, "folder of subprograms, repeatable"));
    command->add_flag("--run", c->run, "also run the programs, without devices");
    command->add_option(
        "--against", c->against,
        "also run the programs on another control and report differences: hurco, hurco-bnc, 16i, "
        "0i-F, tcp_frame=start, a parameter like 5006=64, or a setup file");
    command->add_option("--max-blocks", c->limits.max_blocks,
                        "stop a run after this number of blocks");
    not_negative(command->add_option("--max-seconds", c->time_s,
                                     "stop after this time, s, with the findings so far (0: "
                                     "never)"));
    command->add_option("--format", c->format, "text, json, junit, sarif or github");
    command->add_flag_callback(
        "--json", [c] { c->format = "json"; }, "same as --format json");
    writes_file(command->add_option("--out", c->out, "file for the report"));
    add_page_options(*command, c->page);
    c->command = command;
    command->callback([c, &run] { run = [c] { return check(*c); }; });
}

}  // namespace trunnion::cli
