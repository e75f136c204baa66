// The G codes: code, modal group, phase within the block, action.
#pragma once

#include <cstdint>

#include "controller/modal_groups.h"

namespace trunnion::controller {

/// The action of a code; controller/g_actions.cpp maps it to its subject.
enum class Action : std::uint8_t {
    sets_group,  ///< only sets its modal group
    accepted,
    builder,  ///< accepted; axis words without a motion code are its own
    corner_arc,
    cutter,
    cycle,
    cylinder,
    data_setting,
    data_setting_end,
    dwell,
    exact_stop,
    feed_mode,
    five_axis_cutter,
    fixture_offset,
    from_reference,
    linearisation,  ///< Hurco's G43.4
    local_shift,
    machine_position,
    mirror,
    mirror_off,
    plane,
    polar_motion,
    polar_words,
    position_offset,
    preset,
    preset_cancel,
    reference,
    reference_check,
    reposition,  ///< Hurco's G8.2
    rotation,
    rotation_cancel,
    scaling,
    scaling_off,
    single_direction,
    skip,
    speed_mode,
    thread,  ///< G33, an option
    tilted_plane,
    tilted_plane_by_tool,
    tool_axis,
    tool_axis_keeping_tip,
    tool_centre,
    tool_length,
    tool_measurement,
    transform_plane,  ///< Hurco's G68.2, G68.3
    units,
    work_offset,
};

/// Order in which the codes of one block act, independent of the written order.
enum class Phase : std::uint8_t {
    speed,        ///< G96 G97, before S
    feed,         ///< G93 G94 G95, before F
    units,        ///< G20 G21
    plane,        ///< G17 G18 G19
    reading,      ///< G90 G91 G15 G98 G99 G61-G64: interpretation of words
    work_offset,  ///< G54-G59 G54.1 G54.2: no motion; axis words remain for the motion
    frame,        ///< G50 G69 G50.1: cancel codes; axis words remain for the motion
    offsets,      ///< G40-G42 G43 G44 G49: act together with the motion of the block
    shot,         ///< codes that use the axis words themselves: G4 G10 G28 G31 G51 G52 G53 G68 G92
    cycle,        ///< G73-G89
    motion,       ///< group 01
};

struct GCode {
    int code10;  ///< code * 10
    ModalGroup group;
    Phase phase;
    Action action;
    const char* text;  ///< for messages and documents
};

/// The code of a word's value, or nullptr when the control does not have it.
const GCode* find_g_code(double value);

}  // namespace trunnion::controller
