// Rounding of the value of a variable or expression in a position word (X#1, X[10.*#1/3.]).
#pragma once

namespace trunnion::controller {

/// Least input increment to which a control rounds such a value; IS-A, B, C are the increment
/// systems of a Fanuc. That it rounds is assumed, and so is the size.
enum class VariableRounding : unsigned char { none, is_a, is_b, is_c };

struct VariableRoundingName {
    VariableRounding rounding;
    const char* name;     ///< value of [control] variable_rounding
    double steps_per_mm;  ///< also per deg; ten times as many per inch; 0: all digits are kept
    const char* what;     ///< behaviour of such a control
};
constexpr VariableRoundingName variable_roundings[] = {
    {VariableRounding::none, "none", 0.0, "a variable in a position word keeps all its digits"},
    {VariableRounding::is_a, "IS-A", 1e2,
     "a variable in a position word is rounded to 0.01 mm or deg, 0.001 inch"},
    {VariableRounding::is_b, "IS-B", 1e3,
     "a variable in a position word is rounded to 0.001 mm or deg, 0.0001 inch"},
    {VariableRounding::is_c, "IS-C", 1e4,
     "a variable in a position word is rounded to 0.0001 mm or deg, 0.00001 inch"},
};

}  // namespace trunnion::controller
