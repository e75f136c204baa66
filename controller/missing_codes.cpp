#include "controller/missing_codes.h"

#include <algorithm>
#include <iterator>

namespace trunnion::controller {

namespace {

struct MissingCode {
    int code10;
    const char* text;
};

/// Up to G10.9 as in a public list of the 30i's codes (docs/sources.md), the others quoted from
/// memory (assumed); the meaning stands in messages only. All of them move axes or frames in a way
/// that is not emulated, so none may pass without effect.
constexpr MissingCode options[] = {
    {21, "circular thread cutting"},
    {22, "involute interpolation"},
    {23, "exponential interpolation"},
    {24, "three-dimensional circular interpolation"},
    {31, "circular thread cutting"},
    {32, "involute interpolation"},
    {33, "exponential interpolation"},
    {34, "three-dimensional circular interpolation"},
    {62, "NURBS interpolation"},
    {70, "hypothetical axis interpolation"},
    {106, "tool retract and return"},
    {109, "switching of diameter and radius values"},
    {124, "groove cutting along a path"},
    {134, "groove cutting along a path"},
    {282, "reference position return without in-position check"},
    {301, "floating reference position return"},
    {302, "reference position return without in-position check"},
    {318, "skip of the electronic gear box"},
    {340, "thread cutting of variable lead"},
    {380, "compensation vector kept"},
    {411, "normal direction control"},
    {421, "normal direction control"},
    {431, "tool length compensation along the tool axis"},
    {433, "tool length compensation of a nutating head"},
    {437, "tool offset"},
    {502, "polygon turning off"},
    {504, "synchronous control off"},
    {505, "composite control off"},
    {506, "superimposed control off"},
    {512, "polygon turning"},
    {514, "synchronous control"},
    {515, "composite control"},
    {516, "superimposed control"},
    {544, "workpiece setting error compensation"},
    {721, "figure copy, rotated"},
    {722, "figure copy, along a line"},
    {750, "grinding cycle"},
    {770, "grinding cycle"},
    {780, "grinding cycle"},
    {790, "grinding cycle"},
    {804, "electronic gear box off"},
    {805, "electronic gear box off"},
    {811, "chopping"},
    {814, "electronic gear box"},
    {815, "electronic gear box"},
    {961, "spindle indexing"},
    {962, "spindle indexing"},
    {963, "spindle indexing"},
    {964, "spindle indexing"},
    {1510, "normal direction control"},
    {1520, "normal direction control"},
    {1600, "infeed control off"},
    {1610, "infeed control"},
};

}  // namespace

const char* missing_option(int code10) {
    const auto row = std::lower_bound(
        std::begin(options), std::end(options), code10,
        [](const MissingCode& missing, int code) { return missing.code10 < code; });
    return row != std::end(options) && row->code10 == code10 ? row->text : nullptr;
}

}  // namespace trunnion::controller
