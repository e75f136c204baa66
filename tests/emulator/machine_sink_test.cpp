#include "emulator/machine_sink.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "base/units.h"
#include "emulator/run.h"
#include "kinematics/machine.h"
#include "records/samples.h"

using namespace trunnion;

namespace {

setup::Setup bc_setup() {
    std::vector<std::string> notes;
    setup::Setup setup = setup::load_setup(TRUNNION_SOURCE_DIR "/machines/bc_table.toml", notes);
    setup.probe->repeatability_um = 0.0;
    setup.ballbar->noise_um = 0.0;
    return setup;
}

AxisPositions at(double x, double y, double z, double b_deg = 0.0, double c_deg = 0.0) {
    AxisPositions q;
    q[Axis::X] = x, q[Axis::Y] = y, q[Axis::Z] = z;
    q[Axis::B] = rad_from_deg(b_deg), q[Axis::C] = rad_from_deg(c_deg);
    return q;
}

motion::AxisMove line(const AxisPositions& from, const AxisPositions& to, bool skip = false) {
    motion::AxisMove move;
    move.kind = skip ? motion::MotionKind::linear : motion::MotionKind::rapid;
    move.until_skip = skip;
    move.from = from;
    move.to = to;
    move.length_mm = (Vector3(to[Axis::X], to[Axis::Y], to[Axis::Z]) -
                      Vector3(from[Axis::X], from[Axis::Y], from[Axis::Z]))
                         .norm();
    move.feed_mm_min = skip ? 60.0 : 0.0;
    move.duration_s = skip ? move.length_mm : 0.5;
    return move;
}

motion::AxisMove circle_xy(const Vector3& centre, double radius, double turns, double feed_mm_min) {
    motion::AxisMove move;
    move.kind = turns > 0 ? motion::MotionKind::arc_ccw : motion::MotionKind::arc_cw;
    move.from = move.to = at(centre.x() + radius, centre.y(), centre.z());
    move.arc = motion::ArcPath{centre, Vector3::UnitZ(), turns, 2 * pi * turns};
    move.length_mm = 2 * pi * radius * std::abs(turns);
    move.feed_mm_min = feed_mm_min;
    move.duration_s = move.length_mm / feed_mm_min * 60.0;
    return move;
}

/// Every simulated reading against what the replay predicts for its row.
double worst_prediction_mm(const setup::Setup& setup, const records::ReadingTable& table,
                           const emulator::EffectModels& models) {
    std::vector<std::string> notes;
    const records::ReadingTable read =
        records::parse_readings(records::format_readings(table), "r.csv", notes);
    const records::ReadingTable said = emulator::predicted(setup, read, models);
    double worst = 0.0;
    for (std::size_t i = 0; i < table.rows.size(); ++i)
        if (table.rows[i].device != records::Device::none)
            worst = std::max(worst, std::abs(*table.rows[i].value_mm - *said.rows[i].value_mm));
    return worst;
}

struct Pretravel : emulator::EffectModel {
    void perturb(const AxisSample&, const emulator::Contact&,
                 kinematics::Perturbation& out) const override {
        out.reading_mm += 0.005;
    }
};

struct Backlash : emulator::EffectModel {
    void perturb(const AxisSample& sample, const emulator::Contact&,
                 kinematics::Perturbation& out) const override {
        out.axis[Axis::X] += 0.004 * sample.travel[index_of(Axis::X)];
        out.axis[Axis::C] += 3e-5 * sample.travel[index_of(Axis::C)];
    }
};

}  // namespace

TEST_CASE("G31 stops where the stylus ball meets the sphere") {
    const setup::Setup setup = bc_setup();  // sphere 25.4 at (120, 0, 80), ball 6, stylus 150
    emulator::MachineSink sink(setup, {}, {});
    sink.place(at(170, 0, 230));
    const motion::MoveResult result = sink.move(line(at(170, 0, 230), at(120, 0, 230), true));
    REQUIRE(result.skipped);
    CHECK(std::abs(result.stopped[Axis::X] - (120 + 12.7 + 3)) < 1e-9);
    CHECK(sink.clock_s() == Approx(170 - 135.7));
    const records::ReadingTable table = sink.take_readings();
    REQUIRE(table.rows.size() == 2);
    CHECK(table.rows[0].device == records::Device::none);
    CHECK(table.rows[0].commanded == at(170, 0, 230));
    CHECK(table.rows[1].device == records::Device::touch);
    CHECK(table.rows[1].commanded == at(120, 0, 230));
    CHECK(table.rows[1].direction_M == Vector3(-1, 0, 0));
    CHECK(std::abs(*table.rows[1].value_mm + 15.7) < 1e-9);
    CHECK(table.rows[1].feature == "S1");
}

TEST_CASE("a path that misses runs to its end, and another tool feels nothing") {
    const setup::Setup setup = bc_setup();
    emulator::MachineSink sink(setup, {}, {});
    CHECK_FALSE(sink.move(line(at(170, 0, 280), at(120, 0, 280), true)).skipped);
    motion::AxisMove move = line(at(170, 0, 230), at(120, 0, 230), true);
    move.tool = 2;
    CHECK_FALSE(sink.move(move).skipped);
    CHECK(sink.take_readings().rows.empty());
}

TEST_CASE("pretravel comes on top along the approach, repeatability is seeded") {
    setup::Setup setup = bc_setup();
    const motion::AxisMove move = line(at(170, 0, 230), at(120, 0, 230), true);
    const emulator::EffectModels later{std::make_shared<Pretravel>()};
    emulator::MachineSink one(setup, later, {});
    CHECK(std::abs(one.move(move).stopped[Axis::X] - (135.7 - 0.005)) < 1e-9);
    setup.probe->repeatability_um = 0.5;
    emulator::SinkOptions options;
    options.seed = 9;
    emulator::MachineSink a(setup, later, options), b(setup, later, options);
    const double x = a.move(move).stopped[Axis::X];
    CHECK(x == b.move(move).stopped[Axis::X]);
    CHECK(std::abs(x - 135.695) > 1e-9);
    CHECK(std::abs(x - 135.695) < 3e-3);
}

TEST_CASE("rows know the function that placed the axes, and the approach of every axis") {
    const setup::Setup setup = bc_setup();
    emulator::MachineSink sink(setup, {}, {});
    motion::AxisMove turn = line(at(0, 0, 300), at(0, 0, 300, 20, 5));
    turn.mode = PositioningMode::rtcp;
    sink.move(turn);
    sink.move(line(at(0, 0, 300, 20, 5), at(-60, 0, 300, 20, 0)));  // turns without a function: dpp
    sink.move(line(at(-60, 0, 300, 20, 0), at(-60, 0, 400, 20, 0)));
    turn = line(at(-60, 0, 400, 20, 0), at(-60, 0, 400, 0, 90));
    turn.mode = PositioningMode::tw;
    sink.move(turn);
    sink.move(
        line(at(-60, 0, 400, 0, 90), at(0, -100, 300, 0, 90)));  // cancelled, no turn: still tw
    sink.move(line(at(0, -100, 300, 0, 90), at(0, -120, 200, 0, 90), true));
    const records::ReadingTable table = sink.take_readings();
    REQUIRE(table.rows.back().device == records::Device::touch);
    CHECK(table.rows.back().mode == PositioningMode::tw);
    const AxisSample sample = records::samples_of(table).back();
    CHECK(sample.travel[index_of(Axis::X)] == 1);
    CHECK(sample.travel[index_of(Axis::Y)] == -1);
    CHECK(sample.travel[index_of(Axis::Z)] == -1);
    CHECK(sample.travel[index_of(Axis::B)] == -1);
    CHECK(sample.travel[index_of(Axis::C)] == 1);
}

TEST_CASE("the ballbar reads along a circle, by time, and out of range it says so") {
    setup::Setup setup = bc_setup();
    setup.ballbar->sample_hz = 10.0;
    setup.machine.errors.location(*kinematics::parse_error_name("EC0Y")) = 1e-4;  // squareness
    emulator::MachineSink sink(setup, {}, {});
    const Vector3 centre(75, 0, 230);
    const motion::AxisMove move = circle_xy(centre, 100, 1, 1000);
    sink.printed("BALLBAR ON XY CCW 1000\n");
    sink.move(move);
    sink.printed("BALLBAR OFF\n");
    sink.move(move);
    records::ReadingTable table = sink.take_readings();
    const auto expected = static_cast<std::size_t>(std::ceil(move.duration_s * 10.0));
    REQUIRE(table.rows.size() == expected);
    for (const records::Reading& row : table.rows) {
        CHECK(row.test == "xy_ccw_1000");
        const double x = row.commanded[Axis::X] - 75, y = row.commanded[Axis::Y];
        CHECK(*row.value_mm == Approx(-1e-4 * x * y / 100).margin(2e-6));
    }
    setup.ballbar->length_mm = 98.5;
    emulator::MachineSink other(setup, {}, {});
    other.printed("BALLBAR ON RADIAL A POS\n");
    other.move(move);
    table = other.take_readings();
    for (const records::Reading& row : table.rows) CHECK(row.device == records::Device::none);
    const auto notes = other.take_notes();
    REQUIRE(notes.size() == 1);
    CHECK_THAT(notes[0],
               Catch::Contains("out of its range of 1 mm") && Catch::Contains("radial_A_pos"));
}

TEST_CASE(
    "a ballbar reads when it is asked: by the program, or along feed moves that stay in range") {
    setup::Setup setup = bc_setup();
    setup.ballbar->sample_hz = 10.0;
    const auto table_of = [&](bool automatic) {
        emulator::SinkOptions options;
        options.automatic_ballbar = automatic;
        emulator::MachineSink sink(setup, {}, options);
        sink.move(line(at(0, 0, 400), at(300, 0, 400)));
        sink.move(circle_xy(Vector3(75, 0, 230), 100, 1, 2000));
        sink.move(line(at(175, 0, 230), at(0, 0, 400)));
        sink.move(circle_xy(Vector3(75, 0, 230), 100, -1, 2000));
        CHECK(sink.take_notes().empty());
        return sink.take_readings();
    };
    CHECK(table_of(false).rows.empty());
    const records::ReadingTable table = table_of(true);
    CHECK(worst_prediction_mm(setup, table, {}) < 1e-12);
    std::map<std::string, int> tests;
    for (const records::Reading& row : table.rows)
        if (row.device == records::Device::ballbar) ++tests[row.test];
    CHECK(tests.size() == 2);
    CHECK(tests["bar1"] == tests["bar2"]);
}

TEST_CASE("sampling by angle") {
    setup::Setup setup = bc_setup();
    setup.ballbar->sample_deg = 1.5;
    emulator::MachineSink sink(setup, {}, {});
    sink.printed("BALLBAR ON XY\r\n");
    sink.move(circle_xy(Vector3(75, 0, 230), 100, 0.999, 2000));
    CHECK(sink.take_readings().rows.size() == 240);
}

TEST_CASE("what a run reads is what the replay predicts from its rows") {
    setup::Setup setup = bc_setup();
    setup.ballbar->sample_hz = 50.0;
    for (const char* name : {"EX0B", "EZ0B", "EX0C", "EY0C"})
        setup.machine.errors.location(*kinematics::parse_error_name(name)) = 0.02;
    for (const char* name : {"EA0B", "EC0B", "EA0C", "EB0C"})
        setup.machine.errors.location(*kinematics::parse_error_name(name)) = 5e-5;
    for (const bool with_effect : {false, true}) {
        emulator::EffectModels models;
        if (with_effect) models.push_back(std::make_shared<Backlash>());
        emulator::MachineSink sink(setup, models, {});
        AxisPositions here = at(0, 0, 400);
        sink.place(here);
        const auto go = [&](const AxisPositions& to, bool skip = false) {
            const motion::MoveResult result = sink.move(line(here, to, skip));
            here = result.skipped ? result.stopped : to;
            return result.skipped;
        };
        go(at(1, 1, 401, 1, -1));  // before its first motion an axis has no direction
        int touches = 0;
        for (const double c : {0.0, 50.0, -40.0, 130.0}) {
            const Vector3 s =
                rotation_about(Vector3::UnitZ(), rad_from_deg(-c)) * Vector3(120, 0, 80);
            go(at(s.x(), s.y(), 400, 0, c));
            for (const Vector3& d :
                 {Vector3(1, 0, 0), Vector3(-1, 0, 0), Vector3(0, 1, 0), Vector3(0, 0, 1)}) {
                const Vector3 from = s + 40 * d + Vector3(0, 0, 150), end = s + Vector3(0, 0, 150);
                go(at(from.x(), from.y(), 400, 0, c));
                go(at(from.x(), from.y(), from.z(), 0, c));
                touches += go(at(end.x(), end.y(), end.z(), 0, c), true);
                go(at(from.x(), from.y(), from.z(), 0, c));
                go(at(from.x(), from.y(), 400, 0, c));
            }
        }
        sink.printed("BALLBAR ON XY\n");
        go(at(175, 0, 230));
        sink.move(circle_xy(Vector3(75, 0, 230), 100, 1, 3000));
        const records::ReadingTable table = sink.take_readings();
        CHECK(touches == 16);
        CHECK(worst_prediction_mm(setup, table, models) < 1e-12);
    }
}

TEST_CASE("trace rows hold the contract's columns and the physical tip") {
    setup::Setup setup = bc_setup();
    setup.machine.errors.location(*kinematics::parse_error_name("EX0C")) = 0.02;
    emulator::SinkOptions options;
    options.trace = options.truth = true;
    options.trace_step_mm = 10.0;
    emulator::MachineSink sink(setup, {}, options);
    motion::AxisMove move = line(at(0, 0, 200), at(35, 0, 200));
    move.kind = motion::MotionKind::linear;
    move.tool_vector_mm = Vector3(0, 0, 150);
    const std::string name = "o1.nc";
    move.program = &name;
    move.line = 7;
    sink.move(move);
    const std::string trace = sink.take_trace();
    std::vector<std::string> lines;
    for (std::size_t i = 0, end; i < trace.size(); i = end + 1) {
        end = trace.find('\n', i);
        lines.push_back(trace.substr(i, end - i));
    }
    REQUIRE(lines.size() == 5);
    CHECK_THAT(lines[0], Catch::StartsWith(
                             "seq,program,line,motion,tool,feed_mm_min,x_mm,y_mm,z_mm,b_deg,c_deg,"
                             "tip_x_mm,tip_y_mm,tip_z_mm,tool_i,tool_j,tool_k,length_mm,time_s") &&
                             Catch::EndsWith("true_x_mm,true_y_mm,true_z_mm"));
    CHECK_THAT(lines[1], Catch::StartsWith("0,o1.nc,7,SAMPLE,0,0,10,0,200,0,0,10,0,50,0,0,1,10,"));
    CHECK_THAT(lines[4],
               Catch::StartsWith("3,o1.nc,7,G1,0,0,35,0,200,0,0,35,0,50,0,0,1,35,0.5,,,,,,,,"));
    CHECK_THAT(lines[4], Catch::EndsWith(",34.98,0,50"));
}

TEST_CASE("trace rows follow a curve while the tip rests, by step or by chord") {
    const setup::Setup setup = bc_setup();
    interpreter::ProgramsInMemory none;
    const auto rows = [&](double step_mm, double chord_mm) {
        emulator::RunOptions options;
        options.trace = true;
        options.trace_step_mm = step_mm;
        options.trace_chord_mm = chord_mm;
        // The tip stays at X80 of the table, so the axes run a quarter circle of 80 mm or so.
        const emulator::RunLog log = emulator::run_program(
            setup, none,
            interpreter::ProgramText{
                "c.nc", "G90 G21 G54\nG0 B0 C0\nG43.4 H1 X80. Y0 Z0\nC90.\nM30\n", nullptr},
            options);
        REQUIRE(log.result.status == controller::RunStatus::ok);
        return std::count(log.trace_csv.begin(), log.trace_csv.end(), '\n') - 1;
    };
    const auto plain = rows(0, 0);
    CHECK(std::abs(rows(10, 0) - plain - (12 + 17)) <= 2);  // 80 pi / 2 = 126; the way there, 170
    const double rise_mm = 80.0 * (1.0 - std::cos(pi / 16));
    CHECK(rows(0, 1.05 * rise_mm) == plain + 3);  // three places between four chords
    CHECK(rows(0, 0.95 * rise_mm) == plain + 7);
}

TEST_CASE("trace rows follow the tip on a turning table while X Y Z are at rest") {
    const setup::Setup setup = bc_setup();
    interpreter::ProgramsInMemory none;
    emulator::RunOptions options;
    options.trace = true;
    options.trace_step_mm = 10.0;
    const emulator::RunLog log = emulator::run_program(
        setup, none,
        interpreter::ProgramText{"c.nc", "G90 G21 G53 X80. Y0 Z0\nG1 C90. F500.\nM30\n", nullptr},
        options);
    REQUIRE(log.result.status == controller::RunStatus::ok);
    int samples = 0;
    for (std::size_t at = 0; (at = log.trace_csv.find(",2,SAMPLE,", at)) != std::string::npos; ++at)
        ++samples;
    CHECK(samples == 12);  // 80 pi / 2 = 126 mm
}

TEST_CASE("trace rows follow the axes of M128 while the tip has no way to go") {
    setup::Setup setup = bc_setup();
    setup.dialect = interpreter::hurco_dialect();
    interpreter::ProgramsInMemory none;
    emulator::RunOptions options;
    options.trace = true;
    options.trace_step_mm = 10.0;
    // The ends are 80 mm from the C axis; without G43.4 X and Y run along the chord between them.
    const emulator::RunLog log = emulator::run_program(
        setup, none,
        interpreter::ProgramText{
            "c.nc", "G90 G21 G54\nT1 M6\nG0 X80. Y0 Z0\nM128\nG1 C90. F500.\nM30\n", nullptr},
        options);
    REQUIRE(log.result.status == controller::RunStatus::ok);
    int samples = 0;
    for (std::size_t at = 0; (at = log.trace_csv.find(",5,SAMPLE,", at)) != std::string::npos; ++at)
        ++samples;
    CHECK(samples == 11);  // 80 sqrt(2) = 113 mm
}
