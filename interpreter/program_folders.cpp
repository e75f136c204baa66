#include "interpreter/program_folders.h"

#include <unistd.h>

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

constexpr std::array<std::string_view, 23> endings{"",       ".nc",  ".txt", ".tap", ".min", ".mpf",
                                                   ".cnc",   ".ngc", ".eia", ".iso", ".prg", ".hnc",
                                                   ".fnc",   ".dnc", ".spf", ".sub", ".mac", ".arc",
                                                   ".gcode", ".pim", ".pgm", ".fan", ".din"};

std::string lower(std::string text) {
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

/// LIB.001: searched for what it holds; a name O1234.1 may be an old version.
bool may_hold_programs(const fs::path& path) {
    const std::string ending = path.extension().string();
    return has_program_ending(path.string()) ||
           (ending.size() > 1 && ending.find_first_not_of("0123456789", 1) == ending.npos);
}

/// 1234 for O1234.nc, 1234, o01234.TXT; nothing for other names.
std::optional<int> number_of_file(const fs::path& path) {
    if (!has_program_ending(path.string())) return std::nullopt;
    std::string stem = lower(path.stem().string());
    if (stem.starts_with('<') && stem.ends_with('>')) stem = stem.substr(1, stem.size() - 2);
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

/// Calls `found` with the head of every program that starts in `text`.
void programs_in(std::string_view text, const std::function<void(const LineHead&)>& found) {
    for (LineScan scan(text, start_of_text(text)); scan.next();)
        if (scan.head().kind == LineKind::program) found(scan.head());
}

bool has_number(const LineHead& head) {
    return *head.content != '<' || head.number > 0;
}

/// NAME of a head `<NAME>`; empty for others.
std::string title_of(const LineHead& head, std::string_view text) {
    if (*head.content != '<') return {};
    const std::string_view rest =
        text.substr(static_cast<std::size_t>(head.content - text.data()) + 1);
    return std::string(rest.substr(0, rest.find_first_of(">\r\n")));
}

/// The O number that a file holds, if it has one and not the wanted one.
std::optional<int> other_number(const ProgramText& text, int wanted) {
    std::optional<int> other;
    bool holds = false;
    programs_in(text.text, [&](const LineHead& head) {
        if (!has_number(head)) return;
        holds = holds || head.number == wanted;
        if (!other) other = head.number;
    });
    return holds ? std::nullopt : other;
}

/// Feed holes: a text punched on paper tape begins and ends with zero bytes.
std::string_view without_leader(std::string_view text) {
    const std::size_t first = text.find_first_not_of('\0');
    if (first == text.npos) return text;
    return text.substr(first, text.find_last_not_of('\0') - first + 1);
}

/// All entries of a folder. Throws InputError where it cannot be read to its end.
std::vector<fs::directory_entry> entries_of(const fs::path& folder) {
    std::vector<fs::directory_entry> entries;
    std::error_code error;
    for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
        entries.push_back(*at);
    if (error) throw InputError("cannot be read: " + error.message(), {folder.string(), 0, 0});
    return entries;
}

/// Files of one folder, sorted; a circular link is not a program.
std::vector<std::string> files_in(const fs::path& folder) {
    std::vector<std::string> names;
    std::error_code unknown;
    for (const fs::directory_entry& entry : entries_of(folder))
        if (entry.is_regular_file(unknown)) names.push_back(entry.path().string());
    std::sort(names.begin(), names.end());
    return names;
}

/// Subfolders of one folder, sorted; neither hidden ones, nor links, nor those closed to this user.
std::vector<fs::path> folders_in(const fs::path& folder) {
    std::vector<fs::path> names;
    std::error_code unknown;
    for (const fs::directory_entry& entry : entries_of(folder))
        if (entry.is_directory(unknown) && !entry.is_symlink(unknown) &&
            !entry.path().filename().string().starts_with('.') &&
            ::access(entry.path().c_str(), R_OK | X_OK) == 0)
            names.push_back(entry.path());
    std::sort(names.begin(), names.end());
    return names;
}

constexpr int deepest_subfolder = 3;
constexpr std::size_t most_files_below = 5000;
constexpr std::uintmax_t most_bytes_below = 256'000'000;

/// True for a file that this user cannot read.
bool is_closed(const std::string& path) {
    return ::access(path.c_str(), R_OK) != 0;
}

}  // namespace

bool has_program_ending(const std::string& path) {
    const std::string ending = lower(fs::path(path).extension().string());
    return std::find(endings.begin(), endings.end(), ending) != endings.end();
}

ProgramText read_program(const std::string& path) {
    const auto bytes = std::make_shared<const std::string>(read_file_or_input(path));
    return {path, without_leader(*bytes), bytes};
}

ProgramText read_main_program(const std::string& path) {
    ProgramText program = read_program(path);
    refuse_empty(program);
    return program;
}

void refuse_empty(const ProgramText& program) {
    const std::string_view text = program.text.substr(start_of_text(program.text).byte);
    if (text.find_first_not_of(" \t\r\n%") == std::string_view::npos)
        throw InputError("the program is empty", {program.name, 0, 0});
}

ProgramFolders::ProgramFolders(std::vector<std::string> folders,
                               std::vector<std::string> shipped_folders) {
    shelves_[own].folders = std::move(folders);
    shelves_[shipped].folders = std::move(shipped_folders);
    for (const Shelf& shelf : shelves_)
        for (const std::string& folder : shelf.folders)
            if (std::error_code unknown; !fs::is_directory(folder, unknown))
                throw InputError(fs::exists(folder, unknown) ? "is a file, not a program folder"
                                                             : "no such program folder",
                                 {folder, 0, 0});
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
        programs_in(file.text, [&](const LineHead& head) {
            if (has_number(head)) own_.emplace(head.number, file);
        });
}

void ProgramFolders::list(std::size_t place) {
    Shelf& shelf = shelves_[place];
    if (std::exchange(shelf.listed, true)) return;
    if (place == below)
        list_below();
    else
        for (const std::string& folder : shelf.folders)
            for (std::string& name : files_in(folder)) shelf.files.push_back(std::move(name));
    for (const std::string& path : shelf.files)
        if (const auto number = number_of_file(path)) shelf.by_name[*number].push_back(path);
}

/// The subfolders of the user's folders, near ones first; not those that are searched anyway.
void ProgramFolders::list_below() {
    std::vector<fs::path> level(shelves_[own].folders.begin(), shelves_[own].folders.end());
    const auto is_searched = [&](const fs::path& folder) {
        std::error_code unknown;
        for (const std::size_t place : {own, shipped})
            for (const std::string& other : shelves_[place].folders)
                if (fs::equivalent(folder, other, unknown)) return true;
        return false;
    };
    std::uintmax_t bytes = 0;
    for (int depth = 1; depth <= deepest_subfolder; ++depth) {
        std::vector<fs::path> next;
        for (const fs::path& folder : level)
            for (fs::path& sub : folders_in(folder)) {
                if (is_searched(sub)) continue;
                for (std::string& name : files_in(sub)) {
                    std::error_code unknown;
                    if (!may_hold_programs(name) || is_closed(name)) continue;
                    bytes += fs::file_size(name, unknown);
                    if (shelves_[below].files.size() == most_files_below ||
                        bytes > most_bytes_below)
                        return announce("the subfolders hold too many files: from " + name +
                                        " on they are not searched for programs");
                    shelves_[below].files.push_back(std::move(name));
                }
                next.push_back(std::move(sub));
            }
        level = std::move(next);
    }
}

void ProgramFolders::scan(Shelf& shelf) {
    if (std::exchange(shelf.scanned, true)) return;
    for (const std::string& path : shelf.files) {
        if (!may_hold_programs(path)) continue;
        const ProgramText file = read_program(path);
        if (!is_text(file.text)) continue;
        programs_in(file.text, [&](const LineHead& head) {
            if (has_number(head)) {
                auto& paths = shelf.by_content[head.number];
                if (paths.empty() || paths.back() != path) paths.push_back(path);
            }
            const std::string title = title_of(head, file.text);
            if (!title.empty()) shelf.by_title.emplace(title, path);
        });
    }
}

/// By file name, then by content, one shelf after the other.
std::optional<ProgramFolders::Found> ProgramFolders::search(int o_number) {
    for (std::size_t place = own; place < place_count; ++place) {
        list(place);
        Shelf& shelf = shelves_[place];
        const auto named = shelf.by_name.find(o_number);
        if (named != shelf.by_name.end()) return Found{place, named->second};
        scan(shelf);
        const auto held = shelf.by_content.find(o_number);
        if (held != shelf.by_content.end()) return Found{place, held->second};
    }
    return std::nullopt;
}

std::optional<ProgramFolders::Found> ProgramFolders::search(std::string_view name) {
    const std::string wanted = lower(std::string(name));
    for (std::size_t place = own; place < place_count; ++place) {
        list(place);
        Shelf& shelf = shelves_[place];
        for (const std::string& path : shelf.files) {
            const fs::path file(path);
            if (lower(file.filename().string()) == wanted || lower(file.stem().string()) == wanted)
                return Found{place, {path}};
        }
        scan(shelf);
        const auto held = shelf.by_title.find(name);
        if (held != shelf.by_title.end()) return Found{place, {held->second}};
    }
    return std::nullopt;
}

const ProgramText& ProgramFolders::read_once(const std::string& path) {
    const auto known = read_.find(path);
    return known != read_.end() ? known->second
                                : read_.emplace(path, read_program(path)).first->second;
}

void ProgramFolders::announce(std::string line) {
    if (std::find(announcements_.begin(), announcements_.end(), line) == announcements_.end())
        announcements_.push_back(std::move(line));
}

/// The first file, with a line when it is not in a folder that the user gave.
ProgramText ProgramFolders::take(const Found& found, const std::string& program) {
    const std::string& path = found.paths.front();
    if (found.place == shipped)
        announce(program + " is a shipped program (" + path + "): no folder of yours holds it");
    if (found.place == below)
        announce(program + " is taken from a subfolder (" + path + ")" +
                 (found.paths.size() > 1 ? "; it is also in " + found.paths[1] : ""));
    return read_once(path);
}

std::optional<ProgramText> ProgramFolders::look_up(int o_number) {
    scan_own_files();
    if (const auto given = own_.find(o_number); given != own_.end()) return given->second;
    if (const auto found = search(o_number)) return read_once(found->paths.front());
    return std::nullopt;
}

bool ProgramFolders::holds_own(int o_number) {
    const auto found = search(o_number);
    return found && found->place != shipped;
}

std::optional<ProgramText> ProgramFolders::find(int o_number) {
    scan_own_files();
    if (const auto given = own_.find(o_number); given != own_.end()) return given->second;
    const auto found = search(o_number);
    if (!found) return std::nullopt;
    const ProgramText text = take(*found, "O" + std::to_string(o_number));
    if (const auto other = other_number(text, o_number))
        announce("O" + std::to_string(o_number) + " is taken from " + text.name +
                 " by the file's name: it holds O" + std::to_string(*other));
    return text;
}

std::optional<ProgramText> ProgramFolders::find(std::string_view name) {
    const auto found = search(name);
    if (!found) return std::nullopt;
    return take(*found, "<" + std::string(name) + ">");
}

}  // namespace trunnion::interpreter
