#include "inputs/program_choice.h"

#include <algorithm>
#include <filesystem>

#include "base/alarm.h"
#include "base/numbers.h"
#include "inputs/shipped.h"

namespace trunnion::inputs {
namespace fs = std::filesystem;
namespace {

/// programs/ and its subfolders; empty if nothing is installed.
std::vector<std::string> shipped_folders() try {
    const std::string root = shipped("programs");
    std::vector<std::string> folders{root};
    for (const auto& entry : fs::directory_iterator(root))
        if (entry.is_directory()) folders.push_back(entry.path().string());
    std::sort(folders.begin(), folders.end());
    return folders;
} catch (const InputError&) {
    return {};
}

/// True when the user named one of the shipped folders: their programs are then the user's.
bool share_a_folder(const std::vector<std::string>& folders, const std::vector<std::string>& ours) {
    std::error_code unknown;
    for (const std::string& folder : folders)
        for (const std::string& other : ours)
            if (fs::equivalent(folder, other, unknown)) return true;
    return false;
}

interpreter::ProgramFolders with_shipped(std::vector<std::string> folders) {
    std::vector<std::string> ours = shipped_folders();
    if (share_a_folder(folders, ours)) {
        folders.insert(folders.end(), ours.begin(), ours.end());
        ours.clear();
    }
    return interpreter::ProgramFolders(std::move(folders), std::move(ours));
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

interpreter::ProgramFolders folders_beside(const std::string& path,
                                           std::vector<std::string> folders) {
    const std::string own = fs::path(path).parent_path().string();
    folders.push_back(own.empty() ? "." : own);
    return with_shipped(std::move(folders));
}

interpreter::ProgramFolders folders_of_file(const interpreter::ProgramText& program,
                                            std::vector<std::string> folders) {
    interpreter::ProgramFolders source = folders_beside(program.name, std::move(folders));
    source.add_file(program);
    return source;
}

ProgramAndFolders open_program(const std::string& name, std::vector<std::string> folders) {
    std::error_code unknown;
    const fs::file_status found = fs::status(name, unknown);
    const bool is_file = name == "-" || (fs::exists(found) && !fs::is_directory(found));
    const auto number = o_number(name);
    if (!number && fs::is_directory(found))
        throw InputError("is a folder, not a program", {name, 0, 0});
    if (is_file) {
        const interpreter::ProgramText text = interpreter::read_main_program(name);
        return {text, folders_of_file(text, std::move(folders))};
    }
    if (!number)
        throw InputError(found.type() == fs::file_type::not_found
                             ? "no such program"
                             : "cannot be read: " + unknown.message(),
                         {name, 0, 0});
    interpreter::ProgramFolders source = with_shipped(folders);
    if (!source.holds_own(*number)) {  // called by number: a shipped program may be used
        const std::vector<std::string> ours = shipped_folders();
        folders.insert(folders.end(), ours.begin(), ours.end());
        source = with_shipped(std::move(folders));
    }
    if (!source.holds(*number))
        throw InputError("O number not found in the program folders", {name, 0, 0});
    return {*number, std::move(source)};
}

}  // namespace trunnion::inputs
