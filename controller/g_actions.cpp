#include "controller/g_actions.h"

#include <fmt/format.h>

#include <array>

#include "controller/alarms.h"
#include "controller/commanded.h"
#include "controller/cutter_codes.h"
#include "controller/fixture_offset_codes.h"
#include "controller/position_offset.h"
#include "controller/retract.h"
#include "controller/shapes.h"
#include "controller/single_direction.h"
#include "controller/surface_speed.h"
#include "controller/tool_centre.h"
#include "controller/tool_length.h"
#include "controller/tool_measurement.h"
#include "controller/transform_plane.h"
#include "controller/word_readings.h"
#include "controller/work_frames.h"

namespace trunnion::controller {

namespace {

struct ActionRow {
    Action action;
    void (*carry_out)(Control& c, const GCode& code);
};

void set_group(Control& c, const GCode& code) {
    c.modal.codes.set(code.group, code.code10);
}

void accept(Control& c, const GCode& code) {
    if (code.group != ModalGroup::one_shot) set_group(c, code);
    c.mover.note(fmt::format("{} ({}) is accepted without effect on positions",
                             g_code_text(code.code10), code.text));
}

/// Radius compensation perpendicular to a turning tool is not emulated: an alarm is better than a
/// wrong part.
void refuse_five_axis_cutter(Control&, const GCode& code) {
    raise_alarm(5460, fmt::format("G{}.{}", code.code10 / 10, code.code10 % 10));
}

void cutter(Control& c, const GCode& code) {
    if (code.code10 != 400 && (c.wrapped.polar() || c.wrapped.cylinder())) raise_alarm(9002);
    set_cutter(c.words, c.modal, c.frames, c.mover, code.code10);
}

void polar_words(Control& c, const GCode& code) {
    set_group(c, code);
    start_polar_words(c.modal, c.frames.program);
}

void end_rotation_or_plane(Control& c, const GCode&) {
    if (c.frames.plane) return cancel_tilted_plane(c.modal, c.frames, c.mover);
    end_rotation(c.modal, c.frames, c.mover);
}

constexpr ActionRow rows[] = {
    {Action::sets_group, set_group},
    {Action::accepted, accept},
    {Action::builder, accept},
    {Action::corner_arc, [](Control& c, const GCode&) { corner_arc(c.words, c.modal, c.mover); }},
    {Action::cutter, cutter},
    {Action::cycle,
     [](Control& c, const GCode& g) { start_cycle(c.cycle, c.modal, c.frames, g.code10); }},
    {Action::cylinder, [](Control& c, const GCode&) { c.wrapped.set_cylinder(c.words, c.modal); }},
    {Action::data_setting,
     [](Control& c, const GCode&) {
         c.data_entry = set_data(c.words, c.modal, c.frames, c.mover);
     }},
    {Action::data_setting_end, [](Control& c, const GCode&) { c.data_entry = DataEntry::none; }},
    {Action::dwell, [](Control& c, const GCode&) { dwell(c.words, c.modal, c.mover); }},
    {Action::exact_stop, [](Control&, const GCode&) {}},  // evaluated by the move of the block
    {Action::feed_mode, [](Control& c, const GCode& g) { change_feed_mode(c.modal, g.code10); }},
    {Action::five_axis_cutter, refuse_five_axis_cutter},
    {Action::fixture_offset,
     [](Control& c, const GCode&) { set_fixture_offset(c.words, c.modal, c.frames, c.mover); }},
    {Action::from_reference,
     [](Control& c, const GCode&) {
         c.reference_points.come_back(c.words, c.modal, c.frames, c.mover);
     }},
    {Action::linearisation,
     [](Control& c, const GCode&) { c.frames.tip.along_line = c.words.get('Q', 0.0) == 0.0; }},
    {Action::local_shift,
     [](Control& c, const GCode&) { set_local_shift(c.words, c.modal, c.frames, c.mover); }},
    {Action::machine_position,
     [](Control& c, const GCode&) { go_to_machine_position(c.words, c.modal, c.frames, c.mover); }},
    {Action::mirror,
     [](Control& c, const GCode&) { set_mirror(c.words, c.modal, c.frames, c.mover); }},
    {Action::mirror_off,
     [](Control& c, const GCode&) { end_mirror(c.words, c.modal, c.frames, c.mover); }},
    {Action::plane, [](Control& c, const GCode& g) { change_plane(c.modal, g.code10); }},
    {Action::polar_motion,
     [](Control& c, const GCode& g) { c.wrapped.set_polar(c.modal, c.frames, g.code10); }},
    {Action::polar_words, polar_words},
    {Action::position_offset,
     [](Control& c, const GCode&) { check_position_offset(c.words, c.modal); }},
    {Action::preset,
     [](Control& c, const GCode&) { preset_position(c.words, c.modal, c.frames, c.mover); }},
    {Action::preset_cancel,
     [](Control& c, const GCode&) { cancel_preset(c.words, c.modal, c.frames, c.mover); }},
    {Action::reference,
     [](Control& c, const GCode& g) {
         c.reference_points.go(c.words, c.modal, c.frames, c.mover, g.code10);
     }},
    {Action::reference_check,
     [](Control& c, const GCode&) { check_reference(c.words, c.modal, c.frames, c.mover); }},
    {Action::reposition,
     [](Control& c, const GCode&) { reposition(c.words, c.modal, c.frames, c.mover); }},
    {Action::rotation,
     [](Control& c, const GCode&) { set_rotation(c.words, c.modal, c.frames, c.mover); }},
    {Action::rotation_cancel, end_rotation_or_plane},
    {Action::scaling,
     [](Control& c, const GCode&) { set_scaling(c.words, c.modal, c.frames, c.mover); }},
    {Action::scaling_off,
     [](Control& c, const GCode&) { end_scaling(c.modal, c.frames, c.mover); }},
    {Action::single_direction,
     [](Control& c, const GCode&) {
         position_in_one_direction(c.words, c.modal, c.frames, c.mover);
     }},
    {Action::skip,
     [](Control& c, const GCode&) { skip_move(c.skip, c.words, c.modal, c.frames, c.mover); }},
    {Action::speed_mode,
     [](Control& c, const GCode& g) {
         set_speed_mode(c.words, c.modal, g.code10, c.frames.program);
     }},
    {Action::thread, set_group},  // a motion code, executed as the motion of the block
    {Action::tilted_plane,
     [](Control& c, const GCode& g) {
         c.plane_codes.define(c.words, c.modal, c.frames, c.mover, g.code10);
     }},
    {Action::tilted_plane_by_tool,
     [](Control& c, const GCode&) { define_plane_by_tool(c.words, c.modal, c.frames, c.mover); }},
    {Action::tool_axis,
     [](Control& c, const GCode&) { turn_tool_axis(c.words, c.modal, c.frames, c.mover); }},
    {Action::tool_axis_keeping_tip,
     [](Control& c, const GCode&) {
         turn_tool_axis_keeping_tip(c.words, c.modal, c.frames, c.mover);
     }},
    {Action::tool_centre,
     [](Control& c, const GCode& g) { start_tool_centre(c.words, c.modal, c.frames, c.mover, g); }},
    {Action::tool_length,
     [](Control& c, const GCode& g) {
         set_tool_length(c.words, c.modal, c.frames, c.mover, g.code10);
     }},
    {Action::tool_measurement,
     [](Control& c, const GCode&) { measure_tool_length(c.words, c.modal, c.frames, c.mover); }},
    {Action::transform_plane,
     [](Control& c, const GCode& g) {
         set_transform_plane(c.words, c.modal, c.frames, c.mover, g.code10);
     }},
    {Action::units,
     [](Control& c, const GCode& g) {
         change_units(c.modal, g.code10 == 700 || g.code10 == 200 ? 200 : 210);
     }},
    {Action::work_offset,
     [](Control& c, const GCode& g) {
         const bool g154 = g.code10 == 1540;
         if (g154) c.mover.note("G154 is read as G54.1 (second-hand)");
         set_work_offset(c.words, c.modal, c.frames, c.mover, g154 ? 541 : g.code10);
     }},
};

constexpr bool rows_follow_the_enumeration() {
    for (std::size_t i = 0; i < std::size(rows); ++i)
        if (static_cast<std::size_t>(rows[i].action) != i) return false;
    return std::size(rows) == static_cast<std::size_t>(Action::work_offset) + 1;
}
static_assert(rows_follow_the_enumeration());

}  // namespace

void carry_out(Control& c, const GCode& code) {
    rows[static_cast<std::size_t>(code.action)].carry_out(c, code);
}

}  // namespace trunnion::controller
