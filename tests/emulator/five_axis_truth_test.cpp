// Programs of five-axis functions on every machine in machines/, told the truth: where the physical
// tip really goes.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <memory>

#include "controller/controller.h"
#include "emulator/run.h"
#include "emulator/setup.h"
#include "geometry/random.h"
#include "geometry/units.h"

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
std::optional<Setup> truthful(const std::string& path) {
    std::vector<std::string> notes;
    Setup setup = load_setup(path, notes);
    setup.machine.errors = {};
    setup.effects.clear();
    for (int number = 19666; number <= 19744; ++number) setup.stores.parameters.entry.erase(number);
    if (!derive_pivot_parameters(setup.machine, setup.stores.parameters).empty())
        return std::nullopt;
    setup.stores.tools.tool[1] = {};
    setup.stores.tools.tool[1].length_geometry_mm = 137.5;
    setup.stores.work = {};
    for (AxisGeometry& axis : setup.machine.chain.work) axis.min = axis.max = std::nullopt;
    for (AxisGeometry& axis : setup.machine.chain.tool) axis.min = axis.max = std::nullopt;
    return setup;
}

/// Looks at the physical tip at seven places of each move.
struct Observer : MotionSink {
    explicit Observer(const Machine& machine) : machine(machine) {}
    MoveResult move(const AxisMove& m) override {
        seen.clear();
        for (int k = 0; k <= 6; ++k) seen.push_back(machine.tip_W(m.at(k / 6.0), {0, 0, -137.5}));
        last = m.to;
        return {};
    }
    Vector3 direction_W() const {
        const MachinePose pose = machine.poses(last);
        return pose.pose_MW.rotation.transpose() * pose.pose_MS.rotation * Vector3::UnitZ();
    }
    const Machine& machine;
    std::vector<Vector3> seen;
    AxisPositions last;
};

RunResult run_text(const Setup& setup, Stores& stores, MotionSink& sink, const std::string& text) {
    ProgramsInMemory programs;
    Controller control(control_config(setup), stores, programs, sink, [](std::string_view) {});
    const auto owner = std::make_shared<std::string>(text);
    return control.run(ProgramText{"test", *owner, owner});
}

std::vector<Axis> rotaries(const Setup& setup) {
    std::vector<Axis> out;
    for (const AxisGeometry& axis : setup.machine.chain.axes())
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
            Observer observer(setup->machine);
            Stores stores = setup->stores;
            const RunResult result = run_text(*setup, stores, observer, program);
            REQUIRE(result.status == RunStatus::ok);
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
            Observer observer(setup->machine);
            Stores stores = setup->stores;
            const RunResult result = run_text(
                *setup, stores, observer,
                fmt::format("G90 G21 G54\nG68.2 X{:.3f} Y{:.3f} Z{:.3f} I{:.3f} J{:.3f} K{:.3f}\n"
                            "G53.1 P{}\nG43 H1 G0 X11. Y-7. Z3.5\n",
                            origin.x(), origin.y(), origin.z(), i, j, turn, k % 3));
            INFO((result.alarm ? fmt::format("{} {} line {}", result.alarm->number,
                                             result.alarm->text, result.alarm->where.line)
                               : ""));
            REQUIRE(result.status == RunStatus::ok);
            ++reached;
            CHECK((observer.seen.back() - origin - frame * point).norm() < 1e-9);
            CHECK(observer.direction_W().cross(frame.col(2)).norm() < 1e-12);
            CHECK(observer.direction_W().dot(frame.col(2)) > 0);
        }
    }
    CHECK(reached >= 150);
}

TEST_CASE("the setup says to what the frame of G43.4 is tied, and says it again") {
    std::vector<std::string> notes;
    Setup setup = load_setup(TRUNNION_SOURCE_DIR "/machines/bc_table.toml", notes);
    CHECK(setup.tcp_frame == TcpFrame::start);
    setup.tcp_frame = TcpFrame::rotary_zero;
    const Setup again = parse_setup(format_setup(setup), "again.toml", notes);
    CHECK(again.tcp_frame == TcpFrame::rotary_zero);
    CHECK(control_config(again).tcp_frame == TcpFrame::rotary_zero);
}

}  // namespace trunnion
