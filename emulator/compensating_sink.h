// A control with error compensation: every position goes through a map before the axes see it.
#pragma once

#include <functional>

#include "motion/motion.h"

namespace trunnion::emulator {

/// Position that the axes go to instead of the commanded one.
using Compensation = std::function<AxisPositions(const AxisPositions&)>;

/// Between control and machine: hands on each move along its compensated path.
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
