#include "cli/options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cstdint>
#include <filesystem>

#include "base/alarm.h"
#include "base/numbers.h"
#include "base/output_files.h"

namespace trunnion::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* read_type = "FILE";
constexpr const char* written_type = "OUTFILE";
constexpr const char* folder_type = "OUTFOLDER";

std::string finite_number(const std::string& text) {
    return parse_number(text) ? "" : "'" + text + "' is not a finite number";
}

std::string integer(const std::string& text) {
    int value = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, fault] = std::from_chars(text.data(), end, value);
    return fault == std::errc{} && stop == end ? "" : "'" + text + "' is not a whole number";
}

std::string count(const std::string& text) {
    std::uint64_t value = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, fault] = std::from_chars(text.data(), end, value);
    return fault == std::errc{} && stop == end ? "" : "'" + text + "' is not 0, 1, 2, ...";
}

/// An unset variable in a script must not silently disable an output.
std::string has_name(const std::string& path) {
    return path.empty() ? "a file name is empty" : "";
}

struct NamedFile {
    std::string option, text;
    fs::path path;
    bool written = false, folder = false;
};

std::vector<NamedFile> files_named(const CLI::App& command) {
    std::vector<NamedFile> files;
    for (const CLI::Option* option : command.get_options()) {
        const std::string type = option->get_type_name();
        if (type != read_type && type != written_type && type != folder_type) continue;
        for (const std::string& text : option->results()) {
            std::error_code unknown;
            const bool written = type != read_type;
            const fs::path path = text != "-"
                                      ? fs::weakly_canonical(fs::absolute(text, unknown), unknown)
                                  : written ? fs::path("standard output")
                                            : fs::path("standard input");
            files.push_back({option->get_name(), text, path, written, type == folder_type});
        }
    }
    return files;
}

/// True when both are the same file. A device may be used several times.
bool clash(const NamedFile& written, const NamedFile& other) {
    std::error_code unknown;
    return written.path == other.path && !written.path.empty() &&
           (written.text == "-" || !fs::is_character_file(written.path, unknown));
}

/// With --json standard output is one JSON object; --format then requires --out.
void refuse_beside_json(const CLI::App& command, const std::vector<NamedFile>& files) {
    const CLI::Option* json = command.get_option_no_throw("--json");
    if (!json || json->count() == 0 || command.get_option_no_throw("--format")) return;
    for (const NamedFile& file : files)
        if (file.written && file.text == "-")
            throw InputError(file.option + " cannot write to standard output together with --json");
}

}  // namespace

CLI::Option* reads_file(CLI::Option* option) {
    return option->type_name(read_type)->check(has_name);
}

CLI::Option* writes_file(CLI::Option* option) {
    return option->type_name(written_type)->check(has_name);
}

CLI::Option* writes_folder(CLI::Option* option) {
    return option->type_name(folder_type)->check(has_name);
}

CLI::Option* not_negative(CLI::Option* option) {
    return option->check([](const std::string& text) {
        const auto value = parse_number(text);
        return value && *value < 0.0 ? text + " is below 0" : std::string();
    });
}

void check_numbers(CLI::App& app) {
    for (CLI::Option* option : app.get_options()) {
        const std::string type = option->get_type_name();
        if (type.starts_with("FLOAT")) option->check(finite_number);
        if (type.starts_with("UINT")) option->check(count);
        if (type.starts_with("INT")) option->check(integer);
    }
    for (CLI::App* command : app.get_subcommands({})) check_numbers(*command);
}

void refuse_clashing_files(const CLI::App& app) {
    const std::vector<NamedFile> files = files_named(app);
    refuse_beside_json(app, files);
    for (std::size_t i = 0; i < files.size(); ++i)
        for (std::size_t k = 0; k < files.size(); ++k)
            if (i != k && files[i].written && clash(files[i], files[k]))
                throw InputError(files[k].written ? fmt::format("{} and {} would both write this",
                                                                files[std::min(i, k)].option,
                                                                files[std::max(i, k)].option)
                                                  : fmt::format("{} would overwrite what {} reads",
                                                                files[i].option, files[k].option),
                                 {files[i].text, 0, 0});
    for (const CLI::App* command : app.get_subcommands()) refuse_clashing_files(*command);
}

void refuse_unwritable_files(const CLI::App& app) {
    const std::vector<NamedFile> files = files_named(app);
    const bool makes_folders =
        std::any_of(files.begin(), files.end(), [](const NamedFile& file) { return file.folder; });
    for (const NamedFile& file : files) {
        std::error_code unknown;
        const fs::file_status status = fs::status(file.text, unknown);
        if (!file.written || file.text == "-" || file.text.find("{i}") != std::string::npos)
            continue;
        const bool device =
            fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
        const bool made_later = makes_folders && !fs::exists(file.path.parent_path(), unknown);
        if (file.folder)
            OutputFiles().add_folder(file.text);  // it goes again
        else if (!device && !made_later)
            OutputFile(file.text);  // never published
    }
    for (const CLI::App* command : app.get_subcommands()) refuse_unwritable_files(*command);
}

}  // namespace trunnion::cli
