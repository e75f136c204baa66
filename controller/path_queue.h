// Moves that wait for the next one: chamfers and corner radii (,C ,R), then cutter compensation.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "controller/feed_state.h"
#include "controller/position.h"
#include "geometry/plane_path.h"

namespace trunnion {

struct ControlState;

/// What a move takes from its block and the states in force there, because it goes out later.
struct BlockMarks {
    FeedState feed;
    double spindle_rpm = 0.0;
    bool coolant = false, gap_free = true;
    int tool = 0;
    int line = 0;
    std::uint64_t byte = 0;
    const std::string* program = nullptr;
};

/// One programmed move that waits, with all that it needs when it goes out later.
struct PathMove {
    PlaneElement plane;  ///< in the plane in force
    ControlPosition to;  ///< program coordinates of the end
    bool rapid = false;
    double offset_mm = 0.0;  ///< tool to the left (+) or right (-) of the path at its end
    bool chamfer = false, round = false;
    double corner_mm = 0.0;
    bool corner_arc = false;   ///< G39 behind it: an arc round its end
    PlanePoint corner_arc_to;  ///< G39 I J K: direction behind the arc; 0 0: that of the next move
    BlockMarks marks;
};

/// A move of the compensated point, a dwell or an M code on its way out.
struct PathOutput {
    PathMove move;
    PlaneElement way;
    ControlPosition from, to;
    double dwell_s = -1.0;    ///< not negative: a dwell
    int m_code = -1;          ///< not negative: an M code
    std::uint64_t block = 0;  ///< counts moves in the plane
    bool beside = false;      ///< beside the contour: start-up and cancel are not
};

/// State of all stages; inactive unless `engaged`.
struct PathQueue {
    bool engaged = false;
    bool paused = false;             ///< between pause_path and resume_path
    bool starts_by_shift = false;    ///< type C: G41 stood alone, the next move begins with a shift
    std::optional<PathMove> corner;  ///< waits for the side behind its corner
    double last_offset_mm = 0.0;     ///< offset of the move before `first`
    std::optional<PathMove> first;   ///< waits for its corner
    std::vector<PathOutput> idle;    ///< behind `first`, without way in the plane
    std::vector<PathOutput> ahead;   ///< worked out, held back for the interference check
    std::uint64_t block = 0;         ///< moves in the plane so far
    ControlPosition tool;            ///< program coordinates of the compensated point
    ControlPosition programmed_from_tool;  ///< kept while a block with other duties runs
};

/// The block's move (G0 G1 G2 G3) goes through the queue.
void queue_move(ControlState& c, const PathMove& move);
/// A dwell or an M code in its turn: at once when nothing waits.
void queue_dwell(ControlState& c, double duration_s);
void queue_m_code(ControlState& c, int code);
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

/// Third stage (path_output.cpp): a move of the compensated point to the end of `way` in the plane,
/// other axes as in `to`. `beside`: it runs beside the contour. PS0041 when it crosses a way held
/// back although the programmed sides do not touch.
void send_path(ControlState& c, const PathMove& move, const PlaneElement& way,
               const ControlPosition& to, bool beside);
/// A dwell or an M code in its turn.
void send_event(ControlState& c, const PathOutput& event);
/// Everything held back goes out.
void release_path(ControlState& c);

}  // namespace trunnion
