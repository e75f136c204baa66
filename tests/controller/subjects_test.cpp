// Subjects of the control, each with the owners that it needs and no whole control.
#include <catch2/catch.hpp>
#include <cmath>

#include "controller/arc_3d.h"
#include "controller/arcs.h"
#include "controller/commanded.h"
#include "controller/cycles.h"
#include "controller/reference_points.h"
#include "controller/shapes.h"
#include "controller/signal_variables.h"
#include "controller/skip.h"
#include "controller/tool_length.h"
#include "controller/work_frames.h"
#include "parts.h"

namespace trunnion {

using bench::Parts;

TEST_CASE("commanded position: G90, G91 and G16 about the zero of the coordinates") {
    Parts p;
    p.frames.stand_at(p.at(10, 20, 30));
    p.say({{'X', 1.0}});
    CHECK(controller::commanded_position(p.words, p.modal, p.frames)[Axis::X] == 1.0);
    p.modal.codes.set(controller::ModalGroup::distance, 910);
    CHECK(controller::commanded_position(p.words, p.modal, p.frames)[Axis::X] == 11.0);
    p.modal.codes.set(controller::ModalGroup::distance, 900);
    p.modal.codes.set(controller::ModalGroup::polar_words, 160);
    p.say({{'X', 10.0}, {'Y', 90.0}});
    const offsets::ControlPosition polar =
        controller::commanded_position(p.words, p.modal, p.frames);
    CHECK(polar[Axis::X] == Approx(0.0).margin(1e-12));
    CHECK(polar[Axis::Y] == Approx(10.0));
    CHECK(p.modal.polar_angle_deg == 90.0);
}

TEST_CASE("work frames: a shift moves nothing and the program position is counted anew") {
    Parts p;
    p.stores.work.standard[1][Axis::X] = 100.0;
    p.frames.stand_at(p.at(130, 0, 0));
    controller::set_work_offset(p.words, p.modal, p.frames, p.mover, 550);
    CHECK(p.frames.program[Axis::X] == 30.0);
    p.say({{'X', 5.0}});
    controller::set_local_shift(p.words, p.modal, p.frames, p.mover);
    CHECK(p.frames.program[Axis::X] == 25.0);
    p.say({{'X', 0.0}});
    controller::preset_position(p.words, p.modal, p.frames, p.mover);
    CHECK(p.frames.program[Axis::X] == 0.0);
    CHECK(p.frames.machine[Axis::X] == 130.0);
    CHECK(p.sink.moves.empty());
}

TEST_CASE("tool length: the program position stands and the axis still has to go there") {
    Parts p;
    p.stores.tools.tool[3].length_geometry_mm = 80.0;
    p.say({{'H', 3.0}});
    controller::set_tool_length(p.words, p.modal, p.frames, p.mover, 430);
    CHECK(p.frames.length_moves);
    CHECK(p.frames.program[Axis::Z] == 0.0);
    p.mover.line(motion::MotionKind::rapid, p.frames.program);
    CHECK(p.frames.machine[Axis::Z] == 80.0);
    CHECK(p.frames.shown_length()[Axis::Z] == 80.0);
    p.say({{'H', 1000.0}});
    CHECK_THROWS_AS(controller::set_tool_length(p.words, p.modal, p.frames, p.mover, 430), Alarm);
}

TEST_CASE("G28 goes by the intermediate point, G29 comes back by it") {
    Parts p;
    controller::ReferencePoints points;
    p.modal.settings.reference[0][index_of(Axis::Z)] = 500.0;
    p.frames.stand_at(p.at(1, 2, 3));
    p.say({{'Z', 100.0}});
    points.go(p.words, p.modal, p.frames, p.mover, 280);
    REQUIRE(p.sink.moves.size() == 2);
    CHECK(p.sink.moves[0].to[Axis::Z] == 100.0);
    CHECK(p.frames.machine[Axis::Z] == 500.0);
    CHECK(p.frames.length_parked);
    p.say({{'Z', 7.0}});
    points.come_back(p.words, p.modal, p.frames, p.mover);
    CHECK(p.sink.moves[2].to[Axis::Z] == 100.0);
    CHECK(p.sink.moves[3].to[Axis::Z] == 7.0);
}

TEST_CASE("a pecking cycle cuts its depth in steps of Q and needs Q") {
    Parts p;
    controller::CycleData cycle;
    p.frames.stand_at(p.at(0, 0, 10));
    controller::start_cycle(cycle, p.modal, p.frames, 830);
    p.say({{'X', 5.0}, {'Z', -7.0}, {'R', 1.0}, {'Q', 4.0}});
    controller::run_cycle(cycle, p.words, p.modal, p.frames, p.mover);
    std::vector<double> cut;
    for (const motion::AxisMove& m : p.sink.moves)
        if (m.kind == motion::MotionKind::linear) cut.push_back(m.to[Axis::Z]);
    CHECK(cut == std::vector<double>{-3.0, -7.0});
    CHECK(p.frames.program[Axis::Z] == 10.0);
    cycle.peck = 0.0;
    p.say({{'X', 6.0}});
    CHECK_THROWS_AS(controller::run_cycle(cycle, p.words, p.modal, p.frames, p.mover), Alarm);
}

TEST_CASE("a mirror turns an arc round and keeps its radius") {
    Parts p;
    p.frames.stand_at(p.at(10, 0, 0));
    p.say({{'X', 0.0}});
    controller::set_mirror(p.words, p.modal, p.frames, p.mover);
    CHECK(p.frames.program[Axis::X] == -10.0);
    p.modal.codes.set(controller::ModalGroup::motion, 20);
    p.say({{'X', 0.0}, {'Y', 10.0}, {'I', 10.0}});
    controller::move_arc_block(p.words, p.modal, p.frames, p.mover);
    const motion::AxisMove& arc = p.sink.moves.back();
    REQUIRE(arc.arc);
    CHECK(arc.arc->sweep_rad == Approx(pi / 2));  // clockwise as programmed
    CHECK(arc.to[Axis::Y] == 10.0);
    CHECK(arc.length_mm == Approx(5 * pi));
}

TEST_CASE("skip: the place of the trigger, or where it ends, and no feed without an axis word") {
    Parts p;
    controller::SkipState skip;
    p.sink.trigger_at = 0.5;
    p.say({{'X', 8.0}});
    controller::skip_move(skip, p.words, p.modal, p.frames, p.mover);
    CHECK(skip.triggered);
    CHECK(skip.work[Axis::X] == 4.0);
    p.modal.block.feed = {};
    p.say({});
    controller::skip_move(skip, p.words, p.modal, p.frames, p.mover);
    CHECK_FALSE(skip.triggered);
    CHECK(p.sink.moves.size() == 1);
}

TEST_CASE("an arc in space bends by more than 1e-9 of its chords") {
    const Vector3 start(0, 0, 0), end(1000, 0, 0);
    CHECK_FALSE(controller::arc_through(start, {500, 4e-7, 0}, end));
    const auto arc = controller::arc_through(start, {500, 0.01, 0}, end);
    REQUIRE(arc);
    CHECK(arc->centre.y() == Approx(0.01 / 2 - 500.0 * 500.0 / (2 * 0.01)));  // sagitta
    CHECK(arc->normal.z() == Approx(-1.0));
    CHECK(arc->sweep_rad == Approx(4.0 * std::atan2(0.01, 500.0)));
    for (const Vector3& middle : {start, end})
        CHECK_FALSE(controller::arc_through(start, middle, end));
    // More than half a turn; the direction follows from the point on the way.
    const auto long_way = controller::arc_through({1, 0, 0}, {-1, 0, 0}, {0, -1, 0});
    REQUIRE(long_way);
    CHECK(long_way->sweep_rad == Approx(1.5 * pi));
    CHECK(long_way->normal.z() == Approx(1.0));
}

TEST_CASE("#3011 and #3012 are the date and the time of day, with the run") {
    const controller::ClockVariables clock(951868740);  // 2000-02-29 23:59:00
    CHECK(clock.get(3011, 0.0) == 20000229.0);
    CHECK(clock.get(3012, 0.0) == 235900.0);
    CHECK(clock.get(3012, 37.9) == 235937.0);
    CHECK(clock.get(3011, 60.0) == 20000301.0);
    CHECK(clock.get(3012, 3723.0) == 10103.0);
    CHECK_FALSE(clock.get(3013, 0.0));
}

}  // namespace trunnion
