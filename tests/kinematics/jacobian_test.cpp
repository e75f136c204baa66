#include "kinematics/jacobian.h"

#include <catch2/catch.hpp>

#include "base/random.h"

using namespace trunnion;

namespace {

kinematics::Machine random_machine(const char* chain, SeededNoise& noise) {
    kinematics::Machine machine;
    machine.chain = kinematics::parse_chain(chain);
    for (auto* side : {&machine.chain.work, &machine.chain.tool})
        for (kinematics::AxisGeometry& axis : *side) {
            axis.direction += 0.3 * Vector3(noise.normal(), noise.normal(), noise.normal());
            axis.direction.normalize();
            axis.point_mm = 50 * Vector3(noise.normal(), noise.normal(), noise.normal());
            kinematics::AxisErrors& errors = machine.errors.axis[index_of(axis.axis)];
            for (std::size_t k = 0; k < 6; ++k) {
                errors.location[k] = (k < 3 ? 0.1 : 1e-3) * noise.normal();
                errors.motion[k].constant = (k < 3 ? 0.1 : 1e-3) * noise.normal();
                errors.motion[k].slope = (k < 3 ? 1e-3 : 1e-5) * noise.normal();
            }
        }
    kinematics::AxisErrors& spindle = machine.errors.spindle;
    for (std::size_t k = 0; k < 5; ++k) {
        spindle.location[k] = (k < 3 ? 0.1 : 1e-3) * noise.normal();
        spindle.motion[k].constant = (k < 3 ? 0.1 : 1e-3) * noise.normal();
        spindle.motion[k].harmonics = {{1.0, (k < 3 ? 0.1 : 1e-3) * noise.normal(), 0.0}};
    }
    return machine;
}

/// Central difference of the tip by whatever `value` refers to inside `machine`.
Vector3 numeric(kinematics::Machine& machine, const AxisPositions& q, const Vector3& tip,
                double& value, double h) {
    const double was = value;
    value = was + h;
    const Vector3 plus = machine.tip_W(q, tip);
    value = was - h;
    const Vector3 minus = machine.tip_W(q, tip);
    value = was;
    return (plus - minus) / (2 * h);
}

void check(const Vector3& analytic, const Vector3& number, double scale) {
    CHECK((analytic - number).norm() < 2e-7 * scale);
}

}  // namespace

TEST_CASE("every derivative of the tip agrees with central differences") {
    SeededNoise noise(11);
    for (const char* text : {"w C B b X Y Z t", "w C b X Y Z B t", "w b X Y Z C A t",
                             "w X A b Y Z W B t", "w Y X b Z t", "w b Z C X Y t"}) {
        INFO(text);
        kinematics::Machine machine = random_machine(text, noise);
        AxisPositions q;
        for (const Axis axis : all_axes) q[axis] = (is_rotary(axis) ? 1.0 : 100.0) * noise.normal();
        const Vector3 tip(3, -5, -150);
        const kinematics::TipJacobian jacobian = kinematics::tip_jacobian(machine, q, tip);
        CHECK((jacobian.tip_W_mm - machine.tip_W(q, tip)).norm() < 1e-11);
        for (const kinematics::AxisGeometry& axis : machine.chain.axes()) {
            INFO(letter_of(axis.axis));
            const std::size_t k = index_of(axis.axis);
            kinematics::AxisErrors& errors = machine.errors.axis[k];
            AxisPositions moved = q;
            const double h = axis.rotary ? 1e-5 : 1e-3;
            moved[axis.axis] = q[axis.axis] + h;
            const Vector3 plus = machine.tip_W(moved, tip);
            moved[axis.axis] = q[axis.axis] - h;
            check(jacobian.axis.col(Eigen::Index(k)), (plus - machine.tip_W(moved, tip)) / (2 * h),
                  500);
            for (std::size_t i = 0; i < 6; ++i) {
                const double step = i < 3 ? 1e-2 : 1e-5, scale = i < 3 ? 1 : 1000;
                const auto column = Eigen::Index(i);
                check(jacobian.location[k].col(column),
                      numeric(machine, q, tip, errors.location[i], step), scale);
                check(jacobian.motion[k].col(column),
                      numeric(machine, q, tip, errors.motion[i].constant, step), scale);
            }
        }
        kinematics::AxisErrors& spindle = machine.errors.spindle;
        for (std::size_t i = 0; i < 6; ++i) {
            const double step = i < 3 ? 1e-2 : 1e-5, scale = i < 3 ? 1 : 1000;
            const auto column = Eigen::Index(i);
            check(jacobian.spindle_location.col(column),
                  numeric(machine, q, tip, spindle.location[i], step), scale);
            check(jacobian.spindle_motion.col(column),
                  numeric(machine, q, tip, spindle.motion[i].constant, step), scale);
        }
        for (int i = 0; i < 3; ++i) {
            Vector3 a = tip, b = tip;
            a[i] += 0.5, b[i] -= 0.5;
            check(jacobian.tip.col(i), machine.tip_W(q, a) - machine.tip_W(q, b), 1);
        }
    }
}
