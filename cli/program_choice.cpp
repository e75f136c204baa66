#include "cli/program_choice.h"

#include <algorithm>
#include <filesystem>

#include "base/alarm.h"
#include "base/numbers.h"
#include "cli/files.h"

namespace trunnion {
namespace fs = std::filesystem;
namespace {

/// programs/ and the folders in it; none when nothing is installed.
void add_shipped(std::vector<std::string>& folders) try {
    const std::string root = shipped("programs");
    std::vector<std::string> inner{root};
    for (const auto& entry : fs::directory_iterator(root))
        if (entry.is_directory()) inner.push_back(entry.path().string());
    std::sort(inner.begin(), inner.end());
    folders.insert(folders.end(), inner.begin(), inner.end());
} catch (const InputError&) {
}

std::optional<int> o_number(const std::string& name) {
    const bool letter = !name.empty() && (name[0] == 'O' || name[0] == 'o');
    const std::string digits = letter ? name.substr(1) : name;
    if (digits.empty() || digits.find_first_not_of("0123456789") != std::string::npos ||
        digits.size() > 9)
        return std::nullopt;
    return std::stoi(digits);
}

}  // namespace

ProgramAndFolders open_program(const std::string& name, std::vector<std::string> folders) {
    std::error_code unknown;
    const fs::file_status found = fs::status(name, unknown);
    const bool is_file = name == "-" || (fs::exists(found) && !fs::is_directory(found));
    if (is_file) {
        const std::string own = fs::path(name).parent_path().string();
        folders.push_back(own.empty() ? "." : own);
    }
    add_shipped(folders);
    ProgramFolders source(folders);
    if (is_file) {
        const ProgramText text = read_main_program(name);
        source.add_file(text);
        return {text, std::move(source)};
    }
    const auto number = o_number(name);
    if (!number) throw InputError("no such program, or it cannot be read", {name, 0, 0});
    if (!source.find(*number))
        throw InputError("O number not found in the program folders", {name, 0, 0});
    return {*number, std::move(source)};
}

}  // namespace trunnion
