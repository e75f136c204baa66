// Which positioning functions a user's program uses, and so which stale store reaches it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "pivot/pivot_verdict.h"

namespace trunnion::pivot {

/// Names of pivot_functions() whose codes stand in the text (comments left out): G43.4 G43.5 M128
/// are RTCP, G68.2 G68.3 G68.4 G53.1 G53.6 are TW, G54.2 is RTDFO; words of the two rotary axes
/// without any of them are DPP (whether its post counts from the pivot in G54 is not in the text).
std::vector<std::string> functions_used(std::string_view program, Axis first, Axis second);

/// A function, or a user's program, and how far its parts are off.
struct AffectedPart {
    std::string path;      ///< of a program; empty: all that use the function
    std::string function;  ///< DPP, RTDFO, RTCP, TW
    PivotGroup group = PivotGroup::g54;
    double error_um = 0.0;  ///< largest over the maps
    bool stale = false;
};

/// Codes by which a person knows a function: "G43.4, G43.5".
std::string codes_of(const std::string& function, bool hurco);

/// The functions of the control, in order; then each program that uses one.
std::vector<AffectedPart> affected_parts(
    const PivotVerdict& verdict, const std::vector<PivotFunction>& functions,
    const std::vector<std::pair<std::string, std::vector<std::string>>>& programs);

}  // namespace trunnion::pivot
