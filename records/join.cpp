// Joins several tables of readings.
#include <algorithm>
#include <set>

#include "records/readings.h"
#include "records/same_readings.h"

namespace trunnion::records {
namespace {

constexpr double pause_s = 60.0;  ///< between two tables whose clocks both started at zero

bool has_spheres(const ReadingTable& table) {
    return std::any_of(table.rows.begin(), table.rows.end(),
                       [](const Reading& row) { return row.device == Device::sphere; });
}

std::string touches_of(const ReadingTable& table) {
    const auto it = table.comment.find("touches");
    return it == table.comment.end() ? "" : it->second;
}

void refuse_unlike(const ReadingTable& first, const ReadingTable& next) {
    const auto sorted = [](std::vector<Axis> axes) {
        std::sort(axes.begin(), axes.end());
        return axes;
    };
    if (sorted(first.axes) != sorted(next.axes))
        throw InputError("other axes than " + first.path + ": readings of another machine?",
                         {next.path, 0, 0});
    if (has_spheres(first) && has_spheres(next) && touches_of(first) != touches_of(next))
        throw InputError("another '# touches' than " + first.path, {next.path, 0, 0});
}

/// Head lines `declared ..` of both tables must agree.
void join_declared(ReadingTable& to, const ReadingTable& from) {
    for (const auto& [key, digest] : from.comment) {
        if (!key.starts_with(declared_key)) continue;
        if (to.comment.try_emplace(key, digest).first->second != digest)
            throw InputError("imported with another declared geometry (" +
                                 key.substr(std::string_view(declared_key).size()) + ") than " +
                                 to.path + ": import both with one setup",
                             {from.path, 0, 0});
    }
}

/// A name not used by an earlier table: "map", "map_2", ...
std::string free_name(const std::string& name, const std::set<std::string>& taken) {
    std::string candidate = name;
    for (int k = 2; taken.contains(candidate); ++k) candidate = name + '_' + std::to_string(k);
    return candidate;
}

void append(ReadingTable& to, ReadingTable from) {
    std::set<std::string> taken;
    for (const Reading& row : to.rows) taken.insert(row.test);
    const double end_s = to.rows.back().time_s, begin_s = from.rows.front().time_s;
    const double later_s = begin_s < end_s ? end_s + pause_s - begin_s : 0.0;
    for (Reading& row : from.rows) {
        row.time_s += later_s;
        row.test = free_name(row.test, taken);
        row.part = static_cast<int>(to.parts.size());
        row.index = static_cast<int>(to.rows.size());
        to.rows.push_back(std::move(row));
    }
    to.part_sides[static_cast<int>(to.parts.size())] = from.side_before;
    for (std::string& column : from.optional_columns)
        if (std::find(to.optional_columns.begin(), to.optional_columns.end(), column) ==
            to.optional_columns.end())
            to.optional_columns.push_back(std::move(column));
    if (!has_times(from)) to.comment[times_key] = invented;
    if (!touches_of(from).empty()) to.comment["touches"] = touches_of(from);
    join_declared(to, from);
    to.parts.push_back(from.path);
}

}  // namespace

ReadingTable join_readings(std::vector<ReadingTable> tables) {
    ReadingTable joined = std::move(tables.front());
    if (tables.size() == 1) return joined;
    joined.parts = {joined.path};
    for (std::size_t k = 1; k < tables.size(); ++k) {
        refuse_unlike(joined, tables[k]);
        refuse_same_readings(joined, tables[k]);
        append(joined, std::move(tables[k]));
    }
    return joined;
}

SourceRef place_of(const ReadingTable& table, const Reading& row) {
    const bool joined = static_cast<std::size_t>(row.part) < table.parts.size();
    return {joined ? table.parts[static_cast<std::size_t>(row.part)] : table.path, row.line, 0};
}

}  // namespace trunnion::records
