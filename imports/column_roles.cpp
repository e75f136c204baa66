#include "imports/column_roles.h"

#include <cctype>
#include <map>
#include <set>
#include <string_view>

#include "imports/columns.h"

namespace trunnion::imports {
namespace {

enum class Word : unsigned char {
    commanded,
    actual,
    error,
    following,
    velocity,
    acceleration,
    machine,
    filler
};

/// Words of column names, and what they mean.
constexpr std::pair<const char*, Word> spellings[] = {
    {"commanded", Word::commanded},
    {"command", Word::commanded},
    {"cmd", Word::commanded},
    {"set", Word::commanded},
    {"setpoint", Word::commanded},
    {"ref", Word::commanded},
    {"reference", Word::commanded},
    {"target", Word::commanded},
    {"goal", Word::commanded},
    {"tgt", Word::commanded},
    {"nominal", Word::commanded},
    {"nom", Word::commanded},
    {"demand", Word::commanded},
    {"desired", Word::commanded},
    {"soll", Word::commanded},
    {"sollposition", Word::commanded},
    {"sollpos", Word::commanded},
    {"lagesollwert", Word::commanded},
    {"positionssollwert", Word::commanded},
    {"pcmd", Word::commanded},
    {"poscmd", Word::commanded},
    {"sollwert", Word::commanded},
    {"ziel", Word::commanded},
    {"zielposition", Word::commanded},
    {"zielpos", Word::commanded},
    {"cad", Word::commanded},
    {"actual", Word::actual},
    {"present", Word::actual},
    {"act", Word::actual},
    {"ist", Word::actual},
    {"istposition", Word::actual},
    {"istpos", Word::actual},
    {"lageistwert", Word::actual},
    {"positionsistwert", Word::actual},
    {"posf", Word::actual},
    {"fb", Word::actual},
    {"resolver", Word::actual},
    {"sensor", Word::actual},
    {"tracker", Word::actual},
    {"obs", Word::actual},
    {"istwert", Word::actual},
    {"feedback", Word::actual},
    {"fbk", Word::actual},
    {"measured", Word::actual},
    {"meas", Word::actual},
    {"encoder", Word::actual},
    {"observed", Word::actual},
    {"deviation", Word::error},
    {"dev", Word::error},
    {"error", Word::error},
    {"err", Word::error},
    {"abweichung", Word::error},
    {"dif", Word::error},
    {"diff", Word::error},
    {"difference", Word::error},
    {"delta", Word::error},
    {"d", Word::error},
    {"following", Word::following},
    {"lag", Word::following},
    {"ferror", Word::following},
    {"schleppfehler", Word::following},
    {"velocity", Word::velocity},
    {"vel", Word::velocity},
    {"speed", Word::velocity},
    {"acceleration", Word::acceleration},
    {"accel", Word::acceleration},
    {"acc", Word::acceleration},
    {"machine", Word::machine},
    {"axis", Word::machine},
    {"position", Word::filler},
    {"pos", Word::filler},
    {"coordinate", Word::filler},
    {"value", Word::filler},
    {"lage", Word::filler},
    {"coord", Word::filler},
    {"angle", Word::filler},
    {"winkel", Word::filler},
    {"point", Word::filler},
};

const std::map<std::string, Word, std::less<>>& words() {
    static const std::map<std::string, Word, std::less<>> table(std::begin(spellings),
                                                                std::end(spellings));
    return table;
}

bool is_axis(char c) {
    return std::string_view("xyzabcuvw").find(c) != std::string_view::npos;
}

bool only_digits(std::string_view text) {
    return text.find_first_not_of("0123456789") == std::string_view::npos;
}

bool take_axis(ColumnRole& role, const std::string& axis) {
    if (!role.axis.empty() && role.axis != axis) return false;
    role.axis = axis;
    return true;
}

bool take_axis(ColumnRole& role, char letter) {
    return take_axis(
        role, std::string(1, static_cast<char>(std::toupper(static_cast<unsigned char>(letter)))));
}

/// The letters of a word, and the digits after them.
std::pair<std::string, std::string> parts_of(const std::string& word) {
    const std::size_t last = word.find_last_not_of("0123456789");
    const std::size_t cut = last == std::string::npos ? 0 : last + 1;
    return {word.substr(0, cut), word.substr(cut)};
}

/// The short names that mounts and their control use: "az" for "azimuth".
std::string short_name(const std::string& word) {
    static const std::map<std::string, std::string> names{
        {"azimuth", "az"},   {"azimut", "az"},       {"elevation", "el"},
        {"altitude", "alt"}, {"declination", "dec"}, {"hourangle", "ha"}};
    const auto it = names.find(word);
    return it == names.end() ? word : it->second;
}

/// An axis whose name is a letter other than those of ISO 841: "R", "Q".
std::optional<std::string> unusual_letter(const std::string& word, const AxisNames& axes) {
    if (word.size() != 1 || is_axis(word.front())) return std::nullopt;
    for (const Axis axis : all_axes)
        if (lower_case(axes[axis]) == word) return axes[axis];
    return std::nullopt;
}

/// An axis with a name other than a letter: "J3" for "j3", "joint 3", "a3", "axis 3".
std::optional<std::string> named_axis(const std::string& word, const std::string& next,
                                      const AxisNames& axes) {
    static const std::set<std::string> joints{"joint", "axis", "gelenk", "achse", "j",
                                              "a",     "q",    "theta",  "ax"};
    if (const auto letter = unusual_letter(word, axes)) return letter;
    auto [letters, digits] = parts_of(short_name(word));
    if (digits.empty() && only_digits(next)) digits = next;
    for (const Axis axis : all_axes) {
        const std::string& name = axes[axis];
        if (name.size() < 2) continue;
        const auto [own, number] = parts_of(short_name(lower_case(name)));
        if (number == digits && (letters == own || (!digits.empty() && joints.contains(letters))))
            return name;
    }
    return std::nullopt;
}

void take_word(ColumnRole& role, Word word) {
    switch (word) {
        case Word::commanded: role.role = Role::commanded; break;
        case Word::actual: role.role = Role::actual; break;
        case Word::error:
            if (role.role != Role::following_error) role.role = Role::error;
            break;
        case Word::following: role.role = Role::following_error; break;
        case Word::velocity: role.rate = Rate::velocity; break;
        case Word::acceleration: role.rate = Rate::acceleration; break;
        case Word::machine: role.machine = true; break;
        case Word::filler: break;
    }
}

/// Interprets one word: "x", "x1", "actual", "xact", "posx".
bool understand(ColumnRole& role, std::string_view word) {
    if (const auto it = words().find(word); it != words().end()) {
        take_word(role, it->second);
        return true;
    }
    if (is_axis(word.front()) && only_digits(word.substr(1))) return take_axis(role, word.front());
    for (const bool front : {true, false}) {
        const char letter = front ? word.front() : word.back();
        const auto it = words().find(front ? word.substr(1) : word.substr(0, word.size() - 1));
        if (!is_axis(letter) || it == words().end()) continue;
        take_word(role, it->second);
        return take_axis(role, letter);
    }
    return false;
}

}  // namespace

std::optional<ColumnRole> role_of(const std::string& name, const AxisNames& axes) {
    ColumnRole role;
    const std::vector<std::string> list = words_of(name);
    for (std::size_t k = 0; k < list.size(); ++k) {
        const std::string next = k + 1 < list.size() ? list[k + 1] : "";
        if (const auto named = named_axis(list[k], next, axes)) {
            if (!take_axis(role, *named)) return std::nullopt;
            role.machine = true;
            if (!next.empty() && only_digits(next)) ++k;
        } else if (const auto error = named_axis(list[k].substr(1), "", axes);
                   error && list[k].front() == 'd') {  // "daz"
            if (!take_axis(role, *error)) return std::nullopt;
            role.role = Role::error;
        } else if (!understand(role, list[k])) {
            return std::nullopt;
        }
    }
    return role.axis.empty() ? std::nullopt : std::optional(role);
}

}  // namespace trunnion::imports
