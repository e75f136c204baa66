#include "emulator/compensating_sink.h"

namespace trunnion {

namespace {

class CompensatedPath : public PathCurve {
  public:
    CompensatedPath(const AxisMove& move, const Compensation& compensation)
        : move_(move), compensation_(compensation) {}
    AxisPositions at(double s) const override { return compensation_(move_.at(s)); }

  private:
    const AxisMove& move_;
    const Compensation& compensation_;
};

}  // namespace

CompensatingSink::CompensatingSink(MotionSink& next, Compensation compensation)
    : next_(next), compensation_(std::move(compensation)) {}

MoveResult CompensatingSink::move(const AxisMove& move) {
    const CompensatedPath path(move, compensation_);
    AxisMove compensated = move;
    compensated.from = compensation_(move.from);
    compensated.to = compensation_(move.to);
    compensated.arc.reset();
    compensated.curve = &path;
    MoveResult result = next_.move(compensated);
    // The control shows positions as programmed: the correction, which hardly changes over its own
    // size, is taken out again.
    const AxisPositions again = compensation_(result.stopped);
    for (const Axis axis : all_axes) result.stopped[axis] += result.stopped[axis] - again[axis];
    return result;
}

}  // namespace trunnion
