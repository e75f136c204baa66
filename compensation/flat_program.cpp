#include "compensation/flat_program.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/units.h"
#include "setup/control_axes.h"

namespace trunnion::compensation {
namespace {

std::string trimmed(std::string text) {
    while (text.back() == '0') text.pop_back();
    return text == "-0." ? "0." : text;
}

}  // namespace

FlatProgram::FlatProgram(const setup::Setup& setup, int decimals)
    : setup_(setup), language_(setup::language_of(setup)), decimals_(decimals) {
    text_ = std::string(setup::start_codes(language_)) + " G17 G90 G94 G40 G49 G69 G80\nG54\n";
}

double FlatProgram::offset(Axis axis) const {
    const offsets::WorkOffsets& work = setup_.stores.work;
    return work.external[axis] + work.standard[0][axis] + (axis == Axis::Z ? length_mm_ : 0.0);
}

std::string FlatProgram::word(char letter, double value) const {
    return fmt::format(" {}{}", letter, trimmed(fmt::format("{:.{}f}", value, decimals_)));
}

void FlatProgram::m_code(int code) {
    if (code == 2 || code == 30 || code == 98 || code == 99) return;
    if (code == 5) spindle_rpm_ = 0.0;
    if (code == 6)
        tool_change_ = true;
    else if (code != 3 && code != 4)  // the spindle starts with its speed
        pending_ += fmt::format("M{:02}\n", code);
}

void FlatProgram::dwell(double duration_s) {
    pending_ += "G4" + word('X', duration_s) + '\n';
}

void FlatProgram::prepare(const motion::AxisMove& move) {
    if (move.tool != tool_) text_ += fmt::format("T{}{}\n", move.tool, tool_change_ ? " M06" : "");
    tool_ = move.tool;
    tool_change_ = false;
    if (move.spindle_rpm != spindle_rpm_)
        text_ += move.spindle_rpm == 0.0
                     ? std::string("M05\n")
                     : fmt::format("{} M0{}\n", word('S', std::abs(move.spindle_rpm)).substr(1),
                                   move.spindle_rpm > 0.0 ? 3 : 4);
    spindle_rpm_ = move.spindle_rpm;
    text_ += std::exchange(pending_, "");
    if (move.tool_offset == length_offset_) return;
    length_offset_ = move.tool_offset;
    const auto& tools = setup_.stores.tools.tool;
    const auto n = static_cast<std::size_t>(std::max(0, length_offset_));
    length_mm_ = n == 0 || n >= tools.size() ? 0.0 : tools[n].length_mm();
    motion_ = length_offset_ == 0 ? "G49" : fmt::format("G43 H{}", length_offset_);
    first_ = true;
}

/// Words of the axes that change; sets `at_` to the written decimals.
std::string FlatProgram::axis_words(const AxisPositions& to, bool all) {
    std::string words;
    for (const kinematics::AxisGeometry& axis : setup::all_machine_axes(setup_)) {
        const auto inside = [&](double v) { return axis.rotary ? rad_from_deg(v) : v; };
        const double wanted = axis.rotary ? deg_from_rad(to[axis.axis]) : to[axis.axis];
        const double scale = std::pow(10.0, decimals_);
        const double value = std::round((wanted - offset(axis.axis)) * scale) / scale;
        const double reached = inside(value + offset(axis.axis));
        if (!all && std::abs(reached - at_[axis.axis]) < inside(0.5 / scale)) continue;
        words += word(letter_of(axis.axis), value);
        at_[axis.axis] = reached;
    }
    return words;
}

std::string FlatProgram::feed_words(const motion::AxisMove& move, bool rotary, double duration_s) {
    if (rotary) {
        feed_.clear();
        const std::string mode = feed_mode_ == "G93" ? "" : " G93";
        feed_mode_ = "G93";
        return mode + word('F', 60.0 / std::max(duration_s, 1e-6));
    }
    const std::string mode = feed_mode_ == "G94" ? "" : " G94";
    feed_mode_ = "G94";
    const std::string words = word('F', move.feed_mm_min);
    return mode + (std::exchange(feed_, words) == words ? "" : words);
}

void FlatProgram::block(const motion::AxisMove& move, const std::string& words) {
    text_ += fmt::format("N{} {}{}\n", move.line % 100000, motion_, words);
    motion_.clear();
    first_ = false;
    lines_ += static_cast<int>(
        std::count(text_.begin() + static_cast<std::ptrdiff_t>(counted_), text_.end(), '\n'));
    counted_ = text_.size();
}

/// True when an axis changes by at least one digit.
bool FlatProgram::moves(const AxisPositions& to) const {
    const double half = 0.5 * std::pow(10.0, -decimals_);
    for (const kinematics::AxisGeometry& axis : setup::all_machine_axes(setup_))
        if (std::abs(to[axis.axis] - at_[axis.axis]) >= (axis.rotary ? rad_from_deg(half) : half))
            return true;
    return false;
}

bool FlatProgram::line(const motion::AxisMove& move, const AxisPositions& to, double duration_s) {
    bool rotary = false;
    for (const Axis axis : {Axis::A, Axis::B, Axis::C}) rotary |= to[axis] != at_[axis];
    const bool moved = moves(to);
    const std::string words = axis_words(to, first_);
    if (words.empty()) return false;
    const bool rapid =
        move.kind == motion::MotionKind::rapid || (duration_s <= 0.0 && move.feed_mm_min <= 0.0);
    motion_ += motion_.empty() ? "" : " ";
    motion_ += rapid ? "G0" : "G1";
    block(move, words + (rapid ? "" : feed_words(move, rotary, duration_s)));
    return moved;
}

bool FlatProgram::skip(const motion::AxisMove& move, const AxisPositions& to) {
    const std::string words = axis_words(to, first_);
    if (words.empty()) return false;
    motion_ += motion_.empty() ? "G31" : " G31";
    block(move, words + feed_words(move, false, 0.0));
    return true;
}

void FlatProgram::arc(const motion::AxisMove& move, const AxisPositions& to, int normal,
                      bool counter_clockwise, const Vector3& centre_mm) {
    const Vector3 start(at_[Axis::X], at_[Axis::Y], at_[Axis::Z]);
    const std::string plane = normal == 2 ? "G17" : normal == 1 ? "G18" : "G19";
    std::string words = plane_ == plane ? "" : plane + ' ';
    plane_ = plane;
    motion_ += motion_.empty() ? "" : " ";
    const bool bnc = language_ == setup::ProgramLanguage::bnc;
    const bool exchanged = bnc && normal == 1;
    motion_ += words + (counter_clockwise != exchanged ? "G3" : "G2");
    words = axis_words(to, true);
    for (int i = 0; i < 3; ++i) {
        const double from = bnc ? offset(all_axes[static_cast<std::size_t>(i)]) : start[i];
        if (i != normal) words += word("IJK"[i], centre_mm[i] - from);
    }
    block(move, words + feed_words(move, false, 0.0));
}

std::string FlatProgram::take() {
    return "%\nO0001\n" + text_ + pending_ + "M30\n%\n";
}

}  // namespace trunnion::compensation
