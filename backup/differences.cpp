#include "backup/differences.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "backup/folder_files.h"
#include "backup/parameter_names.h"
#include "backup/program_differences.h"
#include "backup/value_text.h"
#include "base/read_file.h"

namespace trunnion::backup {

namespace {

using Key = std::pair<std::string, std::string>;  ///< file, name

std::map<Key, BackupValue> named_values(const ControlBackup& backup) {
    std::vector<BackupValue> values = list_values(backup);
    name_axes(values);
    std::map<Key, BackupValue> out;
    for (BackupValue& v : values) out[{v.file, v.name}] = std::move(v);
    return out;
}

/// Names assigned by SETVN: `SETVN500[PIVOT,,TOP]`.
std::map<int, std::string> variable_names(const ControlBackup& backup) {
    std::map<int, std::string> out;
    const auto found = backup.files.find("MACRO.TXT");
    if (found == backup.files.end()) return out;
    for (const ProgramLine& each : lines_of(found->second)) {
        const std::string& line = each.key;
        if (!line.starts_with("SETVN")) continue;
        int number = std::atoi(line.c_str() + 5);
        std::string name;
        for (std::size_t i = std::min(line.find('['), line.size() - 1) + 1; i < line.size(); ++i) {
            if (line[i] != ',' && line[i] != ']') {
                name += line[i];
                continue;
            }
            if (!name.empty()) out[number] = name;
            ++number;
            name.clear();
        }
    }
    return out;
}

/// Merges both sorted maps; `differ` compares the values of equal keys.
template <class Map, class Differ, class Add>
void walk(const Map& a, const Map& b, const Differ& differ, const Add& add) {
    for (const auto& [key, value] : a) {
        const auto other = b.find(key);
        if (other == b.end())
            add(key, &value, nullptr);
        else if (differ(value, other->second))
            add(key, &value, &other->second);
    }
    for (const auto& [key, value] : b)
        if (!a.contains(key)) add(key, nullptr, &value);
}

void add_values(const ControlBackup& a, const ControlBackup& b,
                std::vector<BackupDifference>& out) {
    std::map<int, std::string> names = variable_names(b);
    names.merge(variable_names(a));
    walk(
        named_values(a), named_values(b),
        [](const BackupValue& x, const BackupValue& y) {
            return !same_value(stored_value(x), stored_value(y));
        },
        [&](const Key& key, const BackupValue* x, const BackupValue* y) {
            const BackupValue& any = x ? *x : *y;
            std::string meaning;
            if (any.kind == BackupValue::Kind::parameter) meaning = name_of_parameter(any.number);
            if (any.kind == BackupValue::Kind::variable && names.contains(any.number))
                meaning = names.at(any.number);
            out.push_back(
                {key.first, key.second, x ? x->text : "", y ? y->text : "", std::move(meaning)});
        });
}

void add_names(const ControlBackup& a, const ControlBackup& b, std::vector<BackupDifference>& out) {
    walk(variable_names(a), variable_names(b), std::not_equal_to<std::string>(),
         [&](int number, const std::string* x, const std::string* y) {
             out.push_back({"MACRO.TXT", fmt::format("#{} name", number), x ? *x : "", y ? *y : "",
                            "name by SETVN"});
         });
}

void add_programs(const ControlBackup& a, const ControlBackup& b,
                  std::vector<BackupDifference>& out) {
    using Lines = std::vector<ProgramLine>;
    walk(programs_of(a), programs_of(b), std::not_equal_to<Lines>(),
         [&](const ProgramKey& key, const Lines* x, const Lines* y) {
             const auto size = [](const Lines* lines) {
                 return lines ? fmt::format("{} lines", lines->size()) : std::string();
             };
             out.push_back({key.first, key.second, size(x), size(y),
                            x && y ? "program: " + line_difference(*x, *y) : "program"});
         });
}

/// Lists of the control and files that are only copied: nothing in them has a name.
std::map<std::string, std::string> nameless_files(const ControlBackup& backup) {
    std::map<std::string, std::string> out;
    for (const auto& [name, bytes] : backup.files)
        if (standing_of_file(name) == Standing::known && !name.starts_with("ALL-"))
            out[name] = bytes;
    for (const std::string& path : other_files(backup))
        out[path] = read_file(backup.folder + "/" + path);
    return out;
}

void add_other_files(const ControlBackup& a, const ControlBackup& b,
                     std::vector<BackupDifference>& out) {
    walk(nameless_files(a), nameless_files(b), std::not_equal_to<std::string>(),
         [&](const std::string& name, const std::string* x, const std::string* y) {
             const auto size = [](const std::string* bytes) {
                 return bytes ? fmt::format("{} bytes", bytes->size()) : std::string();
             };
             std::string meaning = kind_of_file(name, x ? *x : *y);
             if (x && y && meaning != "binary")
                 meaning += ": " + line_difference(lines_of(*x), lines_of(*y));
             else if (x && y)
                 meaning +=
                     fmt::format(": first at byte {}",
                                 std::mismatch(x->begin(), x->end(), y->begin(), y->end()).first -
                                     x->begin() + 1);
             out.push_back({name, "", size(x), size(y), std::move(meaning)});
         });
}

}  // namespace

void name_axes(std::vector<BackupValue>& values) {
    std::map<int, char> letters;
    for (const BackupValue& v : values)
        if (v.for_axis && v.number == 1020)
            if (const double code = stored_value(v); code >= 'A' && code <= 'Z')
                letters[v.sub] = static_cast<char>(code);
    for (BackupValue& v : values)
        if (const auto letter = letters.find(v.sub); v.for_axis && letter != letters.end())
            v.name = fmt::format("{} {}", v.number, letter->second);
}

std::vector<BackupDifference> diff_backups(const ControlBackup& a, const ControlBackup& b) {
    std::vector<BackupDifference> out;
    add_values(a, b, out);
    add_names(a, b, out);
    add_programs(a, b, out);
    add_other_files(a, b, out);
    return out;
}

}  // namespace trunnion::backup
