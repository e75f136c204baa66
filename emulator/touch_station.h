// Probe or tool in the spindle, spheres and bodies on the table: answers G31 moves.
#pragma once

#include <optional>

#include "base/random.h"
#include "emulator/observer.h"
#include "emulator/reading_log.h"
#include "motion/motion.h"

namespace trunnion::emulator {

struct Touch {
    double s = 1.0;  ///< fraction of the move at which the skip signal latched
    AxisPositions stopped;
    records::Reading row;  ///< with its value; without device when no linear axis moved
};

class TouchStation {
  public:
    /// `setup` must outlive the station.
    TouchStation(const setup::Setup& setup, std::uint64_t seed) : setup_(setup), noise_(seed) {}

    /// A touch can be felt: the probe is in the spindle (no tool called yet, or the one the setup
    /// names), or a tool of [tools], which a setter feels.
    bool mounted(const motion::AxisMove& move) const;
    /// The first sphere or body that the stylus touches on the move. `row` contains the operator's
    /// settings and the start time. The value follows the rules of a table of readings; if the move
    /// also turns rotary axes or follows a curve, it is that of the path.
    std::optional<Touch> touch(const motion::AxisMove& move, records::Reading row,
                               const Observer& observer, const ReadingLog& log);

  private:
    /// Of [tools]; nothing when the probe or an unknown tool is there.
    const setup::PhysicalTool* tool_in_spindle(const motion::AxisMove& move) const;
    std::optional<Touch> touch_body(const motion::AxisMove& move, records::Reading row,
                                    const Observer& observer, const ReadingLog& log);
    std::optional<Touch> touch_sphere(const motion::AxisMove& move, records::Reading row,
                                      const Observer& observer, const ReadingLog& log);

    const setup::Setup& setup_;
    SeededNoise noise_;
};

}  // namespace trunnion::emulator
