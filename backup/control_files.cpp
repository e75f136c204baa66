#include "backup/control_files.h"

#include <algorithm>
#include <filesystem>

#include "backup/folder_files.h"
#include "backup/value_lines.h"
#include "backup/value_text.h"
#include "base/alarm.h"
#include "base/read_file.h"
#include "offsets/whole_parameter.h"

namespace trunnion::backup {

const std::vector<std::string> backup_file_names{"CNC-PARA.TXT", "EXT_WKZ.TXT", "TOOLOFST.TXT",
                                                 "MACRO.TXT", "PITCH.TXT"};

namespace {

namespace fs = std::filesystem;

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

/// 0000#2: the unit of the offsets in the files.
bool is_inch(double bits_of_0) {
    return (offsets::bits_of_parameter(bits_of_0) & 4U) != 0;
}

void require_same_units(const std::vector<BackupValue>& values, const offsets::Stores& stores) {
    const BackupValue* units = find_parameter(values, 0);
    if (units != nullptr && is_inch(stored_value(*units)) != is_inch(value_in(*units, stores)))
        throw InputError(
            "0000#2 (inch) differs from the setup: the offsets would change their unit",
            {units->file, units->line, 1});
}

}  // namespace

const char* text_of(Standing standing) {
    static constexpr const char* texts[] = {"obeyed", "known", "ignored"};
    return texts[static_cast<std::size_t>(standing)];
}

ControlBackup read_backup(const std::string& folder) {
    ControlBackup backup;
    backup.folder = folder;
    if (!fs::is_directory(folder))
        throw InputError(fs::exists(folder) ? "is a file, not a folder" : "no such folder",
                         {folder});
    for (const auto& entry : fs::directory_iterator(folder)) {
        const std::string on_disk = entry.path().filename().string(), name = upper(on_disk);
        if (standing_of_file(name) == Standing::ignored || !entry.is_regular_file()) continue;
        if (backup.names.contains(name))
            throw InputError("this folder holds both " + backup.names[name] + " and " + on_disk,
                             {folder});
        backup.names[name] = on_disk;
        backup.files[name] = read_file(entry.path().string());
    }
    if (std::none_of(backup.files.begin(), backup.files.end(),
                     [](const auto& file) { return has_values(file.first); }))
        throw InputError("none of CNC-PARA.TXT, EXT_WKZ.TXT, TOOLOFST.TXT, MACRO.TXT is here",
                         {folder});
    return backup;
}

void add_backup_files(const ControlBackup& backup, const std::string& folder, OutputFiles& files) {
    const std::vector<std::string> others = other_files(backup);
    // Of a relative path whose first part does not exist, weakly_canonical gives a relative path.
    const fs::path from = fs::weakly_canonical(fs::absolute(backup.folder)),
                   to = fs::weakly_canonical(fs::absolute(folder));
    const std::string inside = to.lexically_relative(from).string();
    if (fs::is_directory(from) && !inside.starts_with(".."))
        throw InputError("this folder is inside the backup, which is copied whole", {folder});
    files.add_folder(folder);
    for (const auto& [name, bytes] : backup.files) {
        const auto on_disk = backup.names.find(name);
        files.add((to / (on_disk == backup.names.end() ? name : on_disk->second)).string(), bytes);
    }
    for (const std::string& path : others) {
        files.add_folder((to / path).parent_path().string());
        files.open((to / path).string()).append(read_file((from / path).string()));
    }
}

std::vector<BackupValue> list_values(const ControlBackup& backup) {
    std::vector<BackupValue> values;
    bool inch = false;  // 0000#2; CNC-PARA.TXT comes first
    for (const std::string& name : backup_file_names) {
        const auto file = backup.files.find(name);
        if (file == backup.files.end()) continue;
        const std::string path = (fs::path(backup.folder) / name).string();
        for (BackupValue& v : scan_values({name, path, inch}, file->second))
            values.push_back(std::move(v));
        if (const BackupValue* units = find_parameter(values, 0))
            inch = is_inch(stored_value(*units));
    }
    return values;
}

void apply_backup(const ControlBackup& backup, offsets::Stores& stores) {
    const std::vector<BackupValue> values = list_values(backup);
    require_pivot(backup, values);
    for (const BackupValue& v : values) store_value(v, stores);
}

std::map<std::string, int> update_backup(ControlBackup& backup, const offsets::Stores& stores) {
    std::vector<BackupValue> values = list_values(backup);
    // A value stands for a change only where the store holds another one than the whole backup
    // gives: of a number that is written twice, the first text differs from the store by itself.
    offsets::Stores loaded = stores;
    for (const BackupValue& v : values) store_value(v, loaded);
    require_same_units(values, stores);
    std::map<std::string, int> changed;
    // From the end of each file, so that the positions of earlier values remain valid.
    std::reverse(values.begin(), values.end());
    for (const BackupValue& v : values) {
        const double wanted = value_in(v, stores);
        if (same_value(wanted, value_in(v, loaded)) || same_value(wanted, stored_value(v)))
            continue;
        backup.files.at(v.file).replace(v.begin, v.size, format_value(v, wanted));
        ++changed[v.file];
    }
    return changed;
}

}  // namespace trunnion::backup
