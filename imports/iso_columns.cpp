#include "imports/iso_columns.h"

#include <algorithm>

#include "base/alarm.h"
#include "imports/column_roles.h"
#include "imports/columns.h"

namespace trunnion::imports {
namespace {

using Names = std::vector<std::string>;
using Columns = std::vector<std::size_t>;

bool contains(const Columns& list, std::size_t column) {
    return std::find(list.begin(), list.end(), column) != list.end();
}

/// By the words of the name, with an axis in it or without: "Soll-Pos.", "X target".
bool has_role(const TextColumn& column, Role wanted) {
    for (const char* axis : {"", " x"}) {
        const auto role = role_of(column.name + axis);
        if (role && role->role == wanted && role->rate == Rate::position) return true;
    }
    return false;
}

/// The first column of this role that is none of `except`.
std::optional<std::size_t> column_of_role(const TextTable& table, Role wanted,
                                          const Columns& except) {
    for (std::size_t k = 0; k < table.columns().size(); ++k)
        if (!contains(except, k) && has_role(table.columns()[k], wanted)) return k;
    return std::nullopt;
}

/// Names of a column of values: the words of docs/readings.md before those of other programs.
const std::vector<Names>& value_names() {
    static const std::vector<Names> lists{
        {"deviation", "error"},
        {"value"},
        {"abweichung", "fehler", "dev", "err", "positionerror", "positioningerror",
         "positiondeviation", "delta", "diff", "difference", "abw", "deviations", "angularerror",
         "straightness", "pitch", "yaw", "roll"},
        {"measured", "actual", "ist", "istposition", "istwert", "messwert", "reading",
         "measuredposition", "actualposition", "laser", "laserreading", "laserposition",
         "interferometer", "encoder", "resolver", "measuredangle", "actualangle"},
        {"data", "position", "pos"}};
    return lists;
}

bool is_one_of(const TextColumn& column, const Names& names) {
    return std::find(names.begin(), names.end(), plain_name(column.name)) != names.end();
}

Columns columns_named(const TextTable& table, const Names& names, std::size_t target) {
    Columns found;
    for (std::size_t k = 0; k < table.columns().size(); ++k)
        if (k != target && is_one_of(table.columns()[k], names)) found.push_back(k);
    return found;
}

bool may_be_value(const TextColumn& column) {
    return may_be_no_direction(column.name) || has_role(column, Role::error) ||
           has_role(column, Role::actual) ||
           std::any_of(value_names().begin(), value_names().end(),
                       [&](const Names& names) { return is_one_of(column, names); });
}

}  // namespace

std::optional<std::size_t> target_column(const TextTable& table) {
    const auto named = find_first_column(
        table, {{"target", "targetposition", "targetpos", "tgt", "tgtpos", "tgtposi", "tgtposij",
                 "ziel", "zielposition", "zielpos"},
                {"nominal", "nominalposition", "soll", "sollposition", "sollwert", "nominalangle"},
                {"commanded", "command", "cmd", "commandedposition", "setpoint", "reference",
                 "referenceangle", "ref"},
                {"position", "pos", "positionmm", "angle", "winkel"},
                {"x", "y", "z", "a", "b", "c"}});
    return named ? named : column_of_role(table, Role::commanded, {});
}

std::optional<std::size_t> find_value_column(const TextTable& table, std::size_t target) {
    Columns alike;  // under names of one meaning: none of them can be taken
    for (const Names& names : value_names()) {
        const Columns found = columns_named(table, names, target);
        if (found.size() == 1) return found.front();
        alike.insert(alike.end(), found.begin(), found.end());
    }
    Columns except = alike;
    except.push_back(target);
    for (const Role role : {Role::error, Role::actual})
        if (const auto found = column_of_role(table, role, except)) return found;
    if (alike.empty()) return std::nullopt;
    const TextColumn &one = table.columns()[alike[0]], &other = table.columns()[alike[1]];
    table.header_line().fail("'" + one.name + "' and '" + other.name +
                                 "' could both be the value: --with columns= names it 'value'",
                             other.column);
}

void note_other_values(const TextTable& table, std::size_t target, std::size_t value,
                       std::vector<std::string>& notes) {
    std::string others;
    for (std::size_t k = 0; k < table.columns().size(); ++k) {
        const TextColumn& column = table.columns()[k];
        if (k != target && k != value && may_be_value(column))
            others += (others.empty() ? "'" : ", '") + column.name + '\'';
    }
    if (!others.empty())
        notes.push_back(table.path() + ": '" + table.columns()[value].name +
                        "' taken as the value, not " + others);
}

bool may_be_no_direction(const std::string& name) {
    const std::string plain = plain_name(name);
    return plain == "r" || plain == "f" || plain == "pos";
}

}  // namespace trunnion::imports
