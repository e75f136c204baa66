// trunnion merge: one report from the parts of 'compare --shard' or 'identify --shard'.
#include <CLI/CLI.hpp>
#include <memory>

#include "base/alarm.h"
#include "base/output_files.h"
#include "base/read_file.h"
#include "cli/command.h"
#include "cli/options.h"
#include "cli/page_options.h"
#include "report/comparison_report.h"
#include "report/identification_report.h"

namespace trunnion::cli {

namespace {

struct MergeOptions {
    std::vector<std::string> parts;
    std::string format = "text", out = "-";
    PageOptions page;
    const CLI::App* command = nullptr;
};

struct PartFile {
    std::string path, text;
};

int merge_comparisons(const std::vector<PartFile>& files, const MergeOptions& o) {
    const report::ReportFormat format = report::report_format(o.format);
    std::vector<report::ComparePart> parts;
    for (const PartFile& file : files) parts.push_back(report::parse_part(file.text, file.path));
    const regression::CompareReport whole = report::merge_parts(parts);
    if (format == report::ReportFormat::html) {
        report::Page page = report::comparison_page(whole);
        page.origin = page_origin(*o.command, o.page);
        write_output(o.out, report::page_html(page));
    } else {
        write_output(o.out, report::format_comparison(whole, format));
    }
    return regression::exit_code(whole);
}

int merge_repetitions(const std::vector<PartFile>& files, const MergeOptions& o) {
    if (o.format != "text" && o.format != "json")
        throw InputError("parts of identify can be merged to text or json, not to '" + o.format +
                         "'");
    std::vector<report::RepetitionPart> parts;
    for (const PartFile& file : files)
        parts.push_back(report::parse_repetition_part(file.text, file.path));
    const identification::Identification whole = report::merge_parts(parts);
    write_output(o.out, o.format == "json" ? report::identification_json(whole, parts.front().files)
                                           : report::identification_text(whole, true));
    return exit_done;
}

int merge(const MergeOptions& o) {
    std::vector<PartFile> files;
    for (const std::string& path : o.parts) files.push_back({path, read_file(path)});
    return report::is_repetition_part(files.front().text) ? merge_repetitions(files, o)
                                                          : merge_comparisons(files, o);
}

}  // namespace

void add_merge(CLI::App& app, Run& run) {
    const auto o = std::make_shared<MergeOptions>();
    CLI::App* command = app.add_subcommand(
        "merge", "merge the parts of 'compare --shard' or 'identify --shard' into one report");
    reads_file(command->add_option("PART", o->parts, "parts in any order"))->required();
    command->add_option("--format", o->format,
                        "text, json, junit, sarif, github, html or markdown");
    command->add_flag_callback(
        "--json", [o] { o->format = "json"; }, "same as --format json");
    writes_file(command->add_option("--out", o->out, "file for the report"));
    o->command = command;
    command->callback([o, &run] { run = [o] { return merge(*o); }; });
}

}  // namespace trunnion::cli
