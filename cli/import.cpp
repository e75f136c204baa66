// trunnion import: files of instruments and controls as readings.
#include "imports/import.h"

#include <CLI/CLI.hpp>
#include <cctype>
#include <map>
#include <memory>

#include "base/alarm.h"
#include "base/console.h"
#include "base/output_files.h"
#include "base/read_file.h"
#include "cli/command.h"
#include "cli/notes.h"
#include "cli/options.h"
#include "cli/page_options.h"
#include "cli/readings_command.h"
#include "records/iso230_2.h"
#include "report/import_page.h"
#include "report/iso230_picture.h"
#include "report/readings_json.h"

namespace trunnion::cli {
namespace {

struct ImportOptions {
    std::string kind, setup, map, out, svg;
    std::vector<std::string> files, told;
    bool json = false;
    PageOptions page;
    const CLI::App* command = nullptr;
};

const std::map<std::string, imports::ImportKind> kinds{
    {"ballbar", imports::ImportKind::ballbar},  {"iso230-2", imports::ImportKind::iso230_2},
    {"points", imports::ImportKind::points},    {"axis-log", imports::ImportKind::axis_log},
    {"table", imports::ImportKind::table},      {"dprnt", imports::ImportKind::dprnt},
    {"pointing", imports::ImportKind::pointing}};

records::ReadingTable table_of(const ImportOptions& options, const setup::Setup& setup,
                               const imports::Imported& result) {
    std::vector<std::string> notes;
    return records::parse_readings(result.readings, options.out, notes,
                                   setup.machine.chain.names());
}

std::string page_of(const ImportOptions& options, const setup::Setup& setup,
                    const imports::Imported& result) {
    return finished_page(
        report::import_page(table_of(options, setup, result), result.summary, result.notes),
        *options.command, options.page);
}

/// The name of a test as a file name.
std::string file_name(std::string test) {
    for (char& c : test)
        if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
    return "iso230_2_" + test + ".svg";
}

/// A picture of each test, in the folder.
void add_pictures(const std::string& folder, const std::string& readings, const setup::Setup& setup,
                  OutputFiles& out) {
    std::vector<std::string> notes;
    const records::ReadingTable table =
        records::parse_readings(readings, "", notes, setup.machine.chain.names());
    std::map<std::string, bool> tests;
    for (const records::Reading& row : table.rows)
        if (row.device != records::Device::none) tests[row.test] = row.angular;
    for (const auto& [test, rotary] : tests)
        out.add(folder + '/' + file_name(test),
                report::iso230_2_picture(test, records::deviation_points(table, test), rotary));
    out.add_folder(folder);
}

int import_command(const ImportOptions& options) {
    const imports::ImportKind kind = kinds.at(options.kind);
    if (!options.svg.empty() && kind != imports::ImportKind::iso230_2)
        throw InputError("--svg is for tables of ISO 230-2 only");
    const setup::Setup setup = load_setup_option(options.setup);
    std::vector<imports::ImportFile> files;
    for (const std::string& path : options.files) files.push_back({path, read_file_or_input(path)});
    imports::ImportRequest request{setup, files, imports::Facts(options.told), {}};
    if (!options.map.empty()) request.map = {options.map, read_file_or_input(options.map)};
    imports::Imported result = imports::import_readings(kind, request);
    if (!options.json) print_notes(result.summary);
    print_notes(result.notes);
    OutputFiles out;
    if (!options.page.html.empty()) out.add(options.page.html, page_of(options, setup, result));
    if (!options.svg.empty()) add_pictures(options.svg, result.readings, setup, out);
    if (options.json)
        out.add("-", report::import_json(table_of(options, setup, result),
                                         {options.out, result.summary, result.notes},
                                         ReadRecord::files()));
    out.add(options.out, std::move(result.readings));
    out.write();
    return exit_done;
}

}  // namespace

void add_import(CLI::App& app, Run& run) {
    auto* command =
        app.add_subcommand("import", "convert files of instruments and controls into readings");
    const auto options = std::make_shared<ImportOptions>();
    command
        ->add_option(
            "kind", options->kind,
            "kind of the files: ballbar, iso230-2, points, axis-log, table, dprnt or pointing")
        ->required()
        ->check(CLI::IsMember(kinds));
    reads_file(command->add_option("files", options->files, "files in the order of measurement"))
        ->required();
    reads_file(command->add_option("--setup", options->setup, "setup file (required)"));
    writes_file(command->add_option("--out", options->out, "write the readings (CSV)"))->required();
    reads_file(
        command->add_option("--map", options->map, "kind table: file that assigns the columns"));
    writes_folder(command->add_option("--svg", options->svg, "kind iso230-2: folder for pictures"));
    command
        ->add_option("--with", options->told,
                     "facts that the files do not contain: 'unit=um', 'axis=X' (docs/readings.md)")
        ->allow_extra_args(false);
    command->add_flag("--json", options->json, "print what was read as one JSON object");
    add_page_options(*command, options->page);
    options->command = command;
    command->callback([options, &run] { run = [options] { return import_command(*options); }; });
}

}  // namespace trunnion::cli
