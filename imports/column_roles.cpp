#include "imports/column_roles.h"

#include <cctype>
#include <map>
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
        {"sollwert", W::commanded},
        {"cad", W::commanded},
        {"actual", W::actual},
        {"act", W::actual},
        {"ist", W::actual},
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
        {"following", W::following},
        {"lag", W::following},
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

bool take_axis(ColumnRole& role, char letter) {
    const char axis = static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
    if (role.axis != 0 && role.axis != axis) return false;
    role.axis = axis;
    return true;
}

void take_word(ColumnRole& role, Word word) {
    switch (word) {
        case Word::commanded:
            role.role = Role::commanded;
            break;
        case Word::actual:
            role.role = Role::actual;
            break;
        case Word::error:
            if (role.role != Role::following_error) role.role = Role::error;
            break;
        case Word::following:
            role.role = Role::following_error;
            break;
        case Word::velocity:
            role.rate = Rate::velocity;
            break;
        case Word::acceleration:
            role.rate = Rate::acceleration;
            break;
        case Word::machine:
            role.machine = true;
            break;
        case Word::filler:
            break;
    }
}

/// "x", "x1", "actual", "xact", "posx".
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

std::optional<ColumnRole> role_of(const std::string& name) {
    ColumnRole role;
    for (const std::string& word : words_of(name))
        if (!understand(role, word)) return std::nullopt;
    return role.axis == 0 ? std::nullopt : std::optional(role);
}

}  // namespace trunnion::imports
