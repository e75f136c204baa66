// A control with error compensation: every position passes through a map before it reaches the
// axes.
#pragma once

#include <functional>

#include "motion/motion.h"

namespace trunnion::emulator {

/// Position of the axes for a commanded position.
using Compensation = std::function<AxisPositions(const AxisPositions&)>;

/// Stage between control and machine: passes on each move along its compensated path.
class CompensatingSink : public motion::MotionSink {
  public:
    CompensatingSink(motion::MotionSink& next, Compensation compensation);

    motion::MoveResult move(const motion::AxisMove& move) override;
    void dwell(double duration_s) override { next_.dwell(duration_s); }
    void m_code(int code) override { next_.m_code(code); }

  private:
    motion::MotionSink& next_;
    Compensation compensation_;
};

}  // namespace trunnion::emulator
