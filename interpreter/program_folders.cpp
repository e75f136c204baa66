#include "interpreter/program_folders.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <filesystem>
#include <functional>

#include "base/alarm.h"
#include "base/read_file.h"
#include "interpreter/line_scan.h"

namespace trunnion::interpreter {
namespace fs = std::filesystem;
namespace {

constexpr std::array<std::string_view, 19> endings{
    "",     ".nc",  ".txt", ".tap", ".min", ".mpf", ".cnc", ".ngc", ".eia",  ".iso",
    ".prg", ".hnc", ".fnc", ".dnc", ".spf", ".sub", ".mac", ".arc", ".gcode"};

std::string lower(std::string text) {
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

bool has_program_ending(const fs::path& path) {
    const std::string ending = lower(path.extension().string());
    return std::find(endings.begin(), endings.end(), ending) != endings.end();
}

/// 1234 for O1234.nc, 1234, o01234.TXT; nothing for other names.
std::optional<int> number_of_file(const fs::path& path) {
    if (!has_program_ending(path)) return std::nullopt;
    std::string stem = lower(path.stem().string());
    if (stem.starts_with('o')) stem.erase(0, 1);
    int number = 0;
    const char* const last = stem.data() + stem.size();
    const auto [end, fault] = std::from_chars(stem.data(), last, number);
    if (fault != std::errc{} || end != last || number < 0) return std::nullopt;
    return number;
}

/// A picture or an executable without an ending is no program, whatever its lines begin with.
bool is_text(std::string_view text) {
    return text.substr(0, 4096).find('\0') == std::string_view::npos;
}

/// Calls `found` with the number of every program that starts in `text`.
void programs_in(std::string_view text, const std::function<void(int)>& found) {
    for (LineScan scan(text, start_of_text(text)); scan.next();)
        if (scan.head().kind == LineKind::program && *scan.head().content != '<')
            found(scan.head().number);
}

}  // namespace

ProgramText read_program(const std::string& path) {
    const auto bytes = std::make_shared<const std::string>(read_file_or_input(path));
    return {path, *bytes, bytes};
}

ProgramText read_main_program(const std::string& path) {
    ProgramText program = read_program(path);
    refuse_empty(program);
    return program;
}

void refuse_empty(const ProgramText& program) {
    if (program.text.find_first_not_of(" \t\r\n%") == std::string_view::npos)
        throw InputError("the program is empty", {program.name, 0, 0});
}

ProgramFolders::ProgramFolders(std::vector<std::string> folders, std::vector<std::string> shipped) {
    own_shelf_.folders = std::move(folders);
    shipped_.folders = std::move(shipped);
    for (const Shelf* shelf : {&own_shelf_, &shipped_})
        for (const std::string& folder : shelf->folders)
            if (std::error_code unknown; !fs::is_directory(folder, unknown))
                throw InputError("no such program folder", {folder, 0, 0});
}

void ProgramFolders::add_file(const ProgramText& file) {
    given_.push_back(file);
    own_files_.push_back(file);
}

std::vector<ProgramText> ProgramFolders::used() const {
    std::vector<ProgramText> files = given_;
    for (const auto& [path, text] : read_) files.push_back(text);
    return files;
}

void ProgramFolders::scan_own_files() {
    for (const ProgramText& file : std::exchange(own_files_, {}))
        programs_in(file.text, [&](int number) { own_.emplace(number, file); });
}

void ProgramFolders::list(Shelf& shelf) {
    if (std::exchange(shelf.listed, true)) return;
    for (const std::string& folder : shelf.folders) {
        std::vector<std::string> names;
        for (const auto& entry : fs::directory_iterator(folder)) {
            std::error_code unknown;  // a circular link is not a program
            if (entry.is_regular_file(unknown)) names.push_back(entry.path().string());
        }
        std::sort(names.begin(), names.end());
        for (std::string& name : names) {
            if (const auto number = number_of_file(name)) shelf.by_name.emplace(*number, name);
            shelf.files.push_back(std::move(name));
        }
    }
}

/// Searches by file name, then by content; nullptr when not found.
const std::string* ProgramFolders::path_of(Shelf& shelf, int o_number) {
    list(shelf);
    if (const auto named = shelf.by_name.find(o_number); named != shelf.by_name.end())
        return &named->second;
    if (!std::exchange(shelf.scanned, true))
        for (const std::string& path : shelf.files)
            if (has_program_ending(path))
                if (const ProgramText file = read_program(path); is_text(file.text))
                    programs_in(file.text, [&](int n) { shelf.by_content.emplace(n, path); });
    const auto held = shelf.by_content.find(o_number);
    return held != shelf.by_content.end() ? &held->second : nullptr;
}

/// `wanted`: in lower case.
const std::string* ProgramFolders::path_of(Shelf& shelf, const std::string& wanted) {
    list(shelf);
    for (const std::string& path : shelf.files) {
        const fs::path file(path);
        if (lower(file.filename().string()) == wanted || lower(file.stem().string()) == wanted)
            return &path;
    }
    return nullptr;
}

const ProgramText& ProgramFolders::read_once(const std::string& path) {
    const auto known = read_.find(path);
    return known != read_.end() ? known->second
                                : read_.emplace(path, read_program(path)).first->second;
}

void ProgramFolders::announce(const std::string& program, const ProgramText& text) {
    const std::string line =
        program + " is a shipped program (" + text.name + "): no folder of yours holds it";
    if (std::find(announcements_.begin(), announcements_.end(), line) == announcements_.end())
        announcements_.push_back(line);
}

std::optional<ProgramText> ProgramFolders::look_up(int o_number) {
    scan_own_files();
    if (const auto own = own_.find(o_number); own != own_.end()) return own->second;
    for (Shelf* shelf : {&own_shelf_, &shipped_})
        if (const std::string* path = path_of(*shelf, o_number)) return read_once(*path);
    return std::nullopt;
}

std::optional<ProgramText> ProgramFolders::find(int o_number) {
    const auto text = look_up(o_number);
    if (text && !own_.contains(o_number) && !path_of(own_shelf_, o_number))
        announce("O" + std::to_string(o_number), *text);
    return text;
}

std::optional<ProgramText> ProgramFolders::find(std::string_view name) {
    const std::string wanted = lower(std::string(name));
    if (const std::string* path = path_of(own_shelf_, wanted)) return read_once(*path);
    const std::string* path = path_of(shipped_, wanted);
    if (!path) return std::nullopt;
    const ProgramText& text = read_once(*path);
    announce("<" + std::string(name) + ">", text);
    return text;
}

}  // namespace trunnion::interpreter
