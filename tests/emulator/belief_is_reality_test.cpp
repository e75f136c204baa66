// Law 1 and 2: a control that was told the truth puts the tip where the machine has it.
#include <array>
#include <catch2/catch.hpp>

#include "base/random.h"
#include "base/units.h"
#include "positioning/rotary_transform.h"
#include "setup/setup.h"

namespace trunnion {

namespace {

Vector3 random_vector(SeededNoise& noise, double size) {
    return Vector3(noise.uniform() - 0.5, noise.uniform() - 0.5, noise.uniform() - 0.5) * size;
}

const std::array<const char*, 8> chains{"w C B b X Y Z t", "w C A b X Y Z t", "w C B Y b X Z t",
                                        "w b X Y Z C B t", "w b X Y Z C A t", "w C b X Y Z B t",
                                        "w A b X Y Z B t", "w B X b Y Z A t"};

/// A random machine of one of the chains; every third one has an inclined (nutating) axis.
kinematics::Machine random_machine(SeededNoise& noise, int k) {
    kinematics::Machine machine;
    machine.chain = kinematics::parse_chain(chains[static_cast<std::size_t>(k) % chains.size()]);
    bool inclined = k % 3 == 0;
    for (auto* side : {&machine.chain.work, &machine.chain.tool})
        for (kinematics::AxisGeometry& axis : *side) {
            const auto letter = index_of(axis.axis) % 3;
            axis.direction = Vector3::Unit(static_cast<int>(letter));
            if (!axis.rotary) {
                if (side == &machine.chain.work) axis.direction = -axis.direction;
                continue;
            }
            if (noise.uniform() < 0.5) axis.direction = -axis.direction;
            axis.point_mm = random_vector(noise, 400.0);
            if (!inclined || axis.axis == Axis::C) continue;
            const double angle = 0.3 + 0.9 * noise.uniform();
            axis.direction = std::cos(angle) * axis.direction + std::sin(angle) * Vector3::UnitZ();
            inclined = false;
        }
    return machine;
}

AxisPositions random_positions(SeededNoise& noise, const kinematics::Machine& machine) {
    AxisPositions q;
    for (const kinematics::AxisGeometry& axis : machine.chain.axes())
        q[axis.axis] = (noise.uniform() - 0.5) * (axis.rotary ? 4.0 * pi : 600.0);
    return q;
}

positioning::RotaryTransform told_the_truth(const kinematics::Machine& machine) {
    offsets::Parameters parameters;
    REQUIRE(setup::derive_pivot_parameters(machine, parameters).empty());
    std::vector<Axis> order;
    for (const kinematics::AxisGeometry& axis : machine.chain.axes()) order.push_back(axis.axis);
    return positioning::RotaryTransform(*offsets::decode_pivot(parameters, order));
}

double angle_between(const Vector3& a, const Vector3& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

TEST_CASE("told the truth, believed tip and direction are the machine's: 1,000 geometries") {
    SeededNoise noise(20);
    double worst_mm = 0.0, worst_rad = 0.0, worst_inverse_mm = 0.0;
    for (int k = 0; k < 1000; ++k) {
        const kinematics::Machine machine = random_machine(noise, k);
        const positioning::RotaryTransform belief = told_the_truth(machine);
        for (int pose = 0; pose < 5; ++pose) {
            const AxisPositions q = random_positions(noise, machine);
            const Vector3 tool_mm = random_vector(noise, 300.0);
            const kinematics::MachinePose truth = machine.poses(q);
            const Vector3 tip_W = belief.tip_W(q, tool_mm);
            worst_mm = std::max(worst_mm, (tip_W - machine.tip_W(q, -tool_mm)).norm());
            const Vector3 direction =
                truth.pose_MW.rotation.transpose() * truth.pose_MS.rotation * Vector3::UnitZ();
            worst_rad = std::max(worst_rad, angle_between(belief.tool_direction_W(q), direction));
            AxisPositions moved = q;
            moved[Axis::X] = moved[Axis::Y] = moved[Axis::Z] = 0.0;
            moved = belief.machine_for_tip(tip_W, moved, tool_mm);
            for (const Axis axis : {Axis::X, Axis::Y, Axis::Z})
                worst_inverse_mm = std::max(worst_inverse_mm, std::abs(moved[axis] - q[axis]));
        }
    }
    CHECK(worst_mm < 1e-9);
    CHECK(worst_rad < 1e-12);
    CHECK(worst_inverse_mm < 1e-9);
}

TEST_CASE("both branches of the orientation inverse reach the direction on the true machine") {
    SeededNoise noise(21);
    double worst_rad = 0.0;
    int both = 0, found_start = 0, all = 0;
    for (int k = 0; k < 1000; ++k) {
        const kinematics::Machine machine = random_machine(noise, k);
        const positioning::RotaryTransform belief = told_the_truth(machine);
        for (int pose = 0; pose < 5; ++pose, ++all) {
            const AxisPositions q = random_positions(noise, machine);
            const Vector3 wanted = belief.tool_direction_W(q);
            const positioning::RotarySolution start = belief.rotaries(q);
            const auto solutions = belief.orient(wanted, start);
            REQUIRE_FALSE(solutions.empty());
            both += solutions.size() == 2;
            bool found = false;
            for (const positioning::RotarySolution& s : solutions) {
                const AxisPositions there = belief.with_rotaries(q, s);
                const kinematics::MachinePose truth = machine.poses(there);
                const Vector3 reached =
                    truth.pose_MW.rotation.transpose() * truth.pose_MS.rotation * Vector3::UnitZ();
                worst_rad = std::max(worst_rad, angle_between(reached, wanted));
                found = found ||
                        (std::abs(std::remainder(s.first_rad - start.first_rad, 2 * pi)) +
                             std::abs(std::remainder(s.second_rad - start.second_rad, 2 * pi)) <
                         1e-7);
            }
            found_start += found;
        }
    }
    CHECK(worst_rad < 1e-12);
    CHECK(both == all);
    CHECK(found_start == all);
}

TEST_CASE("parameters already typed stay, and what cannot be said is said") {
    SeededNoise noise(3);
    kinematics::Machine machine = random_machine(noise, 1);
    offsets::Parameters parameters;
    parameters.set(19700, 0.125);
    CHECK(setup::derive_pivot_parameters(machine, parameters).empty());
    CHECK(parameters.get(19700) == 0.125);
    CHECK(parameters.get(19680) == 12);
    machine.chain = kinematics::parse_chain("w C b X Y Z t");
    offsets::Parameters none;
    CHECK_FALSE(setup::derive_pivot_parameters(machine, none).empty());
    CHECK(none.entry.empty());
}

TEST_CASE("G54.2 groups of a left-handed BC table: C then B, linear axes swapped") {
    kinematics::Machine machine;
    machine.chain = kinematics::parse_chain("w C B b X Y Z t");
    machine.chain.work[0].direction = {0, -1, 0};
    machine.chain.work[1].direction = {0, 0, -1};
    offsets::Parameters p;
    setup::derive_fixture_groups(machine, p);
    CHECK(p.get(7580) == 5);
    CHECK(p.get(7581) == 2);
    CHECK(p.get(7582) == 1);
    CHECK(p.get(7583) == 4);
    CHECK(p.get(7584) == 1);
    CHECK(p.get(7585) == 3);
    CHECK_FALSE(p.find(7586));
}

TEST_CASE("G54.2 groups: a head turns no fixture, an inclined table axis has no plane to name") {
    kinematics::Machine machine;
    offsets::Parameters head, inclined;
    machine.chain = kinematics::parse_chain("w b X Y Z C B t");
    setup::derive_fixture_groups(machine, head);
    CHECK(head.find(7580));
    CHECK(head.get(7580) == 0);
    CHECK_FALSE(head.find(7583));
    machine.chain = kinematics::parse_chain("w C B b X Y Z t");
    machine.chain.work[0].direction = {0, -std::sqrt(0.5), -std::sqrt(0.5)};
    machine.chain.work[1].direction = {0, 0, -1};
    setup::derive_fixture_groups(machine, inclined);
    CHECK(inclined.get(7580) == 5);
    CHECK(inclined.get(7581) == 2);
    CHECK(inclined.get(7583) == 4);
    CHECK(inclined.get(7584) == 0);
    CHECK(inclined.get(7585) == 0);
}

}  // namespace trunnion
