#include "emulator/path_sampler.h"

#include <catch2/catch.hpp>

#include "base/random.h"
#include "base/units.h"
#include "emulator/follow_move.h"

using namespace trunnion;

namespace {

motion::AxisMove line(motion::MotionKind kind, double x_mm) {
    motion::AxisMove move;
    move.kind = kind;
    move.to[Axis::X] = x_mm;
    move.length_mm = x_mm;
    move.duration_s = 2.0;
    return move;
}

double velocity(const motion::AxisMove& move, double s) {
    const records::TravelHistory tracker;
    return emulator::PathSampler{move, tracker}.at(s).velocity[Axis::X];
}

motion::AxisMove full_circle(double radius_mm) {
    motion::AxisMove move;
    move.kind = motion::MotionKind::arc_ccw;
    move.from[Axis::X] = move.to[Axis::X] = radius_mm;
    move.arc = motion::ArcPath{Vector3::Zero(), Vector3::UnitZ(), 1.0, 2.0 * pi};
    move.duration_s = 10.0;
    return move;
}

}  // namespace

TEST_CASE("axes stand where positioning, G31 and exact stops end: nothing lags there") {
    const motion::AxisMove rapid = line(motion::MotionKind::rapid, 100.0);
    CHECK(velocity(rapid, 0.0) == 0.0);
    CHECK(velocity(rapid, 0.5) == Approx(50.0));
    CHECK(velocity(rapid, 1.0) == 0.0);
    motion::AxisMove feed = line(motion::MotionKind::linear, 100.0);
    CHECK(velocity(feed, 0.0) == Approx(50.0));
    CHECK(velocity(feed, 1.0) == Approx(50.0));  // runs on into the next block
    feed.gap_free = false;
    CHECK(velocity(feed, 1.0) == 0.0);
    feed.gap_free = feed.until_skip = true;
    CHECK(velocity(feed, 1.0) == 0.0);
}

TEST_CASE("the smallest step tells a direction, rounding does not") {
    const records::TravelHistory tracker;
    CHECK(
        emulator::PathSampler{line(motion::MotionKind::linear, 1e-7), tracker}.at(1.0).travel[0] ==
        1);
    CHECK(
        emulator::PathSampler{line(motion::MotionKind::linear, -1e-7), tracker}.at(1.0).travel[0] ==
        -1);
    CHECK(
        emulator::PathSampler{line(motion::MotionKind::linear, 1e-13), tracker}.at(1.0).travel[0] ==
        0);
    records::TravelHistory axes;
    AxisPositions q;
    axes.place(q);
    q[Axis::X] = 1.0;
    axes.advance(q);
    q[Axis::X] = 1.0 - 1e-13;
    axes.advance(q);
    CHECK(axes.travel()[0] == 1);
}

TEST_CASE("a full circle leaves the axes with the travel of its end") {
    records::TravelHistory tracker;
    AxisPositions start;
    start[Axis::X] = 60.0;
    tracker.place(start);
    emulator::follow(tracker, full_circle(60.0));
    CHECK(tracker.travel()[0] == 1);  // from the quadrant at Y -60 back to X +60
    CHECK(tracker.travel()[1] == 1);
    AxisSample sample;
    tracker.describe(sample);
    CHECK(sample.since_reversal[0] == Approx(120.0).margin(5.0));
    CHECK(sample.since_reversal[1] == Approx(60.0).margin(5.0));
}

TEST_CASE("on arcs the axes turn where small steps show it") {
    SeededNoise random(4);
    for (int k = 0; k < 2000; ++k) {
        motion::AxisMove move;
        const int plane = k % 3;
        const bool round = k % 4 == 0;  // begins, and may end, at a quadrant
        const double start_rad = round ? 0.5 * pi * (k % 5) : 2.0 * pi * random.uniform();
        const double sweep_rad =
            (random.uniform() < 0.5 ? -1.0 : 1.0) *
            (round && k % 8 == 0 ? 0.5 * pi * (1 + k % 6) : 0.01 + 9.0 * random.uniform());
        const Vector3 normal = k % 7 == 0 ? Vector3(0.6, 0.0, 0.8) : Vector3(Vector3::Unit(plane));
        const Vector3 u = normal.unitOrthogonal(), v = normal.cross(u), centre(5.0, -3.0, 8.0);
        const double rise_mm = k % 7 == 0 || k % 2 ? 0.0 : 4.0;
        const auto place = [&](double angle) {
            return Vector3(centre + 40.0 * (std::cos(angle) * u + std::sin(angle) * v));
        };
        const Vector3 from = place(start_rad), to = place(start_rad + sweep_rad) + rise_mm * normal;
        for (std::size_t i = 0; i < 3; ++i) {
            move.from.value[i] = from[static_cast<Eigen::Index>(i)];
            move.to.value[i] = to[static_cast<Eigen::Index>(i)];
        }
        move.arc = motion::ArcPath{centre, normal, motion::turns_of(sweep_rad), sweep_rad};
        records::TravelHistory at_once, in_steps;
        for (records::TravelHistory* tracker : {&at_once, &in_steps}) tracker->place(move.from);
        emulator::follow(at_once, move);
        for (int s = 1; s <= 20000; ++s) in_steps.advance(move.at(s / 20000.0));
        AxisSample is, should;
        at_once.describe(is);
        in_steps.describe(should);
        for (std::size_t i = 0; i < 3; ++i) {
            INFO(k << " axis " << i << " sweep " << sweep_rad);
            if (is.since_reversal[i] < 1e-5) continue;  // the turn lies within the last step
            CHECK(is.travel[i] == should.travel[i]);
            if (should.since_reversal[i] < records::no_reversal_seen)
                CHECK(is.since_reversal[i] == Approx(should.since_reversal[i]).margin(1e-3));
        }
    }
}
