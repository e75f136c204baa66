#include "controller/modal_variables.h"

namespace trunnion::controller {

namespace {

/// #3005, the setting data: of its bits only INI, inch input (from memory).
constexpr double inch_bit = 4.0;

/// The group that a number from #4001 on reads.
int group_of(int n, const Modal& modal) {
    constexpr int calls = static_cast<int>(ModalGroup::macro_call),
                  offsets = static_cast<int>(ModalGroup::work_offset);
    if (!modal.settings.work_offset_is_group_12 || (n != calls && n != offsets)) return n;
    return n == calls ? offsets : calls;
}

}  // namespace

std::optional<double> modal_variable(int number, const Modal& modal, const ProgramPlace& place) {
    if (number == 3005) return modal.is(ModalGroup::units, 200) ? inch_bit : 0.0;
    if (number == 3008) return 0.0;
    if (number < 4001 || number > 4599) return std::nullopt;
    const int n = (number - 4001) % 200 + 1;
    if (n > 130) return std::nullopt;
    if (n < static_cast<int>(modal_group_count))
        return modal.codes.code10[static_cast<std::size_t>(group_of(n, modal))] / 10.0;
    switch (n) {
        case 107: return modal.number.radius;
        case 109: return modal.block.feed.programmed;
        case 111: return modal.number.length;
        case 113: return modal.number.m;
        case 114: return place.sequence_number ? place.sequence_number() : 0;
        case 115: return place.program_number ? place.program_number() : 0;
        case 119: return modal.spindle.programmed;
        case 120: return modal.number.tool;
        case 130: return modal.number.work;
        default: return 0.0;
    }
}

}  // namespace trunnion::controller
