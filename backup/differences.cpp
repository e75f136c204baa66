#include "backup/differences.h"

#include <fmt/format.h>

#include <algorithm>

#include "backup/parameter_names.h"
#include "backup/value_lines.h"

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

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> out;
    std::string line;
    for (const char c : text + '\n') {
        if (c != '\n' && c != '\r') {
            line += c;
            continue;
        }
        line.erase(
            std::remove_if(line.begin(), line.end(), [](char b) { return b == ' ' || b == '\t'; }),
            line.end());
        if (!line.empty() && line != "%") out.push_back(line);
        line.clear();
    }
    return out;
}

/// "O9810", "<NAME>", preceded by the folder; empty for a line that starts no program.
std::string program_name(const std::string& line) {
    if (line[0] == 'O') return line.substr(0, line.find_first_not_of("0123456789", 1));
    return line[0] == '<' ? line.substr(0, line.find('>') + 1) : "";
}

/// Lines of each program of ALL-PROG.TXT and ALL-FLDR.TXT.
std::map<Key, std::vector<std::string>> programs_of(const ControlBackup& backup) {
    std::map<Key, std::vector<std::string>> out;
    for (const char* const file : {"ALL-PROG.TXT", "ALL-FLDR.TXT"}) {
        const auto found = backup.files.find(file);
        if (found == backup.files.end()) continue;
        std::string folder, name;
        for (const std::string& line : lines_of(found->second)) {
            if (line.starts_with("&F=")) folder = line.substr(3);
            if (const std::string start = program_name(line); !start.empty()) name = folder + start;
            if (!name.empty() && line[0] != '&') out[{file, name}].push_back(line);
        }
    }
    return out;
}

/// Names assigned by SETVN: `SETVN500[PIVOT,,TOP]`.
std::map<int, std::string> variable_names(const ControlBackup& backup) {
    std::map<int, std::string> out;
    const auto found = backup.files.find("MACRO.TXT");
    if (found == backup.files.end()) return out;
    for (const std::string& line : lines_of(found->second)) {
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
    walk(
        programs_of(a), programs_of(b),
        [](const std::vector<std::string>& x, const std::vector<std::string>& y) { return x != y; },
        [&](const Key& key, const std::vector<std::string>* x, const std::vector<std::string>* y) {
            const auto lines = [](const std::vector<std::string>* program) {
                return program ? fmt::format("{} lines", program->size()) : std::string();
            };
            out.push_back({key.first, key.second, lines(x), lines(y), "program"});
        });
    return out;
}

}  // namespace trunnion::backup
