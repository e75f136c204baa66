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

const std::map<std::string, Word, std::less<>>& words() {
    using W = Word;
    static const std::map<std::string, Word, std::less<>> table{
        {"commanded", W::commanded},
        {"command", W::commanded},
        {"cmd", W::commanded},
        {"set", W::commanded},
        {"setpoint", W::commanded},
        {"ref", W::commanded},
        {"reference", W::commanded},
        {"target", W::commanded},
        {"nominal", W::commanded},
        {"nom", W::commanded},
        {"demand", W::commanded},
        {"desired", W::commanded},
        {"soll", W::commanded},
        {"sollposition", W::commanded},
        {"sollpos", W::commanded},
        {"lagesollwert", W::commanded},
        {"positionssollwert", W::commanded},
        {"pcmd", W::commanded},
        {"poscmd", W::commanded},
        {"sollwert", W::commanded},
        {"cad", W::commanded},
        {"actual", W::actual},
        {"act", W::actual},
        {"ist", W::actual},
        {"istposition", W::actual},
        {"istpos", W::actual},
        {"lageistwert", W::actual},
        {"positionsistwert", W::actual},
        {"posf", W::actual},
        {"fb", W::actual},
        {"resolver", W::actual},
        {"sensor", W::actual},
        {"tracker", W::actual},
        {"obs", W::actual},
        {"istwert", W::actual},
        {"feedback", W::actual},
        {"fbk", W::actual},
        {"measured", W::actual},
        {"meas", W::actual},
        {"encoder", W::actual},
        {"observed", W::actual},
        {"deviation", W::error},
        {"dev", W::error},
        {"error", W::error},
        {"err", W::error},
        {"abweichung", W::error},
        {"dif", W::error},
        {"diff", W::error},
        {"difference", W::error},
        {"delta", W::error},
        {"d", W::error},
        {"following", W::following},
        {"lag", W::following},
        {"ferror", W::following},
        {"schleppfehler", W::following},
        {"velocity", W::velocity},
        {"vel", W::velocity},
        {"speed", W::velocity},
        {"acceleration", W::acceleration},
        {"accel", W::acceleration},
        {"acc", W::acceleration},
        {"machine", W::machine},
        {"axis", W::machine},
        {"position", W::filler},
        {"pos", W::filler},
        {"coordinate", W::filler},
        {"value", W::filler},
        {"lage", W::filler},
        {"coord", W::filler},
        {"angle", W::filler},
        {"winkel", W::filler},
        {"point", W::filler},
    };
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

/// An axis of the machine with a name of its own: "J3" for "j3", "joint 3", "a3", "axis 3".
std::optional<std::string> named_axis(const std::string& word, const std::string& next,
                                      const AxisNames& axes) {
    static const std::set<std::string> joints{"joint", "axis", "gelenk", "achse", "j",
                                              "a",     "q",    "theta",  "ax"};
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
