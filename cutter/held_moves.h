// Compensated moves on their way out. Some are held back so that the interference check sees
// several moves before the first one is sent.
#pragma once

#include <vector>

#include "cutter/path_move.h"

namespace trunnion::cutter {

class HeldMoves {
  public:
    explicit HeldMoves(PathReceiver& receiver) : receiver_(receiver) {}

    /// A move of the compensated point. PS0041 when it runs beside the contour and crosses a move
    /// held back although the programmed moves do not touch. Which of the control's own checks
    /// finds this is assumed.
    void add(const PathOutput& out);
    /// A dwell or an M code in sequence; sent at once when the buffer is empty.
    void add_event(const PathOutput& event);
    /// Sends all moves held back.
    void release();
    void clear() { ahead_.clear(); }

    std::uint64_t block = 0;  ///< number of moves in the plane so far
    int blocks_ahead = 3;     ///< how many of them are held back

  private:
    void emit(const PathOutput& out);
    void check_crossing(const PathOutput& next) const;

    PathReceiver& receiver_;
    std::vector<PathOutput> ahead_;
};

}  // namespace trunnion::cutter
