#include "imports/iso_columns.h"

#include <algorithm>
#include <initializer_list>
#include <map>

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

/// What a word of a column's name says about the source of its numbers.
enum class Source : unsigned char {
    unknown,
    neutral,
    target,
    deviation,
    instrument,  ///< a reference: a laser, a gauge
    measured,    ///< by whatever
    own          ///< a sensor of the axis itself
};

const std::map<std::string, Source>& sources() {
    static const std::map<std::string, Source> words = [] {
        std::map<std::string, Source> all;
        const auto put = [&](Source source, std::initializer_list<const char*> list) {
            for (const char* word : list) all[word] = source;
        };
        put(Source::neutral,
            {"x",   "y",        "z",       "a",        "b",     "c",     "minus",  "to",
             "and", "position", "pos",     "angle",    "value", "reads", "signal", "reading",
             "of",  "winkel",   "channel", "readings", "in",    "from",  "at",     "axis"});
        put(Source::target, {"target", "tgt", "nominal", "nom", "soll", "sollwert", "commanded",
                             "command", "cmd", "setpoint", "ziel"});
        put(Source::deviation, {"deviation", "dev", "error", "err", "diff", "dif", "difference",
                                "delta", "abweichung", "fehler", "differenz"});
        put(Source::instrument, {"reference", "ref", "referenz", "laser", "interferometer",
                                 "autocollimator", "collimator", "gauge", "tracker"});
        put(Source::measured, {"measured", "meas", "actual", "act", "ist", "istwert", "messwert",
                               "observed", "gemessen"});
        put(Source::own, {"motor", "encoder", "enc", "resolver", "openloop", "loop", "drive",
                          "servo", "counter", "steps"});
        return all;
    }();
    return words;
}

std::vector<Source> sources_in(const TextColumn& column) {
    std::vector<Source> list;
    for (const std::string& word : words_of(without_index(column.name))) {
        const auto it = sources().find(word);
        list.push_back(it == sources().end() ? Source::unknown : it->second);
    }
    return list;
}

/// By the words of the name, with an axis in it or without: "Soll-Pos.", "X target".
bool has_role(const TextColumn& column, Role wanted) {
    for (const char* axis : {"", " x"}) {
        const auto role = role_of(without_index(column.name) + axis);
        if (role && role->role == wanted && role->rate == Rate::position) return true;
    }
    return false;
}

/// "Diff ref-tgt" is a deviation, "tgt-ref" the same with the other sign. "Soll-Ist-Abweichung"
/// is a compound word.
bool subtracts(const TextColumn& column) {
    const std::vector<std::string> words = words_of(column.name);
    return column.name.find('-') != std::string::npos ||
           std::find(words.begin(), words.end(), "minus") != words.end();
}

bool is_read(Source source) {
    return source == Source::instrument || source == Source::measured || source == Source::own;
}

/// The source of a column of values; `target` for one that is none.
Source source_of(const TextColumn& column) {
    const std::vector<Source> list = sources_in(column);
    const auto at = [&](Source s) { return std::find(list.begin(), list.end(), s); };
    const auto has = [&](Source s) { return at(s) != list.end(); };
    if (has(Source::own) && !has(Source::unknown)) return Source::own;
    if (has(Source::unknown) || list.empty())
        return has_role(column, Role::error)    ? Source::deviation
               : has_role(column, Role::actual) ? Source::measured
                                                : Source::unknown;
    const auto read = std::find_if(list.begin(), list.end(), is_read);
    const auto target = at(Source::target), deviation = at(Source::deviation);
    const bool difference = subtracts(column) && read != list.end() && target != list.end();
    if (difference && target < read && target < deviation && deviation != list.end())
        return Source::deviation;
    if (difference) return target < read ? Source::target : Source::deviation;
    if (has(Source::deviation)) return Source::deviation;
    if (has(Source::target)) return Source::target;
    return has(Source::instrument) ? Source::instrument
           : has(Source::measured) ? Source::measured
                                   : Source::unknown;
}

/// A column of values by its very name, or by the source that its words tell.
struct ValueName {
    Names names;
    Source source = Source::unknown;
};

/// The words of docs/readings.md come before those of other programs, deviations and instruments
/// before the sensors of the axis itself.
const std::vector<ValueName>& value_names() {
    static const std::vector<ValueName> lists{
        {{"deviation", "error"}},
        {{"value"}},
        {{"abweichung", "fehler", "dev", "err", "positionerror", "positioningerror",
          "positiondeviation", "delta", "diff", "difference", "abw", "deviations", "angularerror",
          "straightness", "pitch", "yaw", "roll"}},
        {{}, Source::deviation},
        {{"laser", "laserreading", "laserposition", "interferometer", "reference", "ref",
          "referenceposition", "refpos", "referenceangle"}},
        {{}, Source::instrument},
        {{"measured", "actual", "ist", "istposition", "istwert", "messwert", "reading",
          "measuredposition", "actualposition", "measuredangle", "actualangle"}},
        {{}, Source::measured},
        {{"encoder", "resolver"}},
        {{}, Source::own},
        {{"data", "position", "pos"}}};
    return lists;
}

bool is_named(const TextColumn& column, const ValueName& wanted) {
    if (wanted.source != Source::unknown) return source_of(column) == wanted.source;
    return std::find(wanted.names.begin(), wanted.names.end(), plain_name(column.name)) !=
           wanted.names.end();
}

Columns columns_named(const TextTable& table, const ValueName& wanted, const Columns& except) {
    Columns found;
    for (std::size_t k = 0; k < table.columns().size(); ++k)
        if (!contains(except, k) && is_named(table.columns()[k], wanted)) found.push_back(k);
    return found;
}

}  // namespace

std::optional<std::size_t> target_column(const TextTable& table) {
    const auto named = find_first_column(
        table, {{"target", "targetposition", "targetpos", "tgt", "tgtpos", "ziel", "zielposition",
                 "zielpos"},
                {"nominal", "nominalposition", "soll", "sollposition", "sollwert", "nominalangle"},
                {"commanded", "command", "cmd", "commandedposition", "setpoint"},
                {"reference", "referenceangle", "ref"},
                {"position", "pos", "positionmm", "angle", "winkel"},
                {"pi", "p"},  // ISO 230-2: target position P_i
                {"x", "y", "z", "a", "b", "c"}});
    if (named) return named;
    for (std::size_t k = 0; k < table.columns().size(); ++k)
        if (has_role_of_target(table.columns()[k])) return k;
    return std::nullopt;
}

bool has_role_of_target(const TextColumn& column) {
    return has_role(column, Role::commanded) && source_of(column) != Source::deviation;
}

std::optional<std::size_t> find_value_column(const TextTable& table, std::size_t target) {
    Columns alike;  // under names of one meaning: none of them can be taken
    for (const ValueName& name : value_names()) {
        Columns except = alike;
        except.push_back(target);
        const Columns found = columns_named(table, name, except);
        const bool by_words = name.source != Source::unknown;
        if (found.size() == 1 || (by_words && !found.empty())) return found.front();
        alike.insert(alike.end(), found.begin(), found.end());
    }
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

bool may_be_value(const TextColumn& column) {
    return may_be_no_direction(column.name) ||
           std::any_of(value_names().begin(), value_names().end(),
                       [&](const ValueName& name) { return is_named(column, name); });
}

bool may_be_no_direction(const std::string& name) {
    const std::string plain = plain_name(name);
    return plain == "r" || plain == "f" || plain == "pos";
}

}  // namespace trunnion::imports
