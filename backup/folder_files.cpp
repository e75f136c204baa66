#include "backup/folder_files.h"

#include <algorithm>
#include <filesystem>

#include "base/alarm.h"

namespace trunnion::backup {

namespace {

namespace fs = std::filesystem;

struct FileRow {
    const char* name;
    Standing standing;
    const char* kind;
};
constexpr FileRow file_rows[] = {
    {"CNC-PARA.TXT", Standing::obeyed, "parameters"},
    {"EXT_WKZ.TXT", Standing::obeyed, "work offsets"},
    {"TOOLOFST.TXT", Standing::obeyed, "tool offsets"},
    {"MACRO.TXT", Standing::obeyed, "macro variables"},
    {"PITCH.TXT", Standing::obeyed, "pitch error data"},
    {"ALL-FLDR.TXT", Standing::known, "programs"},
    {"ALL-PROG.TXT", Standing::known, "programs"},
    {"TOOLLIFE.TXT", Standing::known, "tool life"},
    {"TOOLSIZE.TXT", Standing::known, "tool sizes"},
    {"SYS-CONF.TXT", Standing::known, "system configuration"},
    {"OPRT_HIS.TXT", Standing::known, "operation history"},
};

const FileRow* find_row(const std::string& name) {
    const auto row = std::find_if(std::begin(file_rows), std::end(file_rows),
                                  [&](const FileRow& r) { return name == r.name; });
    return row == std::end(file_rows) ? nullptr : row;
}

/// No control writes these bytes in a text: tab, line ends, DC1 to DC4 and ^Z it does.
bool is_binary(std::string_view bytes) {
    return std::any_of(bytes.begin(), bytes.end(), [](char c) {
        const bool text =
            c == '\t' || c == '\n' || c == '\r' || (c >= '\x11' && c <= '\x14') || c == '\x1a';
        return static_cast<unsigned char>(c) < ' ' && !text;
    });
}

}  // namespace

Standing standing_of_file(const std::string& name) {
    const FileRow* row = find_row(name);
    return row ? row->standing : Standing::ignored;
}

std::string kind_of_file(const std::string& name, std::string_view bytes) {
    if (const FileRow* row = find_row(name)) return row->kind;
    return is_binary(bytes) ? "binary" : "text";
}

std::vector<std::string> other_files(const ControlBackup& backup) {
    std::vector<std::string> out;
    if (!fs::is_directory(backup.folder)) return out;
    try {
        for (const auto& entry : fs::recursive_directory_iterator(backup.folder)) {
            const std::string path = entry.path().lexically_relative(backup.folder).string();
            const bool read = std::any_of(backup.names.begin(), backup.names.end(),
                                          [&](const auto& name) { return name.second == path; });
            if (!read && entry.is_regular_file()) out.push_back(path);
        }
    } catch (const fs::filesystem_error& e) {
        throw InputError("cannot be read: " + e.code().message(), {e.path1().string()});
    }
    std::sort(out.begin(), out.end());
    return out;
}

}  // namespace trunnion::backup
