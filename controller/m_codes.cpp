#include "controller/m_codes.h"

#include <fmt/format.h>

#include <algorithm>

#include "controller/dialect_codes.h"

namespace trunnion::controller {

namespace {

/// M codes are assigned by the machine builder; these are the usual ones. Others are noted once and
/// passed on.
constexpr MCode rows[] = {
    {0, true, "program stop"},
    {1, true, "optional stop"},
    {2, true, "end of program"},
    {3, false, "spindle clockwise"},
    {4, false, "spindle counter-clockwise"},
    {5, true, "spindle stop"},
    {6, false, "tool change"},
    {7, false, "coolant mist"},
    {8, false, "coolant"},
    {9, true, "coolant off"},
    {19, false, "spindle orientation"},
    {29, false, "rigid tapping"},
    {30, true, "end of program, rewind"},
};

const MCode* find_row(int code) {
    const auto it = std::find_if(std::begin(rows), std::end(rows),
                                 [code](const MCode& row) { return row.code == code; });
    return it == std::end(rows) ? nullptr : &*it;
}

bool holds(const std::vector<int>& codes, int code) {
    return std::find(codes.begin(), codes.end(), code) != codes.end();
}

const ClampCode* find_clamp(const std::vector<ClampCode>& clamps, int code) {
    for (const ClampCode& clamp : clamps)
        if (code == clamp.m_clamp || code == clamp.m_release) return &clamp;
    return nullptr;
}

bool has_own(const BuilderProfile& builder, int code) {
    return holds(builder.m_codes, code) || holds(builder.m_codes_after, code);
}

/// True for codes that stop look-ahead: a compensated path ends perpendicular before them.
bool stops_reading(int code) {
    return code == 0 || code == 1 || code == 2 || code == 30;
}

void set_spindle(Modal& modal, int direction) {
    modal.spindle.direction = direction;
    modal.feed_changed();
}

}  // namespace

bool knows_m(int code, const ControlConfig& config) {
    return code == 98 || code == 99 || code == 198 || find_row(code) ||
           find_clamp(config.clamps, code) || has_own(config.builder, code) ||
           find_dialect_code(config.dialect.family, code);
}

MCodes::MCodes(const ControlConfig& config)
    : clamps_(config.clamps), builder_(config.builder), optional_stop_(config.optional_stop) {}

const ClampCode* MCodes::clamp_of(int code) const {
    return find_clamp(clamps_, code);
}

bool MCodes::acts_after(int code, interpreter::DialectFamily family) const {
    if (const ClampCode* clamp = clamp_of(code)) return code == clamp->m_clamp;
    if (const DialectCode* own = find_dialect_code(family, code)) return own->after_motion;
    const MCode* row = find_row(code);
    return row ? row->after_motion : holds(builder_.m_codes_after, code);
}

void MCodes::change_state(int code, Modal& modal, Mover& mover) {
    const ClampCode* clamp = clamp_of(code);
    if (clamp)
        mover.axes.clamp(clamp->axis, code == clamp->m_clamp);
    else if (!find_row(code) && !has_own(builder_, code))
        mover.note(
            fmt::format("M{:02} is not known to this control: it passed without effect; "
                        "declare it in [control.builder] of the setup",
                        code));
    if (code == 2 || code == 30) ended_ = true;
    if (code == 3 || code == 4) set_spindle(modal, code == 3 ? 1 : -1);
    if (code == 5 || code == 19) set_spindle(modal, 0);
    if (code == 6) modal.block.tool = modal.number.tool;
    if (code >= 7 && code <= 9) modal.block.coolant = code != 9;
}

void MCodes::carry_out(int code, const SortedWords& words, Modal& modal, Frames& frames,
                       Mover& mover) {
    modal.number.m = code;
    if (stops_reading(code)) mover.cutter.flush();
    if (code == 0) mover.note("M00: program stop, continued");
    if (code == 1 && optional_stop_) mover.note("M01: optional stop, continued");
    const DialectCode* own =
        clamp_of(code) ? nullptr : find_dialect_code(modal.settings.family, code);
    if (own && own->act) own->act(words, modal, frames, mover);
    if (!own) change_state(code, modal, mover);
    mover.m_code(code);
}

void MCodes::run(bool after_motion, SortedWords& words, Modal& modal, Frames& frames,
                 Mover& mover) {
    for (std::size_t i = 0; i < words.m_count; ++i) {
        if (acts_after(words.m[i], modal.settings.family) != after_motion) continue;
        words.running_column = words.m_column[i];
        carry_out(words.m[i], words, modal, frames, mover);
    }
    words.running_column = 0;
}

}  // namespace trunnion::controller
