#include "geometry/axis_names.h"

namespace trunnion::inline geometry {

std::string lower_case(std::string_view text) {
    std::string out(text);
    for (char& c : out)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return out;
}

std::optional<Axis> AxisNames::find(std::string_view text) const {
    if (text.empty()) return std::nullopt;
    for (const Axis axis : all_axes)
        if (name[index_of(axis)] == text) return axis;
    return std::nullopt;
}

std::optional<Axis> AxisNames::find_column(std::string_view text) const {
    for (const Axis axis : all_axes)
        if (has(axis) && column(axis) == text) return axis;
    return std::nullopt;
}

std::string AxisNames::column(Axis axis) const {
    return lower_case((*this)[axis]) + (is_rotary(axis) ? "_deg" : "_mm");
}

}  // namespace trunnion::inline geometry
