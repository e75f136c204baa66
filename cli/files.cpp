#include "cli/files.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "geometry/alarm.h"

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

void OutputFiles::add(const std::string& path, std::string text) {
    files_.emplace_back(path, std::move(text));
}

void OutputFiles::write() {
    std::vector<std::pair<fs::path, fs::path>> written;
    for (const auto& [path, text] : files_) {
        if (path == "-") {
            std::fwrite(text.data(), 1, text.size(), stdout);
            continue;
        }
        const fs::path part = path + ".part";
        std::ofstream out(part, std::ios::binary);
        out << text;
        out.close();
        if (!out) {
            for (const auto& pair : written) fs::remove(pair.first);
            fs::remove(part);
            throw InputError("cannot be written", {path});
        }
        written.emplace_back(part, path);
    }
    for (const auto& [part, path] : written) fs::rename(part, path);
    files_.clear();
}

void print_notes(const std::vector<std::string>& notes) {
    for (const std::string& note : notes) fmt::print(stderr, "{}\n", note);
}

}  // namespace trunnion
