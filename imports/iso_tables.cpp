#include "imports/iso_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "base/alarm.h"
#include "imports/columns.h"
#include "imports/headings.h"
#include "imports/iso_columns.h"
#include "imports/iso_points.h"
#include "imports/run_names.h"
#include "imports/side_columns.h"

namespace trunnion::imports {
namespace {

struct Judged {
    const TextTable* table = nullptr;
    bool may_be_read = false;
    bool has_targets = false;
    int results = 0;           ///< result_words() of its headings
    bool single_list = false;  ///< one value a line, without cycles and directions
    bool summed_up = false;    ///< such a list beside means or deviations: "Resolver AVG"
    bool own_sensor = false;   ///< its headings name a sensor of the axis itself
    bool tells_axis = false;   ///< it is read whatever the others are
    bool left_out = false;     ///< for one of these reasons
};

/// "1+", "Run 2 up"; "ref_pos(i,1)" and "run 1" are too, "x_avg 1" is not.
bool is_run(const TextColumn& column) {
    const RunName name = run_name(column.name);
    return !name.other && (name.run > 0 || name.direction != 0) &&
           !may_be_no_direction(column.name);
}

bool only_conditions(const TextTable& table, std::size_t target) {
    const std::vector<TextColumn>& columns = table.columns();
    for (std::size_t k = 0; k < columns.size(); ++k)
        if (k != target && !is_condition(columns[k])) return false;
    return true;
}

template <typename Is>
bool any_column(const TextTable& table, Is is) {
    return std::any_of(table.columns().begin(), table.columns().end(), is);
}

/// A table whose names of targets are not known, but that has runs or deviations of numbers.
bool looks_like_readings(const TextTable& table) {
    std::vector<records::TableCell> cells;
    table.read(0, cells);
    if (!table.find_number(cells.front().text)) return false;
    return any_column(table, [](const TextColumn& column) {
        const std::string name = plain_name(column.name);
        return name == "deviation" || name == "error" ||
               (is_run(column) && run_name(column.name).direction != 0);
    });
}

/// "# Resolver Performance": what the axis reads of itself.
bool names_own_sensor(const TextTable& table) {
    static const std::set<std::string> words{"resolver", "encoder", "openloop", "geber"};
    return std::any_of(table.headings().begin(), table.headings().end(), [](const auto& line) {
        const std::vector<std::string> list = words_of(heading_words(line.text));
        return std::any_of(list.begin(), list.end(),
                           [](const std::string& word) { return words.contains(word); });
    });
}

/// A list without runs, cycles and directions.
bool is_single_list(const TextTable& table) {
    return !any_column(table, is_run) &&
           !find_column(table,
                        {"run", "cycle", "lauf", "zyklus", "repeat", "wiederholung", "series",
                         "jcycle", "direction", "dir", "richtung", "sense", "approach"});
}

/// The axis is told for this table alone, above it or in a column.
bool tells_axis(const TextTable& table) {
    return table.says_itself("axis") || find_column(table, {"axis", "achse", "axisname"});
}

Judged judged(const TextTable& table) {
    const int results = result_words(table.headings());
    try {
        if (targets_across(table)) return {&table, true, true, results};
        const auto target = target_column(table);
        if (!target) return {&table, results == 0 && looks_like_readings(table), false, results};
        const bool value = any_column(table, is_run) || find_value_column(table, *target);
        const bool only_results =
            results > 0 || any_column(table, is_result) || only_conditions(table, *target);
        Judged one{&table, value || !only_results, true, results};
        one.tells_axis = tells_axis(table);
        if (!value) return one;
        one.single_list = is_single_list(table);
        one.summed_up = one.single_list && any_column(table, is_result);
        one.own_sensor = names_own_sensor(table);
        return one;
    } catch (const InputError&) {
        return {&table, results == 0, true, results};  // reading it tells the fault
    }
}

std::string passed_over(const Judged& one) {
    const TextTable& table = *one.table;
    std::string heading;
    if (!table.headings().empty())
        heading = fmt::format(" ('{}')", heading_words(table.headings().front().text));
    const char* why = one.left_out      ? "is no test of the axis as the others of this file are"
                      : one.may_be_read ? "is one of results, by its headings"
                                        : "has no readings of targets";
    return fmt::format("{}: the table of line {}{} {}: passed over", table.path(),
                       table.header_line().number, heading, why);
}

/// Leaves out what differs from the other tables of the file: a list beside tables of cycles, means
/// beside readings, what a sensor of the axis reads beside what an instrument does.
void leave_out_others(std::vector<Judged>& list, int least) {
    const auto is_taken = [&](const Judged& one) {
        return one.may_be_read && one.results <= least && !one.left_out;
    };
    for (const auto differs : {&Judged::single_list, &Judged::summed_up, &Judged::own_sensor}) {
        const bool others = std::any_of(list.begin(), list.end(), [&](const Judged& one) {
            return is_taken(one) && !(one.*differs);
        });
        for (Judged& one : list)
            one.left_out |= others && is_taken(one) && one.*differs && !one.tells_axis;
    }
}

/// Of one file. Its readings are under the headings that speak least of results.
std::vector<const TextTable*> chosen(std::vector<Judged> list, std::vector<std::string>& notes) {
    int least = 2;
    bool any = false;
    for (const Judged& one : list)
        if (one.may_be_read) {
            any = true;
            least = std::min(least, one.results);
        }
    if (!any) {
        const auto best =
            std::find_if(list.begin(), list.end(), [](const Judged& j) { return j.has_targets; });
        return {(best == list.end() ? list.front() : *best).table};
    }
    leave_out_others(list, least);
    std::vector<const TextTable*> tables;
    for (const Judged& one : list) {
        const bool take = one.may_be_read && one.results <= least && !one.left_out;
        if (take) tables.push_back(one.table);
        if (!take) notes.push_back(passed_over(one));
    }
    return tables;
}

}  // namespace

std::vector<const TextTable*> tables_with_readings(const std::vector<TextTable>& tables,
                                                   std::vector<std::string>& notes) {
    std::vector<const TextTable*> all;
    for (std::size_t k = 0; k < tables.size();) {
        std::vector<Judged> of_file;
        for (const std::string path = tables[k].path(); k < tables.size(); ++k) {
            if (tables[k].path() != path) break;
            of_file.push_back(judged(tables[k]));
        }
        for (const TextTable* table : chosen(std::move(of_file), notes)) all.push_back(table);
    }
    return all;
}

}  // namespace trunnion::imports
