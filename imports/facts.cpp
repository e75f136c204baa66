#include "imports/facts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>
#include <string_view>

#include "base/alarm.h"
#include "base/numbers.h"
#include "base/units.h"
#include "imports/columns.h"
#include "imports/times.h"

namespace trunnion::imports {
namespace {

constexpr std::size_t none = std::string_view::npos;
constexpr std::string_view axis_letters = "XYZABCUVW";

const std::set<std::string>& known_keys() {
    static const std::set<std::string> keys{
        "axis",  "unit",   "feature", "test",      "session", "instrument", "step_s",   "at",
        "feed",  "plane",  "sense",   "start_deg", "end_deg", "sign",       "position", "zone",
        "sigma", "values", "columns", "along",     "about",   "radius",     "diameter"};
    return keys;
}

/// Other names of a key in the head lines of measuring software.
const std::map<std::string, std::string>& other_words() {
    static const std::map<std::string, std::string> words{{"feedrate", "feed"},
                                                          {"feed rate", "feed"},
                                                          {"feed_mm_min", "feed"},
                                                          {"programmed feed", "feed"},
                                                          {"test feed", "feed"},
                                                          {"f", "feed"},
                                                          {"vorschubgeschwindigkeit", "feed"},
                                                          {"testvorschub", "feed"},
                                                          {"vorschub", "feed"},
                                                          {"ebene", "plane"},
                                                          {"achse", "axis"},
                                                          {"axis name", "axis"},
                                                          {"units", "unit"},
                                                          {"einheit", "unit"},
                                                          {"direction", "sense"},
                                                          {"richtung", "sense"},
                                                          {"start angle", "start_deg"},
                                                          {"date", "day"},
                                                          {"datum", "day"},
                                                          {"test date", "day"},
                                                          {"messdatum", "day"}};
    return words;
}

/// "Bar length", "Nominal radius", "Messradius": of a ballbar's circle.
std::string size_of_circle(const std::string& name) {
    static const std::map<std::string, std::string> sizes{
        {"radius", "radius"},        {"messradius", "radius"},
        {"nennradius", "radius"},    {"kreisradius", "radius"},
        {"length", "radius"},        {"laenge", "radius"},
        {"l\xC3\xA4nge", "radius"},  {"nennl\xC3\xA4nge", "radius"},
        {"nennlaenge", "radius"},    {"stabl\xC3\xA4nge", "radius"},
        {"stablaenge", "radius"},    {"diameter", "diameter"},
        {"durchmesser", "diameter"}, {"kreisdurchmesser", "diameter"}};
    static const std::set<std::string> beside{"test",       "nominal", "programmed", "circle",
                                              "calibrated", "nenn",    "kreis",      "path",
                                              "mm",         "of",      "the"};
    static const std::set<std::string> of_bar{"bar", "ballbar", "ball"};
    std::string found;
    bool bar = false;
    for (const std::string& word : words_of(name)) {
        const auto it = sizes.find(word);
        bar |= of_bar.contains(word);
        if (it == sizes.end() && !beside.contains(word) && !of_bar.contains(word)) return "";
        if (it != sizes.end()) found = it->second;
    }
    return bar && found == "diameter" ? "" : found;  // "Ball diameter"
}

std::string upper(std::string text) {
    for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return text;
}

std::string unit_behind(const std::string& text) {
    const std::size_t cut = text.find_first_not_of("+-0123456789., \teE");
    std::string unit = cut == std::string::npos ? "" : text.substr(cut);
    std::erase_if(unit, [](char c) { return std::string_view("[]()").find(c) != none; });
    return std::string(records::without_blanks(unit));
}

std::string_view number_before(const std::string& text) {
    const std::string_view all = text;
    return records::without_blanks(all.substr(0, all.find_first_not_of("+-0123456789., \teE")));
}

/// "X" of "X", "x-axis", "X1".
std::optional<char> axis_letter(const std::string& text) {
    const std::string name = upper(text);
    const bool letter = !name.empty() && axis_letters.find(name[0]) != none;
    const bool ends = name.size() < 2 || std::isalpha(static_cast<unsigned char>(name[1])) == 0;
    return letter && ends ? std::optional(name[0]) : std::nullopt;
}

/// The same fact in other words: "1000" and "1000 mm/min", "X" and "X-axis".
bool alike(const std::string& told, const std::string& said) {
    const std::string one = upper(told), other = upper(said);
    if (one == other) return true;
    const auto letter = axis_letter(told);
    if (letter && letter == axis_letter(said)) return true;
    return other.starts_with(one + ' ');
}

}  // namespace

Facts::Facts(const std::vector<std::string>& told) {
    for (const std::string& text : told) {
        const std::size_t equal = text.find('=');
        if (equal == std::string::npos)
            throw InputError("--with: '" + text + "' does not have the form 'unit=um'");
        const std::string key(records::without_blanks(text.substr(0, equal)));
        if (!known_keys().contains(key)) throw InputError("--with: unknown key '" + key + "'");
        if (has(key)) throw InputError("--with: '" + key + "' is given twice");
        const std::string_view value = std::string_view(text).substr(equal + 1);
        facts_[key] = {std::string(records::without_blanks(value)), {}, "", {}};
        told_.insert(key);
    }
}

Facts::Fact Facts::told_by(const TextTable& table, const TextTable::HeadEntry& entry,
                           const std::string& text) {
    const std::size_t at = entry.line.text.find(entry.value);
    const int column = at == std::string_view::npos ? 1 : static_cast<int>(at) + 1;
    return {text,
            {table.path(), entry.line.number, column},
            std::string(entry.line.text),
            table.dialect()};
}

void Facts::fail(const std::string& key, const std::string& message) const {
    const auto it = facts_.find(key);
    if (it == facts_.end()) throw InputError(message);
    throw InputError((is_told(key) ? "--with: " : "") + message, it->second.where, it->second.line);
}

/// A line above a table that `--with` says otherwise.
void Facts::note_contradiction(const std::string& key, const Fact& fact,
                               std::vector<std::string>& notes) const {
    const std::string told = text(key);
    if (key == "instrument" || key == "test" || key == "session" || alike(told, fact.text)) return;
    const auto one = axis_letter(told), other = axis_letter(fact.text);
    if (key == "axis" && one && other)
        throw InputError("the file says axis " + fact.text + ", --with axis=" + told +
                             ": omit --with axis=, or correct the line",
                         fact.where, fact.line);
    notes.push_back(fmt::format("{}: line {} says {} {}: not used, --with {}={} is",
                                fact.where.program, fact.where.line, key, fact.text, key, told));
}

Facts Facts::with_head_of(const TextTable& table, std::vector<std::string>& notes) const {
    Facts all = *this;
    std::vector<TextTable::HeadEntry> days;
    for (const auto& [word, entry] : table.head()) {
        const TextColumn named = column_named(word, 1);  // "feed [mm/min]"
        const auto other = other_words().find(named.name);
        const std::string size = size_of_circle(named.name);
        const std::string& key = !size.empty()                  ? size
                                 : other == other_words().end() ? named.name
                                                                : other->second;
        if (key == "day" && !is_missing(entry.value)) days.push_back(entry);
        if (!known_keys().contains(key) || key == "columns") continue;
        const bool bare = !named.unit.empty() && unit_behind(entry.value).empty();
        const Fact fact =
            told_by(table, entry, bare ? entry.value + ' ' + named.unit : entry.value);
        if (is_told(key))
            note_contradiction(key, fact, notes);
        else
            all.facts_.emplace(key, fact);
    }
    if (all.has("session")) return all;
    for (const TextTable::HeadEntry& entry : days) {
        const auto day = day_in(entry.value);
        if (!day)
            table.head_line(entry).fail("'" + entry.value +
                                            "' is no date as 2024-03-01 (01/02/2024 is two days); "
                                            "--with session=NAME names the rows instead",
                                        1);
        all.facts_.emplace("session", told_by(table, entry, *day));
    }
    return all;
}

std::string Facts::text(const std::string& key, const std::string& otherwise) const {
    const auto it = facts_.find(key);
    return it == facts_.end() ? otherwise : it->second.text;
}

std::optional<double> Facts::number(const std::string& key, Quantity quantity,
                                    const std::string& usual) const {
    if (!has(key)) return std::nullopt;
    const Fact& fact = facts_.at(key);
    const std::string name = unit_behind(fact.text);
    const auto value = fact.dialect.find_number(number_before(fact.text));
    if (!value)
        fail(key, fmt::format("{}: '{}' is not a finite number{}", key, fact.text,
                              fact.dialect.decimal_comma ? " with a decimal comma" : ""));
    const auto unit = find_unit(name.empty() ? usual : name);
    if (!unit || unit->quantity != quantity)
        fail(key, fmt::format("{}: '{}' is no unit here, as {} is", key, name, usual));
    if (name.empty() || name == usual) return value;
    constexpr double digits = 1e9;  // 40 in/min are 1016 mm/min, not 1016.0000000000001
    return std::round(*value * unit->factor / find_unit(usual)->factor * digits) / digits;
}

std::optional<double> Facts::positive(const std::string& key, Quantity quantity,
                                      const std::string& usual) const {
    const auto value = number(key, quantity, usual);
    if (value && *value <= 0.0) fail(key, key + ": " + text(key) + " is not above 0");
    return value;
}

std::optional<Axis> axis_named(const setup::Setup& setup, const std::string& name) {
    if (name.empty()) return std::nullopt;
    const AxisNames names = setup.machine.chain.names();
    const std::string word = upper(name);
    for (const Axis axis : all_axes)
        if (names.has(axis) && upper(names[axis]) == word) return axis;
    const std::string rest = word.substr(1);
    const bool plain = rest.empty() || rest == "1" || rest == "-AXIS" || rest == " AXIS" ||
                       rest == "_AXIS" || rest == "AXIS" || rest == "-ACHSE";
    if (!plain || !axis_of(word[0])) return std::nullopt;
    return names.find(word.substr(0, 1));
}

bool turns(const setup::Setup& setup, Axis axis) {
    return setup.machine.chain.names().is_rotary(axis);
}

AxisPositions positions_told(const setup::Setup& setup, const std::string& text) {
    AxisPositions at;
    std::string_view left = text;
    while (!(left = records::without_blanks(left)).empty()) {
        const std::size_t end = std::min(left.find_first_of(" ,"), left.size());
        const std::string_view word = left.substr(0, end);
        left.remove_prefix(std::min(end + 1, left.size()));
        const std::size_t equal = word.find('=');
        const auto axis = axis_named(setup, std::string(word.substr(0, equal)));
        const std::string_view digits =
            equal == std::string_view::npos ? std::string_view() : word.substr(equal + 1);
        const auto value = parse_number(digits);
        if (!axis || !value)
            throw InputError("at: '" + std::string(word) +
                             "' does not have the form Y=100 for an axis of " + setup.path);
        // value_or, because the compiler does not see that there is a value.
        const double told = value.value_or(0.0);
        at[*axis] = turns(setup, *axis) ? rad_from_deg(told) : told;
    }
    return at;
}

const setup::Artefact& artefact_for(const setup::Setup& setup, const std::string& feature,
                                    setup::Artefact::Kind kind) {
    static constexpr const char* words[] = {"sphere", "center_pivot", "target"};
    const std::string what = words[static_cast<std::size_t>(kind)];
    const setup::Artefact* found = nullptr;
    for (const setup::Artefact& artefact : setup.artefacts) {
        if (artefact.kind != kind || (!feature.empty() && artefact.name != feature)) continue;
        if (found)
            throw InputError("the setup has several artefacts of kind " + what +
                                 "; select one with --with feature=" + artefact.name,
                             {setup.path});
        found = &artefact;
    }
    if (!found)
        throw InputError("the setup has no [[artefact]] of kind \"" + what + "\"" +
                             (feature.empty() ? "" : " named '" + feature + "'"),
                         {setup.path});
    return *found;
}

}  // namespace trunnion::imports
