// The handlers behind the G code table, by subject. One .cpp a subject.
#pragma once

namespace trunnion {

struct ControlState;
struct GCode;

// readings.cpp
void g_units(ControlState& c, const GCode& code);        // G20 G21
void g_plane(ControlState& c, const GCode& code);        // G17 G18 G19
void g_feed_mode(ControlState& c, const GCode& code);    // G93 G94 G95
void g_speed_mode(ControlState& c, const GCode& code);   // G96 G97
void g_polar_words(ControlState& c, const GCode& code);  // G16
void g_exact_stop(ControlState& c, const GCode& code);   // G9
void g_accepted(ControlState& c, const GCode& code);     // without effect on positions: a note
void g_dwell(ControlState& c, const GCode& code);        // G4

// surface_speed.cpp
void g_speed_mode(ControlState& c, const GCode& code);  // G96 G97

// work_frames.cpp
void g_work_offset(ControlState& c, const GCode& code);       // G54-G59, G54.1
void g_local_shift(ControlState& c, const GCode& code);       // G52
void g_machine_position(ControlState& c, const GCode& code);  // G53
void g_preset(ControlState& c, const GCode& code);            // G92
void g_preset_cancel(ControlState& c, const GCode& code);     // G92.1

// tool_length.cpp
void g_tool_length(ControlState& c, const GCode& code);  // G43 G44 G49

// tool_centre_codes.cpp
void g_tool_centre(ControlState& c, const GCode& code);  // G43.4 G43.5
// fixture_codes.cpp
void g_fixture_offset(ControlState& c, const GCode& code);  // G54.2
// tilted_plane_codes.cpp
void g_tilted_plane(ControlState& c, const GCode& code);           // G68.2 G68.4
void g_tilted_plane_by_tool(ControlState& c, const GCode& code);   // G68.3
void g_rotation_cancel(ControlState& c, const GCode& code);        // G69
void g_tool_axis(ControlState& c, const GCode& code);              // G53.1
void g_tool_axis_keeping_tip(ControlState& c, const GCode& code);  // G53.6

// skip.cpp
void g_skip(ControlState& c, const GCode& code);  // G31

// g10.cpp
void g_data_setting(ControlState& c, const GCode& code);      // G10
void g_data_setting_end(ControlState& c, const GCode& code);  // G11

// cycles.cpp
void g_cycle(ControlState& c, const GCode& code);  // G73-G89

// cutter_compensation.cpp
void g_cutter(ControlState& c, const GCode& code);            // G40 G41 G42
void g_corner_arc(ControlState& c, const GCode& code);        // G39
void g_five_axis_cutter(ControlState& c, const GCode& code);  // G41.2, G42.2, ...: PS5460

// wrapped_motion.cpp
void g_polar_motion(ControlState& c, const GCode& code);  // G12.1 G13.1
void g_cylinder(ControlState& c, const GCode& code);      // G7.1

// shapes.cpp
void g_scaling(ControlState& c, const GCode& code);      // G51
void g_scaling_off(ControlState& c, const GCode& code);  // G50
void g_mirror(ControlState& c, const GCode& code);       // G51.1
void g_mirror_off(ControlState& c, const GCode& code);   // G50.1
void g_rotation(ControlState& c, const GCode& code);     // G68

// reference.cpp
void g_reference_check(ControlState& c, const GCode& code);  // G27
void g_reference(ControlState& c, const GCode& code);        // G28 G30
void g_from_reference(ControlState& c, const GCode& code);   // G29

}  // namespace trunnion
