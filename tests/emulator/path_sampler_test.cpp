#include "emulator/path_sampler.h"

#include <catch2/catch.hpp>

#include "geometry/units.h"

using namespace trunnion;

namespace {

AxisMove line(MotionKind kind, double x_mm) {
    AxisMove move;
    move.kind = kind;
    move.to[Axis::X] = x_mm;
    move.length_mm = x_mm;
    move.duration_s = 2.0;
    return move;
}

double velocity(const AxisMove& move, double s) {
    const AxisTracker tracker;
    return PathSampler{move, tracker}.at(s).velocity[Axis::X];
}

AxisMove full_circle(double radius_mm) {
    AxisMove move;
    move.kind = MotionKind::arc_ccw;
    move.from[Axis::X] = move.to[Axis::X] = radius_mm;
    move.arc = ArcPath{Vector3::Zero(), Vector3::UnitZ(), 1.0, 2.0 * pi};
    move.duration_s = 10.0;
    return move;
}

}  // namespace

TEST_CASE("axes stand where positioning, G31 and exact stops end: nothing lags there") {
    const AxisMove rapid = line(MotionKind::rapid, 100.0);
    CHECK(velocity(rapid, 0.0) == 0.0);
    CHECK(velocity(rapid, 0.5) == Approx(50.0));
    CHECK(velocity(rapid, 1.0) == 0.0);
    AxisMove feed = line(MotionKind::linear, 100.0);
    CHECK(velocity(feed, 0.0) == Approx(50.0));
    CHECK(velocity(feed, 1.0) == Approx(50.0));  // runs on into the next block
    feed.gap_free = false;
    CHECK(velocity(feed, 1.0) == 0.0);
    feed.gap_free = feed.until_skip = true;
    CHECK(velocity(feed, 1.0) == 0.0);
}

TEST_CASE("the smallest step tells a direction, rounding does not") {
    const AxisTracker tracker;
    CHECK(PathSampler{line(MotionKind::linear, 1e-7), tracker}.at(1.0).travel[0] == 1);
    CHECK(PathSampler{line(MotionKind::linear, -1e-7), tracker}.at(1.0).travel[0] == -1);
    CHECK(PathSampler{line(MotionKind::linear, 1e-13), tracker}.at(1.0).travel[0] == 0);
    AxisTracker axes;
    AxisPositions q;
    q[Axis::X] = 1.0;
    axes.advance(q);
    q[Axis::X] = 1.0 - 1e-13;
    axes.advance(q);
    CHECK(axes.travel()[0] == 1);
}

TEST_CASE("a full circle leaves the axes with the travel of its end") {
    AxisTracker tracker;
    AxisPositions start;
    start[Axis::X] = 60.0;
    tracker.place(start);
    tracker.follow(full_circle(60.0));
    CHECK(tracker.travel()[0] == 1);  // from the quadrant at Y -60 back to X +60
    CHECK(tracker.travel()[1] == 1);
    AxisSample sample;
    tracker.describe(sample);
    CHECK(sample.since_reversal[0] == Approx(120.0).margin(5.0));
    CHECK(sample.since_reversal[1] == Approx(60.0).margin(5.0));
}
