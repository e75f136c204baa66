// Modal groups: the active code of each, as shown by #4001...
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace trunnion::controller {

/// Modal groups of Fanuc mill controls, numbered as in the manual: #4000 + group reads the active
/// code.
enum class ModalGroup : std::uint8_t {
    one_shot = 0,
    motion = 1,          // G0 G1 G2 G3
    plane = 2,           // G17 G18 G19
    distance = 3,        // G90 G91
    stored_stroke = 4,   // G22 G23
    feed_mode = 5,       // G93 G94 G95
    units = 6,           // G20 G21
    cutter = 7,          // G40 G41 G42
    length = 8,          // G43 G44 G49 G43.4 G43.5
    cycle = 9,           // G73-G89, G80
    cycle_return = 10,   // G98 G99
    scaling = 11,        // G50 G51
    macro_call = 12,     // G66 G67
    surface_speed = 13,  // G96 G97
    work_offset = 14,    // G54-G59 G54.1
    path_mode = 15,      // G61-G64
    rotation = 16,       // G68 G69 G68.2 ..
    polar_words = 17,    // G15 G16
    polar_motion = 21,   // G12.1 G13.1
    mirror = 22,         // G50.1 G51.1
    fixture = 23,        // G54.2; 0: P0
};

constexpr std::size_t modal_group_count = 24;

/// Code of a group at power-on (parameter 3402 changes some of them).
struct ModalGroupRow {
    ModalGroup group;
    int initial_code10;  ///< code * 10: G43.4 is 434
    const char* text;
};
const std::vector<ModalGroupRow>& modal_groups();

struct ModalCodes {
    std::array<std::int16_t, modal_group_count> code10{};

    int operator[](ModalGroup group) const { return code10[static_cast<std::size_t>(group)]; }
    void set(ModalGroup group, int code) {
        code10[static_cast<std::size_t>(group)] = static_cast<std::int16_t>(code);
    }
    bool is(ModalGroup group, int code) const { return (*this)[group] == code; }

    /// "G00", "G17", "G54.1": one for each group, in group order; G54.2 only while it is active.
    std::vector<std::string> texts() const;
};

/// The state at power-on: the table, modified by parameter 3402 (#0 G01, #1 G18, #2 G19, #3 G91).
ModalCodes initial_modal_codes(unsigned parameter_3402);

/// "G01", "G43.4" from code * 10.
std::string g_code_text(int code10);

}  // namespace trunnion::controller
