// The stage in front of the mover: corners (,C ,R), then G41 and G42, then the interference check.
#pragma once

#include <optional>
#include <vector>

#include "cutter/beside_path.h"

namespace trunnion::cutter {

/// Takes programmed moves and hands compensated ones to the receiver, later and in order. While it
/// is not engaged nothing waits here and moves need not come this way. All positions are program
/// coordinates, mm and deg.
class CutterPath {
  public:
    explicit CutterPath(PathReceiver& receiver) : path_(receiver) {}

    void set(const CutterSettings& settings);
    const CutterSettings& settings() const { return path_.settings; }

    bool engaged() const { return engaged_; }
    bool paused() const { return paused_; }

    /// G41, G42; `program`: where the tool stands. `alone`: no axis word in the block, so a type C
    /// start-up begins with a shift.
    void start(const offsets::ControlPosition& program, bool alone);
    /// G40. `back`: type C and G40 alone in its block: the tool shifts back to the end of this
    /// move, which has offset 0.
    void end(const std::optional<PathMove>& back);
    /// G39 behind the side that waits; `to`: direction behind the arc, 0 0: that of the next move.
    /// False when no side waits.
    bool round_next_corner(PlanePoint to);

    /// The next programmed move, from `program`. PS0051, PS0052, PS0055 at corners; PS0033, PS0034,
    /// PS0038, PS0041 beside the path.
    void add(const PathMove& move, const offsets::ControlPosition& program);
    /// A dwell or an M code in its turn, marked with its block. PS0051 when a corner waits.
    void add_event(const PathOutput& event);
    /// Lets everything out that waits: the last move ends square to its end. PS0051 when a corner
    /// waits.
    void flush();
    /// Moves that are held back only for the interference check go out.
    void release() { path_.held.release(); }
    void reset();

    /// Around a block that changes frames or moves by itself. Everything waiting goes out; returns
    /// where the tool stands.
    offsets::ControlPosition pause(const offsets::ControlPosition& program);
    /// `program`: where the tool stands now; returns the programmed position. `axes_moved` (G28,
    /// G53 and the like): compensation starts anew.
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
    bool offsets_ = false;          ///< G41 or G42 is in force
    bool paused_ = false;           ///< between pause and resume
    bool starts_by_shift_ = false;  ///< type C: G41 stood alone, the next move begins with a shift
    std::optional<PathMove> corner_;                 ///< waits for the side behind its corner
    std::optional<PathMove> first_;                  ///< waits for its corner
    std::vector<PathOutput> idle_;                   ///< behind `first_`, without way in the plane
    offsets::ControlPosition programmed_from_tool_;  ///< kept while a block with other duties runs
};

}  // namespace trunnion::cutter
