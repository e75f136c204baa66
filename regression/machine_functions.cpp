#include "regression/machine_functions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "regression/hash_mix.h"

namespace trunnion::regression {

namespace {

std::uint64_t key_of(const FunctionEvent& e) {
    const std::uint64_t h = mix(11, static_cast<std::uint64_t>(e.kind));
    if (e.kind == FunctionKind::dwell) return h;  // its duration is compared with a tolerance
    return mix(mix(h, static_cast<std::uint64_t>(std::llround(e.value * 1e3))),
               static_cast<std::uint64_t>(std::llround(e.detail)));
}

std::uint32_t line_of(const BlockLook& look) {
    return static_cast<std::uint32_t>(std::max(0, look.line));
}

}  // namespace

void FunctionRecorder::before_move(const motion::AxisMove& move, const UnsetOffsets& unset,
                                   bool tool_is_known) {
    if (move.kind != motion::MotionKind::rapid) {
        now_.exact_stop = move.gap_free ? 0 : 1;
        tell_offsets(unset, tool_is_known);
    }
    tell_states();
    mode_ = static_cast<std::uint8_t>(move.mode);
}

/// Offsets count where something is cut.
void FunctionRecorder::tell_offsets(const UnsetOffsets& unset, bool tool_is_known) {
    std::array<float, 4> now{};
    if (!tool_is_known)
        now[static_cast<std::size_t>(unset.length_is_set ? OffsetKind::known_length
                                                         : OffsetKind::length)] =
            static_cast<float>(unset.length);
    now[static_cast<std::size_t>(OffsetKind::radius)] = static_cast<float>(unset.radius);
    now[static_cast<std::size_t>(OffsetKind::work)] = static_cast<float>(unset.work);
    tell_values(now, offsets_, FunctionKind::offset);
}

void FunctionRecorder::tell_values(std::span<const float> now, std::span<float> told,
                                   FunctionKind kind) {
    for (std::size_t k = 0; k < told.size(); ++k)
        if (now[k] != told[k]) add(kind, told[k] = now[k], static_cast<double>(k), false);
}

void FunctionRecorder::dwell(double duration_s) {
    tell_states();
    add(FunctionKind::dwell, duration_s);
}

void FunctionRecorder::m_code(int code, int tool, int line) {
    const auto here = static_cast<std::uint32_t>(std::max(0, line));
    switch (code) {
        case 3:
        case 4:
        case 5:
            now_.spindle = code == 5 ? 0 : code == 3 ? 1 : -1;
            now_.spindle_line = here;
            return;
        case 7:
        case 8:
            now_.coolant = std::max(0, now_.coolant) | (code == 8 ? 1 : 2);
            now_.coolant_line = here;
            return;
        case 9:
            now_.coolant = 0;
            now_.coolant_line = here;
            return;
        case 6: now_.tool = told_.tool = tool; break;
        default: break;
    }
    tell_states();
    add(FunctionKind::m_code, code, code == 6 ? tool : 0.0);
    if (code != 6 && code > 1) return;
    now_.spindle = told_.spindle = nothing_said;
    now_.coolant = told_.coolant = nothing_said;
}

void FunctionRecorder::block(const ControlSnapshot& s, const BlockLook& look) {
    now_.tool = s.tool_selected;
    const bool exact_mode = s.modal10[15] == 610;
    if (exact_mode != exact_mode_)  // a move of this block may have told it
        exact_line_ = told_.exact_stop == (exact_mode ? 1 : 0) ? 0 : line_of(look);
    exact_mode_ = exact_mode;
    const std::int16_t path_mode = s.modal10[15] == 610 ? std::int16_t{640} : s.modal10[15];
    if (path_mode != path_mode_) add(FunctionKind::path_mode, path_mode * 0.1, 0.0, false);
    path_mode_ = path_mode;
    tell_values(s.smoothing, smoothing_, FunctionKind::smoothing);
    tell_values(s.overrides, overrides_, FunctionKind::override_bits);
    if (look.store_key != 0) {
        tell_states();
        add(FunctionKind::store, static_cast<double>(look.store_key >> 20U), 0.0, false);
    }
    if (held_.empty()) return;
    const bool known = look.program != nullptr;
    write_held(line_of(look), known ? path_.program_index(*look.program) : std::uint16_t{0});
}

void FunctionRecorder::finish() {
    tell_states();
    write_held(0, 0);
}

void FunctionRecorder::tell_states() {
    tell(now_.tool, told_.tool, FunctionKind::tool_call);
    tell(now_.spindle, told_.spindle, FunctionKind::spindle, now_.spindle_line);
    tell(now_.coolant, told_.coolant, FunctionKind::coolant, now_.coolant_line);
    if (now_.exact_stop != told_.exact_stop)
        tell(now_.exact_stop, told_.exact_stop, FunctionKind::exact_stop,
             std::exchange(exact_line_, 0));
}

void FunctionRecorder::tell(int now, int& told, FunctionKind kind, std::uint32_t line) {
    if (now == told) return;
    told = now;
    add(kind, now).line = line;
}

FunctionEvent& FunctionRecorder::add(FunctionKind kind, double value, double detail, bool placed) {
    FunctionEvent e;
    e.kind = kind;
    e.value = value;
    e.detail = detail;
    e.placed = placed && kind != FunctionKind::tool_call;
    e.cut_mm = path_.cut_mm();
    const PathPoint& end = path_.end();
    e.tip_mm = {end.position_mm.x(), end.position_mm.y(), end.position_mm.z()};
    e.mode = mode_;
    e.key = key_of(e);
    held_.push_back(e);
    const std::uint64_t whole = mix(e.key, static_cast<std::uint64_t>(std::llround(value * 1e4)));
    blocks_.append({whole, 0});
    return held_.back();
}

void FunctionRecorder::write_held(std::uint32_t line, std::uint16_t program) {
    for (FunctionEvent& e : held_) {
        if (e.line == 0) e.line = line;
        e.program = program;
        events_.append(e);
    }
    held_.clear();
}

namespace {

/// "H5 (length not set)": an offset that the stores do not tell from others.
std::string offset_text(OffsetKind kind, double value) {
    switch (kind) {
        case OffsetKind::length:
            return value == 0.0 ? "no H without a length"
                                : fmt::format("H{:g} (length not set)", value);
        case OffsetKind::known_length:
            return value == 0.0 ? "no H" : fmt::format("H{:g} (of a tool without a length)", value);
        case OffsetKind::radius:
            return value == 0.0 ? "no D without a radius"
                                : fmt::format("{} D{:g} (radius not set)",
                                              value < 0.0 ? "G42" : "G41", std::abs(value));
        case OffsetKind::work:
            return value == 0.0    ? "a work offset with values"
                   : value < 100.0 ? fmt::format("G{:g} (not set)", value)
                                   : fmt::format("G54.1 P{:g} (not set)", value - 100.0);
    }
    return {};
}

}  // namespace

std::string text_of(const FunctionEvent& e) {
    static constexpr std::array<const char*, 4> smoothing{"G5.1 Q", "G5.1 R", "G5 P", "G8 P"};
    switch (e.kind) {
        case FunctionKind::m_code:
            return e.value == 6.0 ? fmt::format("T{:g} M6", e.detail)
                                  : fmt::format("M{:g}", e.value);
        case FunctionKind::tool_call: return fmt::format("T{:g}", e.value);
        case FunctionKind::dwell: return fmt::format("dwell {:g} s", e.value);
        case FunctionKind::spindle: return e.value > 0.0 ? "M3" : e.value < 0.0 ? "M4" : "M5";
        case FunctionKind::coolant:
            return e.value == 0.0 ? "M9" : e.value == 1.0 ? "M8" : e.value == 2.0 ? "M7" : "M7 M8";
        case FunctionKind::exact_stop:
            return e.value != 0.0 ? "exact stop (G9, G61)" : "end of exact stop (G64)";
        case FunctionKind::path_mode: return fmt::format("G{:g}", e.value);
        case FunctionKind::smoothing:
            return fmt::format("{}{:g}", smoothing[static_cast<std::size_t>(e.detail)], e.value);
        case FunctionKind::override_bits:
            return fmt::format("#{:g}={:g}", 3003.0 + e.detail, e.value);
        case FunctionKind::offset: return offset_text(static_cast<OffsetKind>(e.detail), e.value);
        case FunctionKind::store: return "G10 that writes a store";
    }
    return {};
}

}  // namespace trunnion::regression
