// Positioning functions used by a user's program, and hence the stale store that affects it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "pivot/pivot_verdict.h"

namespace trunnion::pivot {

/// Names of pivot_functions() whose codes occur in the text (comments ignored): G43.4 G43.5 M128
/// are RTCP, G68.2 G68.3 G68.4 G53.1 G53.6 are TW, G54.2 is RTDFO. Words of the two rotary axes
/// without any of these codes are DPP (whether the post processor refers to the pivot in G54 cannot
/// be seen from the text).
std::vector<std::string> functions_used(std::string_view program, Axis first, Axis second);

/// A function or a user's program, and the error of its parts.
struct AffectedPart {
    std::string path;      ///< of a program; empty: all programs that use the function
    std::string function;  ///< DPP, RTDFO, RTCP, TW
    PivotGroup group = PivotGroup::g54;
    double error_um = 0.0;  ///< maximum over the maps
    bool stale = false;
};

/// Codes of a function as users know them: "G43.4, G43.5".
std::string codes_of(const std::string& function, bool hurco);

/// The functions of the control in order, then each program that uses one of them.
std::vector<AffectedPart> affected_parts(
    const PivotVerdict& verdict, const std::vector<PivotFunction>& functions,
    const std::vector<std::pair<std::string, std::vector<std::string>>>& programs);

}  // namespace trunnion::pivot
