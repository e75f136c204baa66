#include "imports/facts.h"

#include <algorithm>
#include <cctype>
#include <set>

#include "base/alarm.h"
#include "base/numbers.h"
#include "base/units.h"
#include "imports/times.h"

namespace trunnion::imports {
namespace {

const std::set<std::string>& known_keys() {
    static const std::set<std::string> keys{
        "axis",     "unit", "feature", "test",   "session",   "instrument", "step_s",
        "at",       "feed", "plane",   "sense",  "start_deg", "end_deg",    "sign",
        "position", "zone", "sigma",   "values", "columns",   "along",      "about"};
    return keys;
}

/// Other names of a key in the head lines of measuring software.
const std::map<std::string, std::string>& other_words() {
    static const std::map<std::string, std::string> words{
        {"feedrate", "feed"},   {"feed rate", "feed"}, {"feed_mm_min", "feed"},
        {"vorschub", "feed"},   {"ebene", "plane"},    {"achse", "axis"},
        {"axis name", "axis"},  {"units", "unit"},     {"einheit", "unit"},
        {"direction", "sense"}, {"richtung", "sense"}, {"start angle", "start_deg"},
        {"date", "day"},        {"datum", "day"},      {"test date", "day"},
        {"messdatum", "day"}};
    return words;
}

std::string upper(std::string text) {
    for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return text;
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
        facts_[key] = records::without_blanks(std::string_view(text).substr(equal + 1));
        told_.insert(key);
    }
}

Facts Facts::with_head_of(const TextTable& table) const {
    Facts all = *this;
    std::vector<TextTable::HeadEntry> days;
    for (const auto& [word, entry] : table.head()) {
        const auto other = other_words().find(word);
        const std::string& key = other == other_words().end() ? word : other->second;
        if (known_keys().contains(key) && key != "columns") all.facts_.emplace(key, entry.value);
        if (key == "day" && !is_missing(entry.value)) days.push_back(entry);
    }
    if (all.has("session")) return all;
    for (const TextTable::HeadEntry& entry : days) {
        const auto day = day_in(entry.value);
        if (!day)
            table.head_line(entry).fail("'" + entry.value +
                                            "' is no date as 2024-03-01 (01/02/2024 is two days); "
                                            "--with session=NAME names the rows instead",
                                        1);
        all.facts_.emplace("session", *day);
    }
    return all;
}

std::string Facts::text(const std::string& key, const std::string& otherwise) const {
    const auto it = facts_.find(key);
    return it == facts_.end() ? otherwise : it->second;
}

std::optional<double> Facts::number(const std::string& key) const {
    if (!has(key)) return std::nullopt;
    const std::string& text = facts_.at(key);
    const auto value = parse_number(std::string_view(text).substr(0, text.find(' ')));
    if (!value) throw InputError(key + ": '" + text + "' is not a finite number");
    return value;
}

std::optional<double> Facts::positive(const std::string& key) const {
    const auto value = number(key);
    if (value && *value <= 0.0) throw InputError(key + ": " + text(key) + " is not above 0");
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
