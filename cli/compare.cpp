// trunnion compare: compares the machining of two programs, folders or suites.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <mutex>
#include <thread>

#include "base/alarm.h"
#include "base/console.h"
#include "base/output_files.h"
#include "base/read_file.h"
#include "base/units.h"
#include "cli/budget_options.h"
#include "cli/command.h"
#include "cli/long_work.h"
#include "cli/options.h"
#include "cli/page_options.h"
#include "cli/setups.h"
#include "cli/shards.h"
#include "interpreter/program_folders.h"
#include "regression/suite.h"
#include "report/comparison_report.h"
#include "report/json_values.h"

namespace trunnion::cli {

namespace {

struct CompareCommand {
    std::string a, b, suite, setup, setup_b, by, call, format = "text", shard, reason, out = "-";
    std::vector<std::string> program_folders;
    double tol_lin_mm = regression::Tolerances{}.position_mm;
    double tol_ang_deg = deg_from_rad(regression::Tolerances{}.direction_rad);
    double tol_feed = regression::Tolerances{}.feed_ratio,
           tol_time = regression::Tolerances{}.time_ratio;
    unsigned threads = 0;
    double max_seconds = 0.0;
    std::uint64_t max_blocks = 100'000'000;  ///< limit for an endless loop, exit code 4
    bool json = false, update = false, devices = false;
    PageOptions page;
    const CLI::App* command = nullptr;
};

/// What the options ask for, the page with its origin.
void put_report(const CompareCommand& c, const regression::CompareReport& report,
                report::ReportFormat format) {
    report::Page page;
    const bool html = format == report::ReportFormat::html;
    if (html || !c.page.html.empty()) {
        page = report::comparison_page(report);
        page.origin = page_origin(*c.command, c.page);
    }
    OutputFiles files;  // both or none
    if (!c.page.html.empty()) files.add(c.page.html, report::page_html(page));
    files.add(c.out, html ? report::page_html(page) : report::format_comparison(report, format));
    files.write();
}

regression::SuiteCase case_of(const CompareCommand& c, const SharedLimits& limits) {
    if (!(c.tol_lin_mm > 0.0) || !(c.tol_ang_deg > 0.0) || !(c.tol_feed >= 0.0) ||
        !(c.tol_time >= 0.0))
        throw InputError("tolerances must be above 0");
    regression::SuiteCase like;
    like.setup = c.setup;
    like.setup_b = c.setup_b.empty() ? c.setup : c.setup_b;
    like.options.tolerances.position_mm = c.tol_lin_mm;
    like.options.tolerances.direction_rad = rad_from_deg(c.tol_ang_deg);
    like.options.tolerances.feed_ratio = c.tol_feed;
    like.options.tolerances.time_ratio = c.tol_time;
    like.options.program_folders = c.program_folders;
    like.options.max_blocks = c.max_blocks;
    like.options.call = c.call;
    like.options.devices = c.devices;
    like.options.go_on = [limits] { return limits.reached() == BudgetLimit::none; };
    if (c.by.empty()) return like;
    const auto layer =
        std::find(regression::layer_names.begin(), regression::layer_names.end(), c.by);
    if (layer == regression::layer_names.end())
        throw InputError("--by " + c.by +
                         " is not one of text, words, blocks, path, functions, axes, effects");
    like.options.by = static_cast<regression::Layer>(layer - regression::layer_names.begin());
    return like;
}

regression::CompareReport compare_two(const CompareCommand& c, const regression::SuiteCase& like) {
    const interpreter::ProgramText a = interpreter::read_main_program(c.a),
                                   b = interpreter::read_main_program(c.b);
    const setup::Setup setup_a = open_setup(like.setup);
    regression::CompareReport report;
    if (like.setup_b == like.setup) {
        report.cases.push_back(regression::compare_programs(a, setup_a, b, setup_a, like.options));
    } else {
        const setup::Setup setup_b = open_setup(like.setup_b);
        report.cases.push_back(regression::compare_programs(a, setup_a, b, setup_b, like.options));
    }
    return report;
}

regression::Suite suite_of(const CompareCommand& c, const regression::SuiteCase& like) {
    if (c.suite.empty()) return regression::suite_of_folders(c.a, c.b, like);
    return regression::read_suite(c.suite, like);
}

std::string list_of_written(const std::vector<std::string>& paths, report::ReportFormat format) {
    if (format == report::ReportFormat::json)
        return report::json_text({{"schema", "trunnion.goldens/1"}, {"written", paths}}, 2) + "\n";
    if (paths.empty()) return "nothing to write: every golden is up to date\n";
    std::string list;
    for (const std::string& path : paths) list += fmt::format("written: {}\n", path);
    return list;
}

int update(const CompareCommand& c, const regression::Suite& suite, report::ReportFormat format) {
    if (c.reason.empty() || c.reason.find('\n') != std::string::npos)
        throw InputError(
            "--update needs --reason \"one line that says why the machining changed\"");
    OutputFiles files;
    const auto goldens = regression::updated_goldens(suite, c.reason, open_setup);
    std::vector<std::string> written;
    for (const auto& [path, text] : goldens) {
        files.add_folder(std::filesystem::path(path).parent_path().string());
        files.add(path, text);
        written.push_back(path);
    }
    files.add("-", list_of_written(written, format));
    files.write();
    return exit_done;
}

int compare_many(const CompareCommand& c, const regression::SuiteCase& like,
                 const SharedLimits& limits, report::ReportFormat format) {
    const regression::Suite suite = suite_of(c, like);
    if (c.update) return update(c, suite, format);
    const auto shard = shard_of(c.shard);
    const unsigned threads = c.threads > 0 ? c.threads : std::thread::hardware_concurrency();
    Progress progress;
    std::mutex showing;
    const regression::SuiteWatch watch{[&](std::size_t done, std::size_t total) {
                                           const std::lock_guard<std::mutex> lock(showing);
                                           progress.count(done, total, "programs");
                                       },
                                       [&] { return std::string(reason_of(limits.reached())); }};
    regression::SuiteRun run = regression::run_suite(suite, shard.value_or(regression::Shard{}),
                                                     open_setup, threads, watch);
    run.report.inputs = ReadRecord::files();
    const int code = regression::exit_code(run.report);
    if (shard)
        write_output(shard_path(c.out, *shard),
                     report::format_part(
                         {std::move(run.report), std::move(run.places), suite.cases.size()}));
    else
        put_report(c, run.report, format);
    return code;
}

int compare(const CompareCommand& c) {
    const report::ReportFormat format = report::report_format(c.json ? "json" : c.format);
    const Interruption interruption;
    const SharedLimits limits(c.max_seconds);
    const regression::SuiteCase like = case_of(c, limits);
    // Equal texts are not run, so nothing else would look for the folders.
    const interpreter::ProgramFolders exist(c.program_folders);
    if (c.suite.empty() == (c.a.empty() || c.b.empty()) || (!c.suite.empty() && !c.a.empty()))
        throw InputError("compare needs two programs, two folders or --suite FILE");
    if (c.update && c.suite.empty()) throw InputError("--update requires --suite");
    if (!c.suite.empty() || std::filesystem::is_directory(c.a) ||
        std::filesystem::is_directory(c.b))
        return compare_many(c, like, limits, format);
    if (!c.shard.empty()) throw InputError("--shard requires folders or a suite");
    regression::CompareReport report = compare_two(c, like);
    report.inputs = ReadRecord::files();
    put_report(c, report, format);
    const int code = regression::exit_code(report);
    if (const BudgetLimit limit = limits.reached();
        code == exit_limit && limit != BudgetLimit::none)
        print_error("trunnion: {}: the results so far\n", reason_of(limit));
    return code;
}

}  // namespace

void add_compare(CLI::App& app, Run& run) {
    const auto c = std::make_shared<CompareCommand>();
    CLI::App* command =
        app.add_subcommand("compare", "compare the machining of two programs or folders");
    reads_file(command->add_option("A", c->a, "old program or folder"));
    reads_file(command->add_option("B", c->b, "new program or folder"));
    reads_file(
        command->add_option("--suite", c->suite, "suite file: programs, setups and tolerances"));
    reads_file(command->add_option("--setup", c->setup, "setup file of both, or of A"));
    reads_file(command->add_option("--setup-b", c->setup_b, "setup file of B"));
    reads_file(
        command->add_option("--programs", c->program_folders, "folder of subprograms, repeatable"));
    command->add_option("--tol-lin", c->tol_lin_mm, "position tolerance, mm")
        ->capture_default_str();
    command->add_option("--tol-ang", c->tol_ang_deg, "direction tolerance, deg")
        ->capture_default_str();
    command->add_option("--tol-feed", c->tol_feed, "feed and speed tolerance, relative")
        ->capture_default_str();
    command->add_option("--tol-time", c->tol_time, "cycle time tolerance, relative")
        ->capture_default_str();
    command->add_option("--by", c->by,
                        "compare one layer: text, words, blocks, path, functions, axes or effects");
    command->add_option("--call", c->call,
                        "block that calls both programs, for example \"G65 P9814 D25.4\"");
    command->add_flag("--devices", c->devices,
                      "simulate the probe and the artefacts of the setup, which answer G31");
    command->add_option("--format", c->format,
                        "text, json, junit, sarif, github, html or markdown");
    command->add_flag("--json", c->json, "same as --format json");
    writes_file(command->add_option("--out", c->out,
                                    "file for the report or the part ({i}: number of the shard)"));
    command->add_option("--shard", c->shard,
                        "run one part of the cases, for 'merge': i/n, /n or env");
    command->add_option("--threads", c->threads, "number of threads (all cores)");
    command->add_option("--max-blocks", c->max_blocks,
                        "stop a program after this number of blocks");
    command->add_flag("--update", c->update, "rewrite the goldens of the suite that differ");
    command->add_option("--reason", c->reason, "reason for the change, written into the golden");
    not_negative(command->add_option("--max-seconds", c->max_seconds,
                                     "end the runs after so long together (0: never)"));
    add_page_options(*command, c->page);
    c->command = command;
    command->callback([c, &run] { run = [c] { return compare(*c); }; });
}

}  // namespace trunnion::cli
