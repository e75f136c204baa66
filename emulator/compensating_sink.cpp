#include "emulator/compensating_sink.h"

namespace trunnion::emulator {

namespace {

class CompensatedPath : public motion::PathCurve {
  public:
    CompensatedPath(const motion::AxisMove& move, const Compensation& compensation)
        : move_(move), compensation_(compensation) {}
    AxisPositions at(double s) const override { return compensation_(move_.at(s)); }

  private:
    const motion::AxisMove& move_;
    const Compensation& compensation_;
};

}  // namespace

CompensatingSink::CompensatingSink(motion::MotionSink& next, Compensation compensation)
    : next_(next), compensation_(std::move(compensation)) {}

motion::MoveResult CompensatingSink::move(const motion::AxisMove& move) {
    const CompensatedPath path(move, compensation_);
    motion::AxisMove compensated = move;
    compensated.from = compensation_(move.from);
    compensated.to = compensation_(move.to);
    compensated.arc.reset();
    compensated.curve = &path;
    motion::MoveResult result = next_.move(compensated);
    // The control displays positions as programmed, so the correction is subtracted again; over its
    // own size it is practically constant.
    const AxisPositions again = compensation_(result.stopped);
    for (const Axis axis : all_axes) result.stopped[axis] += result.stopped[axis] - again[axis];
    return result;
}

}  // namespace trunnion::emulator
