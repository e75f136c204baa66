// Moves that wait for the next one: chamfers and corner radii (,C ,R), then cutter compensation.
#pragma once

#include <optional>
#include <vector>

#include "controller/plane_path.h"
#include "controller/position.h"

namespace trunnion {

struct ControlState;

/// One programmed move that waits, with all that it needs when it goes out later.
struct PathMove {
    PlaneElement plane;  ///< in the plane in force
    ControlPosition to;  ///< program coordinates of the end
    bool rapid = false;
    double offset_mm = 0.0;  ///< tool to the left (+) or right (-) of the path at its end
    bool chamfer = false, round = false;
    double corner_mm = 0.0;
    double feed_mm_min = 0.0, seconds_per_mm = 0.0;
    int line = 0;
    std::uint64_t byte = 0;
};

/// State of both stages; inactive unless `engaged`.
struct PathQueue {
    bool engaged = false;
    std::optional<PathMove> corner;        ///< waits for the side behind its corner
    double last_offset_mm = 0.0;           ///< offset of the move before `first`
    std::optional<PathMove> first;         ///< waits for its corner
    std::vector<PathMove> idle;            ///< moves without way in the plane behind `first`
    ControlPosition tool;                  ///< program coordinates of the compensated point
    ControlPosition programmed_from_tool;  ///< kept while a block with other duties runs
};

/// The block's move (G0 G1 G2 G3) goes through the queue.
void queue_move(ControlState& c, const PathMove& move);
/// Lets everything out that waits: the last move ends square to its end. PS0051 when a corner
/// waits.
void flush_path(ControlState& c);
/// Around a block that changes frames or moves by itself: everything waiting goes out and the
/// program position is that of the tool; afterwards it is the programmed one again.
void pause_path(ControlState& c);
void resume_path(ControlState& c, bool axes_moved);
/// Builds the move of this block to `target`.
PathMove path_move_of(ControlState& c, const ControlPosition& target, bool clockwise, bool arc);
/// True when moves of this block must go through the queue.
bool uses_path_queue(const ControlState& c);

/// Second stage (cutter_compensation.cpp).
void compensate(ControlState& c, const PathMove& move);
void flush_compensation(ControlState& c);
/// Sends a move of the compensated point to `end` in the plane, other axes as in `to`.
void send_path(ControlState& c, const PathMove& move, const PlaneElement& way,
               const ControlPosition& to);

}  // namespace trunnion
