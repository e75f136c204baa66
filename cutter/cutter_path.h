// The stage in front of the mover: chamfers and corner radii (,C ,R), then G41 and G42, then the
// interference check.
#pragma once

#include <optional>
#include <vector>

#include "cutter/beside_path.h"

namespace trunnion::cutter {

/// Takes programmed moves and passes compensated moves to the receiver, later but in order. While
/// it is not engaged its buffer is empty and moves may bypass it. All positions are program
/// coordinates, mm and deg.
class CutterPath {
  public:
    explicit CutterPath(PathReceiver& receiver) : path_(receiver) {}

    void set(const CutterSettings& settings);
    const CutterSettings& settings() const { return path_.settings; }

    bool engaged() const { return engaged_; }
    bool paused() const { return paused_; }

    /// G41, G42. `program`: present tool position. `alone`: the block has no axis word, so a
    /// start-up of type C begins with a shift.
    void start(const offsets::ControlPosition& program, bool alone);
    /// G40. `back`: type C and G40 alone in its block. The tool shifts back to the end of this
    /// move, which has offset 0.
    void end(const std::optional<PathMove>& back);
    /// G39 after the buffered move. `to`: direction after the arc; (0, 0) means that of the next
    /// move. Returns false when no move is buffered.
    bool round_next_corner(PlanePoint to);

    /// The next programmed move, starting at `program`. PS0051, PS0052, PS0055 at corners; PS0033,
    /// PS0034, PS0038, PS0041 beside the path.
    void add(const PathMove& move, const offsets::ControlPosition& program);
    /// A dwell or an M code in sequence, marked with its block. PS0051 when a chamfer or corner
    /// radius is pending.
    void add_event(const PathOutput& event);
    /// Sends everything in the buffer; the last move ends perpendicular to its end point. PS0051
    /// when a chamfer or corner radius is pending.
    void flush();
    /// Sends the moves that are held back only for the interference check.
    void release() { path_.held.release(); }
    void reset();

    /// Before a block that changes frames or moves by itself: sends the buffer and returns the tool
    /// position.
    offsets::ControlPosition pause(const offsets::ControlPosition& program);
    /// After that block. `program`: present tool position; returns the programmed position.
    /// `axes_moved` (G28, G53 etc.): compensation starts again.
    offsets::ControlPosition resume(const offsets::ControlPosition& program, bool axes_moved);

  private:
    void compensate(const PathMove& move);
    void flush_compensation();
    void run_idle();
    void link_to(const PathMove& move);
    void release_when_done();
    int idle_blocks(int line) const;

    BesidePath path_;
    bool engaged_ = false;
    bool offsets_ = false;            ///< G41 or G42 is active
    bool paused_ = false;             ///< between pause and resume
    bool starts_by_shift_ = false;    ///< type C: G41 was alone in its block; the next move begins
                                      ///< with a shift
    std::optional<PathMove> corner_;  ///< waits for the move after its corner
    std::optional<PathMove> first_;   ///< waits for the next move
    std::vector<PathOutput> idle_;    ///< after `first_`, without motion in the
                                      ///< plane
    offsets::ControlPosition programmed_from_tool_;  ///< kept during pause
};

}  // namespace trunnion::cutter
