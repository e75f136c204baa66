#include "backup/control_files.h"

#include <algorithm>
#include <filesystem>

#include "backup/value_lines.h"
#include "base/alarm.h"
#include "base/output_files.h"
#include "base/read_file.h"

namespace trunnion::backup {

const std::vector<std::string> backup_file_names{"CNC-PARA.TXT", "EXT_WKZ.TXT", "TOOLOFST.TXT",
                                                 "MACRO.TXT", "PITCH.TXT"};

namespace {

namespace fs = std::filesystem;

struct FileRow {
    const char* name;
    Standing standing;
};
constexpr FileRow file_rows[] = {
    {"CNC-PARA.TXT", Standing::obeyed}, {"EXT_WKZ.TXT", Standing::obeyed},
    {"TOOLOFST.TXT", Standing::obeyed}, {"MACRO.TXT", Standing::obeyed},
    {"PITCH.TXT", Standing::obeyed},    {"ALL-FLDR.TXT", Standing::known},
    {"ALL-PROG.TXT", Standing::known},  {"TOOLLIFE.TXT", Standing::known},
    {"TOOLSIZE.TXT", Standing::known},  {"SYS-CONF.TXT", Standing::known},
    {"OPRT_HIS.TXT", Standing::known},
};

bool has_values(const std::string& name) {
    return std::find(backup_file_names.begin(), backup_file_names.end(), name) !=
           backup_file_names.end();
}

std::string upper(std::string s) {
    for (char& c : s)
        if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
    return s;
}

const BackupValue* find_parameter(const std::vector<BackupValue>& values, int number) {
    for (const BackupValue& v : values)
        if (v.kind == BackupValue::Kind::parameter && v.number == number) return &v;
    return nullptr;
}

void require_pivot(const ControlBackup& backup, const std::vector<BackupValue>& values) {
    const BackupValue* type = find_parameter(values, 19680);
    if (type == nullptr || stored_value(*type) == 0.0) return;
    const bool table = stored_value(*type) != 2.0;
    const int needed = table ? 19700 : 19709;
    for (int n = needed; n < needed + 3; ++n)
        if (find_parameter(values, n) == nullptr)
            throw InputError("19680 names a mechanical type, but parameter " + std::to_string(n) +
                                 " (pivot) is not in the backup",
                             {(fs::path(backup.folder) / type->file).string(), type->line, 1});
}

}  // namespace

const char* text_of(Standing standing) {
    static constexpr const char* texts[] = {"obeyed", "known", "ignored"};
    return texts[static_cast<std::size_t>(standing)];
}

Standing standing_of_file(const std::string& name) {
    for (const FileRow& row : file_rows)
        if (name == row.name) return row.standing;
    return Standing::ignored;
}

ControlBackup read_backup(const std::string& folder) {
    ControlBackup backup;
    backup.folder = folder;
    if (!fs::is_directory(folder)) throw InputError("no such folder", {folder});
    for (const auto& entry : fs::directory_iterator(folder)) {
        const std::string name = upper(entry.path().filename().string());
        if (standing_of_file(name) == Standing::ignored)
            backup.ignored.push_back(entry.path().filename().string());
        else if (entry.is_regular_file())
            backup.files[name] = read_file(entry.path().string());
    }
    std::sort(backup.ignored.begin(), backup.ignored.end());
    if (std::none_of(backup.files.begin(), backup.files.end(),
                     [](const auto& file) { return has_values(file.first); }))
        throw InputError("none of CNC-PARA.TXT, EXT_WKZ.TXT, TOOLOFST.TXT, MACRO.TXT is here",
                         {folder});
    return backup;
}

void write_backup(const ControlBackup& backup, const std::string& folder) {
    OutputFiles files;
    files.add_folder(folder);
    for (const auto& [name, bytes] : backup.files)
        files.add((fs::path(folder) / name).string(), bytes);
    files.write();
}

std::vector<BackupValue> list_values(const ControlBackup& backup) {
    std::vector<BackupValue> values;
    for (const auto& [name, bytes] : backup.files) {
        if (!has_values(name)) continue;
        const std::string path = (fs::path(backup.folder) / name).string();
        for (BackupValue& v : scan_values(name, bytes, path)) values.push_back(std::move(v));
    }
    return values;
}

void apply_backup(const ControlBackup& backup, offsets::Stores& stores) {
    const std::vector<BackupValue> values = list_values(backup);
    require_pivot(backup, values);
    for (const BackupValue& v : values) store_value(v, stores);
}

void update_backup(ControlBackup& backup, const offsets::Stores& stores) {
    std::vector<BackupValue> values = list_values(backup);
    // From the end of each file, so that the positions of earlier values remain valid.
    std::reverse(values.begin(), values.end());
    for (const BackupValue& v : values) {
        const double wanted = value_in(v, stores);
        if (same_value(wanted, stored_value(v))) continue;
        backup.files.at(v.file).replace(v.begin, v.size, format_value(v, wanted));
    }
}

}  // namespace trunnion::backup
