// trunnion check: static findings on programs, and with --run what stops them.
#include "check/check.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "base/alarm.h"
#include "base/output_files.h"
#include "cli/command.h"
#include "cli/options.h"
#include "cli/setups.h"
#include "controller/alarms.h"
#include "controller/g_codes.h"
#include "emulator/run.h"
#include "interpreter/program_folders.h"
#include "regression/suite.h"
#include "report/findings_report.h"

namespace trunnion {

namespace {

struct CheckCommand {
    std::vector<std::string> paths, folders;
    std::string setup, format = "text", out = "-";
    bool run = false;
    std::uint64_t max_blocks = 10'000'000;
};

std::vector<std::string> files_of(const std::vector<std::string>& paths) {
    std::vector<std::string> files;
    for (const std::string& path : paths) {
        if (!std::filesystem::is_directory(path)) {
            files.push_back(path);
            continue;
        }
        const auto names = programs_below(path);
        if (names.empty()) throw InputError("no NC program in this folder", {path, 0, 0});
        for (const std::string& name : names)
            files.push_back((std::filesystem::path(path) / name).generic_string());
    }
    return files;
}

ProgramFolders folders_for(const ProgramText& program, const CheckCommand& c) {
    std::vector<std::string> folders = c.folders;
    const auto own = std::filesystem::path(program.name).parent_path();
    folders.push_back(own.empty() ? "." : own.string());
    ProgramFolders programs(std::move(folders));
    programs.add_file(program);
    return programs;
}

/// G codes that parameters 6050-6059 make call a program.
bool is_mapped(const Stores& stores, int code10) {
    for (int number = 6050; number <= 6059; ++number)
        if (const auto code = stores.parameters.find(number); code && *code * 10.0 == code10)
            return true;
    return false;
}

class NoDevices : public MotionSink {
  public:
    MoveResult move(const AxisMove&) override { return {}; }
};

void run_without_devices(const Setup& setup, const ProgramText& program, const CheckCommand& c,
                         std::vector<Finding>& findings) {
    Stores stores = setup.stores;
    NoDevices sink;
    ProgramFolders programs = folders_for(program, c);
    ControlConfig config = control_config(setup);
    config.max_blocks = c.max_blocks;
    Controller controller(std::move(config), stores, programs, sink, [](std::string_view) {});
    const RunResult result = controller.run(program);
    if (result.status == RunStatus::limit)
        findings.push_back({"alarm", Severity::error, program.name, 1, 1,
                            fmt::format("does not end within {} blocks", c.max_blocks),
                            "Look for an endless loop, or give --max-blocks."});
    if (!result.alarm) return;
    const Alarm& alarm = *result.alarm;
    const AlarmRow* row = find_alarm(alarm.number);
    findings.push_back({"alarm", Severity::error,
                        alarm.where.program.empty() ? program.name : alarm.where.program,
                        alarm.where.line, std::max(1, alarm.where.column),
                        fmt::format("running it: {}", alarm_title(alarm.number, alarm.text)),
                        row != nullptr ? row->remedy : ""});
}

int check(const CheckCommand& c) {
    const Setup setup = open_setup(c.setup);
    const std::vector<std::string> files = files_of(c.paths);
    std::vector<Finding> findings;
    for (const std::string& file : files) {
        const ProgramText program = read_main_program(file);
        ProgramFolders programs = folders_for(program, c);
        CheckOptions options;
        options.dialect = setup.dialect;
        options.knows_g = [&](int code10) {
            return find_g_code(code10 / 10.0) != nullptr || is_mapped(setup.stores, code10) ||
                   (code10 >= 650 && code10 <= 670);  // G65 to G67 belong to the language
        };
        options.finds_program = [&](int number) { return programs.find(number).has_value(); };
        options.finds_named = [&](const std::string& name) {
            return programs.find(std::string_view(name)).has_value();
        };
        const auto found = check_program(program, options);
        findings.insert(findings.end(), found.begin(), found.end());
        if (c.run) run_without_devices(setup, program, c, findings);
    }
    OutputFiles out;
    out.add(c.out, format_findings(findings, files, c.format));
    out.write();
    return findings.empty() ? exit_done : exit_differs;
}

}  // namespace

void add_check(CLI::App& app, Run& run) {
    const auto c = std::make_shared<CheckCommand>();
    CLI::App* command = app.add_subcommand("check", "static findings on programs and folders");
    reads_file(command->add_option("PATH", c->paths, "programs and folders"))->required();
    reads_file(
        command->add_option("--setup", c->setup, "machine and control (dialect, parameters)"));
    reads_file(command->add_option("--programs", c->folders, "folders of subprograms"));
    command->add_flag("--run", c->run, "also run them, without devices");
    command->add_option("--max-blocks", c->max_blocks, "limit of a run");
    command->add_option("--format", c->format, "text, json, junit, sarif, github");
    command->add_flag_callback(
        "--json", [c] { c->format = "json"; }, "the same as --format json");
    writes_file(command->add_option("--out", c->out, "file for the report"));
    command->callback([c, &run] { run = [c] { return check(*c); }; });
}

}  // namespace trunnion
