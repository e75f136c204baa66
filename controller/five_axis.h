// The hooks by which G43.4, G68.2 and G54.2 act on the rest of the control.
#pragma once

#include "controller/control_state.h"
#include "controller/moves.h"

namespace trunnion {

/// I J K: the tool axis of G43.5.
constexpr std::uint32_t tool_vector_letters =
    SortedWords::bit('I') | SortedWords::bit('J') | SortedWords::bit('K');

/// After parameters changed: 19680-19714 anew.
void decode_five_axis(ControlState& c);
/// The believed kinematics; throws PS5459 when the parameters are wrong, `otherwise` when there are
/// none (19680 = 0).
const RotaryTransform& five_axis_transform(const ControlState& c, int otherwise);
/// Sets `active`, and the mode under which moves go out.
void five_axis_changed(ControlState& c);
/// Where the axes may go: stored strokes and 19741-19744, whichever is narrower.
struct RotaryTravel;
RotaryTravel rotary_travel(const ControlState& c);

/// Before a block runs: between the blocks of G68.2 P2 and P3 nothing else may come (PS5457).
void five_axis_block_begin(const ControlState& c);
/// After it ran: TCP takes over, frames follow the rotaries.
void five_axis_block_end(ControlState& c);

/// Straight moves and arcs while `active`.
MoveResult move_five_axis(ControlState& c, MotionKind kind, const ControlPosition& target);
bool move_five_axis_arc(ControlState& c, MotionKind kind, const ControlPosition& target,
                        const ProgramArc& arc);

// tool_centre_codes.cpp
/// The program position of machine coordinates under TCP.
ControlPosition tcp_program_position(const ControlState& c, const ControlPosition& machine);
MoveResult move_tip(ControlState& c, MotionKind kind, const ControlPosition& target);
/// G49, G43: the axes stay, the position counts without TCP from now on.
void cancel_tool_centre(ControlState& c);
/// Under G43.4 or G43.5 the length of another offset number; the frame stays (assumed).
void change_tool_centre_length(ControlState& c);

// tilted_plane_codes.cpp
/// Lays the feature frame into the machine as the rotaries stand now; the control compiles after
/// it.
void place_plane(ControlState& c);
/// Tool length vector of the stages while a plane is in force: along the tool as it stands, with
/// the swing of a rotary head.
ControlPosition tool_length_in_plane(const ControlState& c);
void cancel_tilted_plane(ControlState& c);
/// The tool length as #5081.. show it: without the swing of a head inside a tilted plane.
ControlPosition shown_tool_length(const ControlState& c);

// fixture_codes.cpp
/// The vector as the block's end needs it, before the block moves; true when it changed (7570#0 =
/// 1: only after the block; assumed).
bool follow_fixture(ControlState& c, const ControlPosition& target);
/// The G54.2 vector with the rotaries where `machine` says; true when it changed.
bool turn_fixture(ControlState& c, const ControlPosition& machine);

// hurco_codes.cpp
/// M126-M129 of a Hurco control; false for any other code.
bool hurco_m_code(ControlState& c, int code);
/// Absolute rotary words of roll-over axes (1008#0) or under M126: the nearest turn, or with 1008#1
/// the turn in the direction of the word's sign.
void take_shortest_way(const ControlState& c, ControlPosition& target);

}  // namespace trunnion
