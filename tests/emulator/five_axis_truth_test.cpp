// Programs of five-axis functions on every machine in machines/, told the truth: where the physical
// tip really goes.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <memory>

#include "base/random.h"
#include "base/units.h"
#include "controller/controller.h"
#include "emulator/run.h"
#include "setup/setup.h"

namespace trunnion {

namespace {

std::vector<std::string> machine_files() {
    std::vector<std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(TRUNNION_SOURCE_DIR "/machines"))
        if (entry.path().extension() == ".toml") files.push_back(entry.path().string());
    std::sort(files.begin(), files.end());
    return files;
}

/// The setup without errors, its control told the truth. Nothing for machines without two rotaries.
std::optional<setup::Setup> truthful(const std::string& path) {
    std::vector<std::string> notes;
    setup::Setup setup = setup::load_setup(path, notes);
    setup.machine.errors = {};
    setup.effects.clear();
    for (int number = 19666; number <= 19744; ++number) setup.stores.parameters.entry.erase(number);
    if (!setup::derive_pivot_parameters(setup.machine, setup.stores.parameters).empty())
        return std::nullopt;
    setup.stores.tools.tool[1] = {};
    setup.stores.tools.tool[1].length_geometry_mm = 137.5;
    setup.stores.work = {};
    for (kinematics::AxisGeometry& axis : setup.machine.chain.work)
        axis.min = axis.max = std::nullopt;
    for (kinematics::AxisGeometry& axis : setup.machine.chain.tool)
        axis.min = axis.max = std::nullopt;
    return setup;
}

/// Looks at the physical tip at seven places of each move.
struct TipWatcher : motion::MotionSink {
    explicit TipWatcher(const kinematics::Machine& machine) : machine(machine) {}
    motion::MoveResult move(const motion::AxisMove& m) override {
        seen.clear();
        for (int k = 0; k <= 6; ++k) seen.push_back(machine.tip_W(m.at(k / 6.0), {0, 0, -137.5}));
        last = m.to;
        return {};
    }
    Vector3 direction_W() const {
        const kinematics::MachinePose pose = machine.poses(last);
        return pose.pose_MW.rotation.transpose() * pose.pose_MS.rotation * Vector3::UnitZ();
    }
    const kinematics::Machine& machine;
    std::vector<Vector3> seen;
    AxisPositions last;
};

controller::RunResult run_text(const setup::Setup& setup, offsets::Stores& stores,
                               motion::MotionSink& sink, const std::string& text) {
    interpreter::ProgramsInMemory programs;
    controller::Controller control(emulator::control_config(setup), stores, programs, sink,
                                   [](std::string_view) {});
    const auto owner = std::make_shared<std::string>(text);
    return control.run(interpreter::ProgramText{"test", *owner, owner});
}

std::vector<Axis> rotaries(const setup::Setup& setup) {
    std::vector<Axis> out;
    for (const kinematics::AxisGeometry& axis : setup.machine.chain.axes())
        if (axis.rotary) out.push_back(axis.axis);
    return out;
}

}  // namespace

TEST_CASE("G43.4 on every machine: the physical tip runs straight to the programmed point") {
    SeededNoise noise(7);
    int machines = 0;
    for (const std::string& path : machine_files()) {
        const auto setup = truthful(path);
        if (!setup) continue;
        ++machines;
        INFO(path);
        const auto turn = rotaries(*setup);
        std::string program = "G90 G21 G54 G94\nG43.4 H1 X0 Y0 Z0\n";
        Vector3 target;
        for (int block = 0; block < 12; ++block) {
            for (int i = 0; i < 3; ++i)
                target[i] = std::round(150e3 * (noise.uniform() - 0.5)) / 1e3;
            program += fmt::format("G1 X{:.3f} Y{:.3f} Z{:.3f} {}{:.3f} {}{:.3f} F1000.\n",
                                   target.x(), target.y(), target.z(), letter_of(turn[0]),
                                   140 * (noise.uniform() - 0.5), letter_of(turn[1]),
                                   300 * (noise.uniform() - 0.5));
            TipWatcher observer(setup->machine);
            offsets::Stores stores = setup->stores;
            const controller::RunResult result = run_text(*setup, stores, observer, program);
            REQUIRE(result.status == controller::RunStatus::ok);
            REQUIRE(observer.seen.size() == 7);
            CHECK((observer.seen.back() - target).norm() < 1e-9);
            const Vector3 start = observer.seen.front();
            for (int k = 0; k <= 6; ++k)
                CHECK((observer.seen[static_cast<std::size_t>(k)] - start -
                       k / 6.0 * (target - start))
                          .norm() < 1e-9);
        }
    }
    CHECK(machines >= 5);
}

TEST_CASE("G68.2 and G53.1 on every machine: the physical tool stands square on the plane") {
    SeededNoise noise(8);
    int reached = 0;
    for (const std::string& path : machine_files()) {
        const auto setup = truthful(path);
        if (!setup) continue;
        INFO(path);
        for (int k = 0; k < 30; ++k) {
            const auto typed = [&](double size) { return std::round(size * noise.uniform()); };
            const double i = typed(360), j = typed(50) + 0.125, turn = typed(360);
            const Vector3 origin(typed(20), -30, 15), point(11, -7, 3.5);
            const Matrix3 frame = rotation_about(Vector3::UnitZ(), rad_from_deg(i)) *
                                  rotation_about(Vector3::UnitX(), rad_from_deg(j)) *
                                  rotation_about(Vector3::UnitZ(), rad_from_deg(turn));
            TipWatcher observer(setup->machine);
            offsets::Stores stores = setup->stores;
            const controller::RunResult result = run_text(
                *setup, stores, observer,
                fmt::format("G90 G21 G54\nG68.2 X{:.3f} Y{:.3f} Z{:.3f} I{:.3f} J{:.3f} K{:.3f}\n"
                            "G53.1 P{}\nG43 H1 G0 X11. Y-7. Z3.5\n",
                            origin.x(), origin.y(), origin.z(), i, j, turn, k % 3));
            INFO((result.alarm ? fmt::format("{} {} line {}", result.alarm->number,
                                             result.alarm->text, result.alarm->where.line)
                               : ""));
            REQUIRE(result.status == controller::RunStatus::ok);
            ++reached;
            CHECK((observer.seen.back() - origin - frame * point).norm() < 1e-9);
            CHECK(observer.direction_W().cross(frame.col(2)).norm() < 1e-12);
            CHECK(observer.direction_W().dot(frame.col(2)) > 0);
        }
    }
    CHECK(reached >= 150);
}

namespace {

/// What a post-processor knows: the true machine, a point of the table, and where to bring it.
struct Post {
    const setup::Setup& setup;
    AxisPositions angles;

    kinematics::MachinePose pose() const { return setup.machine.poses(angles); }
    /// Gauge point that puts the tip on q_W.
    Vector3 gauge(const Vector3& q_W) const {
        return pose().pose_MW * q_W - pose().pose_MS * Vector3(0, 0, -137.5);
    }
    std::string turn() const {
        std::string words;
        for (const Axis axis : rotaries(setup))
            words += fmt::format(" {}{:.6f}", letter_of(axis), deg_from_rad(angles[axis]));
        return words;
    }
};

std::string at(const Vector3& v) {
    return fmt::format(" X{:.12f} Y{:.12f} Z{:.12f}", v.x(), v.y(), v.z());
}

/// Where the axes stand after a program.
Vector3 reached(const setup::Setup& setup, const std::string& program, PositioningMode mode) {
    struct Last : motion::MotionSink {
        motion::MoveResult move(const motion::AxisMove& m) override {
            to = m.to;
            mode = m.mode;
            return {};
        }
        AxisPositions to;
        PositioningMode mode = PositioningMode::none;
    } last;
    offsets::Stores stores = setup.stores;
    const controller::RunResult result =
        run_text(setup, stores, last, "G90 G21 G94 G0\n" + program);
    INFO((result.alarm ? fmt::format("{} line {}", result.alarm->number, result.alarm->where.line)
                       : ""));
    REQUIRE(result.status == controller::RunStatus::ok);
    CHECK(last.mode == mode);
    return {last.to[Axis::X], last.to[Axis::Y], last.to[Axis::Z]};
}

std::string by_tcp(const Post& post, const Vector3& q) {
    return "G54\nG43.4 H1 X0 Y0 Z50.\n" + at(q) + post.turn() + '\n';
}

/// The plane square to the tool as it stands, from two vectors.
std::string by_plane(const Post& post, const Vector3& q) {
    const kinematics::MachinePose pose = post.pose();
    const Vector3 n = pose.pose_MW.rotation.transpose() * pose.pose_MS.rotation.col(2);
    const Vector3 x = n.unitOrthogonal(), origin(1, 2, 3);
    Matrix3 frame;
    frame << x, n.cross(x), n;
    const auto vector = [](const Vector3& v) {
        return fmt::format(" I{:.13f} J{:.13f} K{:.13f}\n", v.x(), v.y(), v.z());
    };
    return "G54" + post.turn() + "\nG68.2 P3 Q1" + at(origin) + vector(x) + "G68.2 P3 Q2" +
           vector(n) + "G53.1\nG43 H1" + at(frame.transpose() * (q - origin)) + '\n';
}

/// The table's rotaries meet in one point and each turns in a plane of the axes: G54.2 can do it.
std::optional<Vector3> fixture_centre(const setup::Setup& setup) {
    std::optional<Vector3> centre;
    for (const kinematics::AxisGeometry& axis : setup.machine.chain.work) {
        if (!axis.rotary) continue;
        if (axis.direction.cwiseAbs().maxCoeff() < 1 - 1e-12) return std::nullopt;
        if (centre && *centre != axis.point_mm) return std::nullopt;
        centre = axis.point_mm;
    }
    return centre;
}

std::string by_fixture(const Post& post, const Vector3& q) {
    const Vector3 words = post.pose().pose_MW.rotation * q + post.gauge(q) -
                          post.pose().pose_MW * q - Vector3(0, 0, 137.5);
    return "G55 G54.2 P1\nG43 H1" + at(words) + post.turn() + '\n';
}

}  // namespace

TEST_CASE("one point by DPP, G54.2, G43.4 and G68.2/G53.1: one place of the axes, any machine") {
    SeededNoise noise(9);
    int machines = 0, with_fixture = 0;
    for (const std::string& path : machine_files()) {
        auto setup = truthful(path);
        if (!setup) continue;
        INFO(path);
        ++machines;
        const auto centre = fixture_centre(*setup);
        with_fixture += centre.has_value();
        for (const std::size_t i : {0U, 1U, 2U}) {
            const double c = centre ? (*centre)[static_cast<int>(i)] : 0.0;
            setup->stores.work.standard[1].value[i] = c;
            setup->stores.fixture.set[0].offset.value[i] = -c;
        }
        for (int k = 0; k < 40; ++k) {
            Post post{*setup, {}};
            const auto turn = rotaries(*setup);
            const auto typed = [&](double size) {
                return std::round(size * 1e3 * (noise.uniform() - 0.5)) / 1e3;
            };
            post.angles[turn[0]] = rad_from_deg(typed(140));
            post.angles[turn[1]] = rad_from_deg(typed(300));
            const Vector3 q(typed(150), typed(150), typed(150)), gauge = post.gauge(q);
            const Vector3 length(0, 0, 137.5);
            const Vector3 dpp = reached(*setup, "G54 G43 H1" + at(gauge - length) + post.turn(),
                                        PositioningMode::dpp);
            CHECK((dpp - gauge).norm() < 1e-9);
            CHECK((reached(*setup, by_tcp(post, q), PositioningMode::rtcp) - dpp).norm() < 1e-9);
            CHECK((reached(*setup, by_plane(post, q), PositioningMode::tw) - dpp).norm() < 1e-9);
            if (!centre) continue;
            CHECK((reached(*setup, by_fixture(post, q), PositioningMode::rtdfo) - dpp).norm() <
                  1e-9);
        }
    }
    CHECK(machines >= 6);
    CHECK(with_fixture >= 3);
}

TEST_CASE("heads and mixed machines whose stores are wrong move by the closed forms") {
    SeededNoise noise(10);
    const Vector3 dp(0.08, 0.06, -0.07), dt(0.15, -0.12, 0.16), ds(-0.15, 0.11, 0.06);
    const auto add = [](setup::Setup& setup, int number, const Vector3& d) {
        for (int i = 0; i < 3; ++i)
            setup.stores.parameters.set(number + i, setup.stores.parameters.get(number + i) + d[i]);
    };
    int machines = 0;
    for (const char* file : {"head_head", "nutating_head", "head_table"}) {
        const auto setup = truthful(fmt::format("{}/machines/{}.toml", TRUNNION_SOURCE_DIR, file));
        REQUIRE(setup);
        INFO(file);
        ++machines;
        const bool mixed = setup->stores.parameters.get(19680) == 21;
        setup::Setup wrong = *setup;
        add(wrong, 19709, dt);
        add(wrong, mixed ? 19700 : 19712, mixed ? dp : ds);
        for (int k = 0; k < 40; ++k) {
            Post post{*setup, {}};
            const auto turn = rotaries(*setup);
            post.angles[turn[0]] = rad_from_deg(std::round(140 * (noise.uniform() - 0.5)));
            post.angles[turn[1]] = rad_from_deg(std::round(300 * (noise.uniform() - 0.5)));
            const Vector3 q(30 * noise.uniform(), 20, -10);
            const kinematics::MachinePose pose = post.pose();
            // The head whole, and its first axis alone (the second at zero).
            const Matrix3 whole = pose.pose_MS.rotation, unit = Matrix3::Identity();
            AxisPositions first = post.angles;
            first[setup->machine.chain.tool.back().axis] = 0.0;
            const Matrix3 carrier = setup->machine.poses(first).pose_MS.rotation;
            const Vector3 expected =
                (whole - unit) * dt + (mixed ? Vector3((unit - pose.pose_MW.rotation) * dp)
                                             : Vector3(-(whole - carrier) * ds));
            const Vector3 by_tip = reached(wrong, by_tcp(post, q), PositioningMode::rtcp) -
                                   reached(*setup, by_tcp(post, q), PositioningMode::rtcp);
            CHECK((by_tip - expected).norm() < 1e-9);
            const Vector3 by_frame = reached(wrong, by_plane(post, q), PositioningMode::tw) -
                                     reached(*setup, by_plane(post, q), PositioningMode::tw);
            CHECK((by_frame - expected).norm() < 1e-9);
        }
    }
    CHECK(machines == 3);
}

TEST_CASE("the setup says to what the frame of G43.4 is tied, and says it again") {
    std::vector<std::string> notes;
    setup::Setup setup = setup::load_setup(TRUNNION_SOURCE_DIR "/machines/bc_table.toml", notes);
    CHECK(setup.tcp_frame == positioning::TcpFrame::start);
    setup.tcp_frame = positioning::TcpFrame::rotary_zero;
    const setup::Setup again = setup::parse_setup(setup::format_setup(setup), "again.toml", notes);
    CHECK(again.tcp_frame == positioning::TcpFrame::rotary_zero);
    CHECK(emulator::control_config(again).tcp_frame == positioning::TcpFrame::rotary_zero);
}

}  // namespace trunnion
