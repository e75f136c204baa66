#include "controller/hurco_codes.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace trunnion::controller {

namespace {

using enum ModalGroup;

/// Sources: docs/control.md, "Hurco".
struct HurcoCode {
    enum class In : std::uint8_t { both, isnc, bnc } in;
    GCode code;
};
using enum HurcoCode::In;

constexpr HurcoCode rows[] = {
    {both, {24, motion, Phase::motion, Action::sets_group, "3-D arc"}},
    {both, {34, motion, Phase::motion, Action::sets_group, "3-D arc"}},
    {both, {52, one_shot, Phase::reading, Action::accepted, "tolerance"}},
    {both, {53, one_shot, Phase::reading, Action::accepted, "surface finish"}},
    {both, {82, one_shot, Phase::shot, Action::reposition, "automatic safe repositioning"}},
    {both, {434, one_shot, Phase::reading, Action::linearisation, "linearisation of the tip"}},
    {both, {682, rotation, Phase::shot, Action::transform_plane, "transform plane"}},
    {both, {683, rotation, Phase::shot, Action::transform_plane, "transform plane, other order"}},
    {bnc, {700, units, Phase::units, Action::units, "inch"}},
    {bnc, {710, units, Phase::units, Action::units, "mm"}},
    {bnc, {750, one_shot, Phase::reading, Action::sets_group, "arcs of several quadrants"}},
    {isnc, {842, ModalGroup::cycle, Phase::cycle, Action::cycle, "peck tapping"}},
    {isnc, {843, ModalGroup::cycle, Phase::cycle, Action::cycle, "peck tapping, left-hand"}},
    {bnc, {880, ModalGroup::cycle, Phase::cycle, Action::cycle, "rigid tapping"}},
    {both,
     {1540, work_offset, Phase::work_offset, Action::work_offset, "additional work coordinates"}},
};

/// Fanuc codes that no source documents for a Hurco.
constexpr int fanuc_alone[] = {41,  50,  51,  71,  80,  121, 131, 370, 413, 414,
                               415, 416, 424, 425, 426, 435, 450, 460, 470, 480,
                               531, 536, 542, 600, 684, 842, 843, 911};
/// ISNC only: BNC has other codes for units and tapping, and no G87.
constexpr int isnc_alone[] = {200, 210, 740, 870};

bool holds(std::span<const int> codes, int code10) {
    return std::find(codes.begin(), codes.end(), code10) != codes.end();
}

}  // namespace

const GCode* find_hurco_g_code(double value, bool is_bnc) {
    for (const HurcoCode& row : rows)
        if (std::abs(row.code.code10 - value * 10.0) < 1e-6 &&
            row.in != (is_bnc ? HurcoCode::In::isnc : HurcoCode::In::bnc))
            return &row.code;
    const GCode* code = find_g_code(value);
    if (!code || holds(fanuc_alone, code->code10)) return nullptr;
    return is_bnc && holds(isnc_alone, code->code10) ? nullptr : code;
}

const GCode* find_g_code(double value, const ControlSettings& settings) {
    const GCode* code =
        settings.is_hurco() ? find_hurco_g_code(value, settings.hurco.bnc) : find_g_code(value);
    if (code && code->action == Action::thread && !settings.threading) code = nullptr;
    if (code) return code;
    for (const GCode& own : settings.builder.g_codes)
        if (std::abs(own.code10 - value * 10.0) < 1e-6) return &own;
    return nullptr;
}

}  // namespace trunnion::controller
