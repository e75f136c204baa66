#include "cli/files.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/alarm.h"
#include "base/text.h"

namespace trunnion {

namespace fs = std::filesystem;

std::string shipped(const std::string& relative) {
    std::error_code error;
    const fs::path program = fs::read_symlink("/proc/self/exe", error);
    for (fs::path folder = program.parent_path(); !folder.empty(); folder = folder.parent_path()) {
        for (const fs::path& candidate : {folder / relative, folder / "share/trunnion" / relative})
            if (fs::exists(candidate)) return fs::proximate(candidate, error).string();
        if (folder == folder.root_path()) break;
    }
    throw InputError("not found beside the program or in share/trunnion", {relative});
}

void make_folder(const std::string& path) {
    if (path.empty()) return;  // the one we are in
    std::error_code error;
    fs::create_directories(path, error);
    if (error) throw InputError("this folder cannot be made: " + error.message(), {path});
}

std::string read_whole(const std::string& path) {
    if (fs::is_directory(path)) throw InputError("is a folder, not a file", {path});
    std::ifstream in(path, std::ios::binary);
    if (!in) throw InputError("no such file, or it cannot be read", {path});
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

struct OutputFiles::Growing {
    std::string path, part;
    std::ofstream out;
};

OutputFiles::OutputFiles() = default;

OutputFiles::~OutputFiles() {
    std::error_code ignored;
    for (const auto& file : growing_)
        if (file->part != file->path) fs::remove(file->part, ignored);
}

void OutputFiles::add(const std::string& path, std::string text) {
    files_.emplace_back(path, std::move(text));
}

std::ostream& OutputFiles::open(const std::string& path) {
    if (path == "-") throw InputError("this output needs a file", {path});
    if (fs::is_directory(path)) throw InputError("is a folder, not a file", {path});
    // A device or a pipe takes the text itself: a renamed file would replace it.
    const bool special = fs::exists(path) && !fs::is_regular_file(path);
    const std::string part = special ? path : path + ".part";
    growing_.push_back(
        std::make_unique<Growing>(Growing{path, part, std::ofstream(part, std::ios::binary)}));
    if (!growing_.back()->out) throw InputError("cannot be written", {path});
    return growing_.back()->out;
}

void OutputFiles::write() {
    for (const auto& [path, text] : files_) {
        if (path == "-")
            std::fwrite(text.data(), 1, text.size(), stdout);
        else
            open(path) << text;
    }
    for (const auto& file : growing_) {
        file->out.close();
        if (!file->out) throw InputError("cannot be written", {file->path});
    }
    for (const auto& file : growing_) fs::rename(file->part, file->path);
    growing_.clear();
    files_.clear();
}

void print_notes(const std::vector<std::string>& notes) {
    for (const std::string& note : notes) fmt::print(stderr, "{}\n", printable(note));
}

}  // namespace trunnion
