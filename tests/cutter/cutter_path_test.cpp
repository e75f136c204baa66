// Cutter compensation alone: moves in, moves out, no control.
#include "cutter/cutter_path.h"

#include <catch2/catch.hpp>
#include <vector>

#include "base/alarm.h"

namespace trunnion {

namespace {

class Recorder : public cutter::PathReceiver {
  public:
    void take(const cutter::PathOutput& out) override { taken.push_back(out); }
    std::vector<cutter::PathOutput> taken;
};

/// A path of straight sides, cutter radius 5 mm to the left.
struct Path {
    Path() : cutter(out) {}
    cutter::PathMove to(double x, double y, double offset_mm = 5.0) {
        cutter::PathMove m;
        m.plane.start = at;
        m.plane.end = at = {x, y};
        m.to[Axis::X] = x;
        m.to[Axis::Y] = y;
        m.offset_mm = offset_mm;
        m.marks.line = ++line;
        return m;
    }
    void go(const cutter::PathMove& m) {
        offsets::ControlPosition from;
        from[Axis::X] = m.plane.start.x;
        from[Axis::Y] = m.plane.start.y;
        cutter.add(m, from);
    }
    int alarm(const cutter::PathMove& m) {
        try {
            go(m);
        } catch (const Alarm& alarm) {
            return alarm.number;
        }
        return 0;
    }

    Recorder out;
    cutter::CutterPath cutter;
    PlanePoint at;
    int line = 0;
};

}  // namespace

TEST_CASE("a left-hand square inside: the tool stays one radius away from every side") {
    Path p;
    p.cutter.start({}, false);
    p.go(p.to(0, 20));   // start-up
    p.go(p.to(0, 100));  // up, the tool at x = -5
    p.go(p.to(-80, 100));
    p.cutter.end(std::nullopt);
    p.go(p.to(-80, 150, 0.0));
    p.cutter.flush();
    REQUIRE(p.out.taken.size() == 4);
    CHECK(p.out.taken[0].to[Axis::X] == Approx(-5.0));
    CHECK(p.out.taken[1].to[Axis::X] == Approx(-5.0));
    CHECK(p.out.taken[1].to[Axis::Y] == Approx(95.0));  // inside corner
    CHECK(p.out.taken[2].to[Axis::Y] == Approx(95.0));
    CHECK(p.out.taken[3].to[Axis::Y] == Approx(150.0));
    CHECK_FALSE(p.cutter.engaged());
}

TEST_CASE("a corner radius between two sides touches both") {
    Path p;
    cutter::PathMove first = p.to(100, 0, 0.0);
    first.round = true;
    first.corner_mm = 10.0;
    p.go(first);
    CHECK(p.out.taken.empty());  // waits for the next side
    p.go(p.to(100, 50, 0.0));
    REQUIRE(p.out.taken.size() == 3);
    const PlaneElement& arc = p.out.taken[1].way;
    REQUIRE(arc.arc);
    CHECK(arc.start.x == Approx(90.0));
    CHECK(arc.end.y == Approx(10.0));
    CHECK(arc.radius() == Approx(10.0));
}

TEST_CASE("a slot narrower than the cutter, an arc about its own start, a corner without a side") {
    Path p;
    p.cutter.start({}, false);
    p.go(p.to(0, 20));
    p.go(p.to(0, 100));
    p.go(p.to(-4, 100));
    CHECK(p.alarm(p.to(-4, 0)) == 41);

    Path q;
    q.cutter.start({}, false);
    q.go(q.to(0, 20));
    cutter::PathMove point = q.to(0, 20);
    point.plane.arc = true;
    point.plane.centre = point.plane.start;
    point.plane.sweep_rad = 6.0;
    CHECK(q.alarm(point) == 38);

    Path r;
    cutter::PathMove corner = r.to(10, 0, 0.0);
    corner.chamfer = true;
    corner.corner_mm = 1.0;
    r.go(corner);
    CHECK_THROWS_AS(r.cutter.flush(), Alarm);
}

TEST_CASE("dwells and M codes keep their turn") {
    Path p;
    p.cutter.start({}, false);
    p.go(p.to(0, 20));
    p.go(p.to(0, 100));
    cutter::PathOutput event;
    event.m_code = 8;
    p.cutter.add_event(event);
    p.go(p.to(-80, 100));
    p.cutter.flush();
    REQUIRE(p.out.taken.size() == 4);
    CHECK(p.out.taken[2].m_code == 8);
    CHECK(p.out.taken[1].move.marks.line == 2);
    CHECK(p.out.taken[3].move.marks.line == 3);
}

}  // namespace trunnion
