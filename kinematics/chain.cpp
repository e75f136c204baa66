#include "kinematics/chain.h"

#include <algorithm>
#include <string>

#include "base/alarm.h"

namespace trunnion::kinematics {
namespace {

Vector3 unit_of(Axis axis) {
    return Vector3::Unit(static_cast<Eigen::Index>(index_of(axis) % 3));
}

/// ISO 841: a + command moves the tool towards +, so an axis on the table side moves the workpiece
/// the other way.
void take_letter(AxisGeometry& geometry, Axis letter, bool carries_work) {
    geometry.axis = letter;
    geometry.rotary = is_rotary(letter);
    geometry.direction = carries_work ? Vector3(-unit_of(letter)) : unit_of(letter);
}

std::vector<std::string_view> split(std::string_view text) {
    std::vector<std::string_view> parts;
    std::size_t i = 0;
    while ((i = text.find_first_not_of(" \t", i)) != std::string_view::npos) {
        const std::size_t end = std::min(text.find_first_of(" \t", i), text.size());
        parts.push_back(text.substr(i, end - i));
        i = end;
    }
    return parts;
}

bool is_name(std::string_view text) {
    const auto letter = [](char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); };
    const auto digit = [](char c) { return c >= '0' && c <= '9'; };
    return letter(text[0]) &&
           std::all_of(text.begin(), text.end(), [&](char c) { return letter(c) || digit(c); });
}

/// Words that already have a meaning in a chain, an error name or a column of readings.
bool is_taken(std::string_view text) {
    constexpr std::string_view taken[] = {"w",  "b",     "t",         "S",       "px",   "py",
                                          "pz", "value", "extension", "spindle", "sigma"};
    return std::any_of(std::begin(taken), std::end(taken), [&](std::string_view word) {
        return word.size() > 1 ? lower_case(text) == word : text == word;
    });
}

void check_name(std::string_view text, const std::vector<AxisGeometry*>& before) {
    if (!is_name(text) || is_taken(text))
        throw InputError(
            "'" + std::string(text) +
            "' is no name of an axis: a letter, then letters and digits, e.g. X or J1");
    for (const AxisGeometry* other : before)
        if (lower_case(other->name) == lower_case(text))
            throw InputError("axis " + std::string(text) + " stands twice in the chain");
}

/// Slots for axes whose names are not ISO 841 letters: the last slots whose letters the chain does
/// not use.
std::vector<Axis> free_slots(const std::vector<AxisGeometry*>& axes) {
    std::vector<Axis> free;
    for (const Axis slot : all_axes)
        if (std::none_of(axes.begin(), axes.end(),
                         [&](auto* a) { return a->name == std::string(1, letter_of(slot)); }))
            free.push_back(slot);
    const auto others = std::count_if(axes.begin(), axes.end(), [](auto* a) {
        return a->name.size() != 1 || !axis_of(a->name[0]);
    });
    free.erase(free.begin(), free.end() - others);
    return free;
}

/// `axes` must be in the order of the text.
void take_slots(const Chain& chain, const std::vector<AxisGeometry*>& axes) {
    const std::vector<Axis> free = free_slots(axes);
    std::size_t next = 0;
    for (AxisGeometry* axis : axes) {
        const bool carries_work = std::any_of(chain.work.begin(), chain.work.end(),
                                              [&](const AxisGeometry& a) { return &a == axis; });
        const auto letter = axis->name.size() == 1 ? axis_of(axis->name[0]) : std::nullopt;
        if (letter)
            take_letter(*axis, *letter, carries_work);
        else
            axis->axis = free[next++];
    }
}

}  // namespace

const AxisGeometry* Chain::find(Axis axis) const {
    for (const auto* side : {&work, &tool})
        for (const AxisGeometry& geometry : *side)
            if (geometry.axis == axis) return &geometry;
    return nullptr;
}

std::vector<AxisGeometry> Chain::axes() const {
    std::vector<AxisGeometry> all;
    for (const Axis axis : all_axes)
        if (const AxisGeometry* geometry = find(axis)) all.push_back(*geometry);
    return all;
}

AxisNames Chain::names() const {
    AxisNames names;
    names.name.fill({});
    for (const auto* side : {&work, &tool})
        for (const AxisGeometry& geometry : *side) {
            names.name[index_of(geometry.axis)] = geometry.name;
            names.rotary[index_of(geometry.axis)] = geometry.rotary;
        }
    return names;
}

bool is_letter(const AxisGeometry& axis) {
    return axis.name.size() == 1 && axis.name[0] == letter_of(axis.axis);
}

Chain parse_chain(std::string_view text) {
    const std::vector<std::string_view> parts = split(text);
    const auto bed = std::find(parts.begin(), parts.end(), "b");
    if (parts.size() < 3 || parts.front() != "w" || parts.back() != "t" || bed == parts.end())
        throw InputError("a chain reads 'w AXES b AXES t', e.g. 'w C B b X Y Z t'");
    if (parts.size() - 3 > axis_count) throw InputError("a chain has nine axes at most");
    Chain chain;
    chain.work.resize(static_cast<std::size_t>(bed - parts.begin()) - 1);
    chain.tool.resize(static_cast<std::size_t>(parts.end() - bed) - 2);
    std::vector<AxisGeometry*> axes;  // in text order; the axis nearest the bed comes first
    for (auto it = chain.work.rbegin(); it != chain.work.rend(); ++it) axes.push_back(&*it);
    for (AxisGeometry& axis : chain.tool) axes.push_back(&axis);
    std::vector<AxisGeometry*> named;
    for (auto part = parts.begin() + 1; part != parts.end() - 1; ++part) {
        if (part == bed) continue;
        check_name(*part, named);
        named.push_back(axes[named.size()]);
        named.back()->name = *part;
    }
    take_slots(chain, axes);
    return chain;
}

}  // namespace trunnion::kinematics
