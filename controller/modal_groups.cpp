#include "controller/modal_groups.h"

#include <fmt/format.h>

namespace trunnion::controller {

const std::vector<ModalGroupRow>& modal_groups() {
    static const std::vector<ModalGroupRow> rows = {
        {ModalGroup::motion, 0, "interpolation"},
        {ModalGroup::plane, 170, "plane"},
        {ModalGroup::distance, 900, "absolute or incremental"},
        {ModalGroup::stored_stroke, 230, "stored stroke check"},
        {ModalGroup::feed_mode, 940, "feed"},
        {ModalGroup::units, 210, "mm or inch"},
        {ModalGroup::cutter, 400, "cutter compensation"},
        {ModalGroup::length, 490, "tool length compensation"},
        {ModalGroup::cycle, 800, "canned cycle"},
        {ModalGroup::cycle_return, 980, "return level of cycles"},
        {ModalGroup::scaling, 500, "scaling"},
        {ModalGroup::macro_call, 670, "modal macro call"},
        {ModalGroup::surface_speed, 970, "constant surface speed"},
        {ModalGroup::work_offset, 540, "work coordinate system"},
        {ModalGroup::path_mode, 640, "cutting mode"},
        {ModalGroup::rotation, 690, "coordinate rotation, tilted plane"},
        {ModalGroup::polar_words, 150, "polar coordinate words"},
        {ModalGroup::polar_motion, 131, "polar coordinate interpolation"},
        {ModalGroup::mirror, 501, "programmable mirror image"},
        {ModalGroup::fixture, 0, "dynamic fixture offset"},
    };
    return rows;
}

ModalCodes initial_modal_codes(unsigned parameter_3402) {
    ModalCodes state;
    for (const ModalGroupRow& row : modal_groups()) state.set(row.group, row.initial_code10);
    if (parameter_3402 & 1U) state.set(ModalGroup::motion, 10);
    if (parameter_3402 & 2U) state.set(ModalGroup::plane, 180);
    if (parameter_3402 & 4U) state.set(ModalGroup::plane, 190);
    if (parameter_3402 & 8U) state.set(ModalGroup::distance, 910);
    return state;
}

std::string g_code_text(int code10) {
    if (code10 % 10 != 0) return fmt::format("G{:02}.{}", code10 / 10, code10 % 10);
    return fmt::format("G{:02}", code10 / 10);
}

std::vector<std::string> ModalCodes::texts() const {
    std::vector<std::string> out;
    for (const ModalGroupRow& row : modal_groups())
        if (const int code10 = (*this)[row.group]; code10 != 0 || row.group == ModalGroup::motion)
            out.push_back(g_code_text(code10));
    return out;
}

}  // namespace trunnion::controller
