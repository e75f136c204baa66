#include "controller/position_variables.h"

namespace trunnion::controller {

namespace {

offsets::ControlPosition shown_position(int row, const Modal& modal, const Frames& frames,
                                        const SkipState& skip) {
    switch (row) {
        case 0: return frames.stages.shaped_from_program(frames.program);
        case 1: return frames.machine;
        case 2: return work_position(modal, frames);
        case 3: return skip.work;
        case 4: return frames.shown_length();
        default: return {};
    }
}

/// Component of axis `n`, counted from 0, in the active unit; empty when the axis does not exist.
std::optional<double> in_units(const offsets::ControlPosition& p, int n, const Modal& modal) {
    if (n < 0 || n >= static_cast<int>(modal.settings.axes.size())) return std::nullopt;
    const ControlAxis& axis = modal.settings.axes[static_cast<std::size_t>(n)];
    return p[axis.axis] / (axis.rotary ? 1.0 : modal.units.unit_mm);
}

/// The rows of #5001.. again, with room for 50 axes; the servo deviation is the last of them.
std::optional<double> position_of_six_digits(int number, const Modal& modal, const Frames& frames,
                                             const SkipState& skip) {
    if (!modal.settings.has_six_digit_variables || number > 100300) return std::nullopt;
    const int n = number - 100001;
    return in_units(shown_position(n / 50, modal, frames, skip), n % 50, modal);
}

}  // namespace

std::optional<double> position_variable(int number, const Modal& modal, const Frames& frames,
                                        const SkipState& skip) {
    if (number >= 100001) return position_of_six_digits(number, modal, frames, skip);
    if (number == 5500) return frames.fixture_number;
    if (number > 5500 && number <= 5520)
        return in_units(frames.stages.fixture, number - 5501, modal);
    if (number < 5001 || number > 5140) return std::nullopt;
    if (number > 5120) return 0.0;  // interruption by the handle
    const int n = number - 5001;
    return in_units(shown_position(n / 20, modal, frames, skip), n % 20, modal);
}

}  // namespace trunnion::controller
