// Forward kinematics against straight-line Eigen code written for one five-axis chain (issue 4).
#include <benchmark/benchmark.h>

#include "kinematics/forward.h"

using namespace trunnion;

namespace {

kinematics::Machine bc_table() {
    kinematics::Machine machine;
    machine.chain = kinematics::parse_chain("w C B b X Y Z t");
    machine.chain.work[0].point_mm = {10, -3, 40};
    machine.chain.work[1].point_mm = {12, 5, 60};
    return machine;
}

/// All 41: 30 error motions (tables of 13 points), 8 location errors of B and C, 3 squarenesses.
kinematics::Machine with_41_errors() {
    kinematics::Machine machine = bc_table();
    for (const kinematics::AxisGeometry& axis : machine.chain.axes())
        for (std::size_t k = 0; k < 6; ++k) {
            kinematics::ErrorCurve& curve = machine.errors.axis[index_of(axis.axis)].motion[k];
            for (int i = -6; i <= 6; ++i) {
                curve.at.push_back(axis.rotary ? 0.5 * i : 50.0 * i);
                curve.value.push_back((k < 3 ? 1e-3 : 1e-5) * (i % 3));
            }
        }
    for (const char* name :
         {"EX0B", "EZ0B", "EA0B", "EC0B", "EX0C", "EY0C", "EA0C", "EB0C", "EC0Y", "EA0Z", "EB0Z"})
        machine.errors.location(*kinematics::parse_error_name(name)) = 1e-5;
    return machine;
}

std::vector<AxisPositions> positions() {
    std::vector<AxisPositions> all(512);
    for (std::size_t i = 0; i < all.size(); ++i) {
        const double t = 0.37 * static_cast<double>(i);
        all[i].value = {200 * std::sin(t),
                        150 * std::cos(2 * t),
                        100 * std::sin(3 * t),
                        0,
                        1.5 * std::sin(t),
                        3.0 * std::cos(t),
                        0,
                        0,
                        0};
    }
    return all;
}

/// Handwritten code for this one machine: two rotations about fixed points.
Vector3 straight_line(const AxisPositions& q, const Vector3& tip_S) {
    const Vector3 p(10, -3, 40), c(12, 5, 60);
    Matrix3 rb, rc;
    const double cb = std::cos(-q[Axis::B]), sb = std::sin(-q[Axis::B]);
    const double cc = std::cos(-q[Axis::C]), sc = std::sin(-q[Axis::C]);
    rb << cb, 0, sb, 0, 1, 0, -sb, 0, cb;
    rc << cc, -sc, 0, sc, cc, 0, 0, 0, 1;
    const Pose b{rb, p - rb * p}, w{rc, c - rc * c};
    const Pose pose_MW = b * w;
    const Vector3 tip_M = Vector3(q[Axis::X], q[Axis::Y], q[Axis::Z]) + tip_S;
    return pose_MW.rotation.transpose() * (tip_M - pose_MW.translation_mm);
}

template <class Tip>
void run(benchmark::State& state, const Tip& tip) {
    const auto all = positions();
    const Vector3 tip_S(0, 0, -150);
    std::size_t i = 0;
    for (auto _ : state) benchmark::DoNotOptimize(tip(all[i++ & 511], tip_S));
}

void straight(benchmark::State& state) {
    run(state, straight_line);
}

void error_free(benchmark::State& state) {
    const kinematics::ForwardModel model(bc_table());
    run(state, [&](const AxisPositions& q, const Vector3& tip) { return model.tip_W(q, tip); });
}

void full_errors(benchmark::State& state) {
    const kinematics::ForwardModel model(with_41_errors());
    run(state, [&](const AxisPositions& q, const Vector3& tip) { return model.tip_W(q, tip); });
}

void unprepared(benchmark::State& state) {
    const kinematics::Machine machine = bc_table();
    run(state, [&](const AxisPositions& q, const Vector3& tip) { return machine.tip_W(q, tip); });
}

BENCHMARK(straight);
BENCHMARK(error_free);
BENCHMARK(full_errors);
BENCHMARK(unprepared);

}  // namespace

BENCHMARK_MAIN();
