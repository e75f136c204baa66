#include "report/stores_text.h"

#include <fmt/format.h>

#include <cmath>

#include "base/rounded.h"
#include "base/units.h"

namespace trunnion::report {

namespace {

int digits_of(double increment_mm) {
    return increment_mm < 9e-4 ? 4 : 3;
}

std::string line_text(const std::string& name, double now_mm, double type_mm, int digits,
                      bool open = false) {
    const double change_um = um_from_mm(type_mm - now_mm);
    return fmt::format("  {:<22} {:>12.{}f} {:>12.{}f} {:>+11.1f}{}\n", name, now_mm + 0.0, digits,
                       type_mm + 0.0, digits, std::abs(change_um) < 0.05 ? 0.0 : change_um,
                       open ? " *" : "");
}

/// Fields of the part set-up: two lines perpendicular to each axis, in machine coordinates.
std::string hurco_lines(const setup::StoresToType& s, int digits) {
    std::string text;
    const auto points = [](const setup::RotaryStores& stores, bool second) -> Vector3 {
        return stores.pivot.table_point_mm +
               (second ? stores.pivot.table_offset_mm : Vector3::Zero());
    };
    for (const bool second : {false, true}) {
        const offsets::PivotAxis& axis = second ? s.in_force.pivot.second : s.in_force.pivot.first;
        for (int i = 0; i < 3; ++i) {
            if (std::abs(axis.line[i]) > 0.5) continue;
            text += line_text(fmt::format("{} centreline {}", letter_of(axis.axis), "XYZ"[i]),
                              points(s.in_force, second)[i], points(s.typed, second)[i], digits);
        }
    }
    return text;
}

std::string fanuc_lines(const setup::StoresToType& s, int digits,
                        const std::set<std::string>& open) {
    std::string text;
    for (const setup::StoreLine& line : s.lines)
        if (line.in_force.parameter != 0)
            text += line_text("No." + line.in_force.name, line.in_force.value_mm, line.type_mm,
                              digits, open.contains(line.in_force.name));
    return text;
}

std::string centre_lines(const setup::StoresToType& s, int digits, const char* functions,
                         const std::set<std::string>& open) {
    std::string text;
    for (const setup::StoreLine& line : s.lines)
        if (line.in_force.parameter == 0)
            text += line_text(line.in_force.name, line.in_force.value_mm, line.type_mm, digits,
                              open.contains(line.in_force.name));
    for (const setup::StoreLine& line : s.fixture)
        text += line_text(line.in_force.name, line.in_force.value_mm, line.type_mm, digits);
    if (text.empty()) return text;
    return fmt::format(
               "only where this work offset is the centre of {} (G54 + external\noffset):\n",
               functions) +
           text;
}

}  // namespace

std::string stores_text(const setup::StoresToType& s, interpreter::DialectFamily dialect,
                        const std::set<std::string>& open) {
    const int digits = digits_of(s.increment_mm);
    const bool hurco = dialect == interpreter::DialectFamily::hurco &&
                       s.in_force.pivot.unit == offsets::MechanicalUnit::table_table;
    std::string text =
        fmt::format("{:<24} {:>12} {:>12} {:>11}\n", hurco ? "part set-up (assumed)" : "to type",
                    "in force / mm", "type / mm", "change / µm");
    text += hurco ? hurco_lines(s, digits) : fanuc_lines(s, digits, open);
    if (!open.empty())
        text +=
            hurco ? "  These readings do not determine all of them (sigma –): such a value is as\n"
                    "  declared, or a share of a sum.\n"
                  : "  * These readings do not determine it (sigma –): it is as declared, or a "
                    "share\n"
                    "    of a sum.\n";
    text += fmt::format(
        "  tip off on the table: {} now; after typing {} by tilts of the axes\n"
        "  (no place in these numbers), {} by the increment of {:g} mm\n",
        length_words(s.now_um), length_words(s.tilts_um), length_words(s.rounding_um),
        s.increment_mm);
    const bool has_g54_2 = dialect != interpreter::DialectFamily::hurco;
    const char* const functions = has_g54_2 ? "DPP or G54.2" : "DPP";
    const std::string centre = centre_lines(s, digits, functions, open);
    if (centre.empty()) return text;
    text += centre + fmt::format("  tip off with {}: {} now, {} after typing", functions,
                                 length_words(s.g54_now_um), length_words(s.g54_left_um));
    if (s.apart_um > 0.05)
        text += fmt::format(";\n  the axes pass each other by {}, which no G54 can hold",
                            length_words(s.apart_um));
    return text + "\n";
}

}  // namespace trunnion::report
