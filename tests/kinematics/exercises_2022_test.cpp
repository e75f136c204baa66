// The three student exercises of the 2022 paper on HTM error compensation (docs/sources.md).
#include <catch2/catch.hpp>
#include <cmath>

#include "base/units.h"
#include "kinematics/machine.h"

using namespace trunnion;

namespace {

void near_um(double actual_mm, double expected_um, double tolerance_um) {
    CHECK(std::abs(um_from_mm(actual_mm) - expected_um) < tolerance_um);
}

/// Table 1 of the paper: errors of the tool post against the commanded y, um and arcsec.
struct Post {
    double y, dx, dy, dz, ex, ey, ez;
};
constexpr Post table_1[] = {{0, 0, 0, 0, 0, 0, 0},
                            {1, 0.4, -0.3, 0.2, -7, 7, -6},
                            {2, 1.0, -0.6, 0.6, -16, 19, 15},
                            {3, 2.2, -0.2, 0.5, -18, 24, 26},
                            {4, 3.6, 0.2, -0.1, -20, 23, 19},
                            {5, 1.2, 0.9, -0.4, 7, 17, 23},
                            {6, -0.6, 1.4, -0.5, 14, -6, 10},
                            {7, -0.9, 0.8, -0.3, 19, -17, -1},
                            {8, -0.4, 0.5, 0, 17, -23, -9}};

kinematics::Machine tool_post() {
    kinematics::Machine machine;
    machine.chain = kinematics::parse_chain("w b Y t");
    for (const Post& row : table_1) {
        const double value[6] = {mm_from_um(row.dx),      mm_from_um(row.dy),
                                 mm_from_um(row.dz),      rad_from_arcsec(row.ex),
                                 rad_from_arcsec(row.ey), rad_from_arcsec(row.ez)};
        for (std::size_t k = 0; k < 6; ++k) {
            kinematics::ErrorCurve& curve = machine.errors.axis[index_of(Axis::Y)].motion[k];
            curve.at.push_back(row.y);
            curve.value.push_back(value[k]);
        }
    }
    return machine;
}

}  // namespace

TEST_CASE("exercise 1: lateral and Abbe error of a probe on a bending beam") {
    const double load_N = 100, length_m = 0.25, e_Pa = 210e9, i_m4 = 0.025 * std::pow(0.05, 3) / 12;
    const double sag_mm = 1e3 * load_N * std::pow(length_m, 3) / (3 * e_Pa * i_m4);
    const double slope = load_N * length_m * length_m / (2 * e_Pa * i_m4);
    near_um(sag_mm, 9.5238, 1e-4);
    CHECK(slope == Approx(57.143e-6).epsilon(1e-5));
    kinematics::Machine machine;
    machine.chain = kinematics::parse_chain("w b X t");
    machine.errors.motion({'Z', false, Axis::X}).constant = -sag_mm;
    machine.errors.motion({'B', false, Axis::X}).constant = slope;
    AxisPositions q;
    q[Axis::X] = 250;
    const Vector3 error = machine.tip_W(q, Vector3(0, 0, -100)) - Vector3(250, 0, -100);
    near_um(error.z(), -9.5238, 1e-3);  // lateral (straightness) error
    near_um(error.x(), -5.7143, 1e-3);  // Abbe: offset times angle
}

TEST_CASE("exercise 2: transform of the z slide in the frame of the y slide") {
    kinematics::Machine machine;
    machine.chain = kinematics::parse_chain("w b Z t");
    const Vector3 delta(1e-3, -2e-3, 3e-3), epsilon(1e-5, 2e-5, -3e-5);
    for (std::size_t k = 0; k < 3; ++k) {
        machine.errors.axis[index_of(Axis::Z)].motion[k].constant = delta[Eigen::Index(k)];
        machine.errors.axis[index_of(Axis::Z)].motion[k + 3].constant = epsilon[Eigen::Index(k)];
    }
    AxisPositions q;
    q[Axis::Z] = 120;
    const Pose pose = machine.poses(q).pose_MS;
    Matrix3 expected;
    expected << 1, -epsilon.z(), epsilon.y(), epsilon.z(), 1, -epsilon.x(), -epsilon.y(),
        epsilon.x(), 1;
    CHECK((pose.rotation - expected).norm() < 2e-9);  // the paper's matrix is of first order
    CHECK((pose.translation_mm - (Vector3(0, 0, 120) + delta)).norm() < 1e-12);
}

TEST_CASE("exercise 3: tool point errors over a grid of slide positions") {
    const double x_um[] = {0, 29.00, 17.97, 9.96, 22.51, -2.19, -34.54, -40.17, -38.70};
    const double y_um[] = {0, 7.94, 60.00, 81.25, 76.32, 17.38, -17.99, -46.71, -53.80};
    const double z_um[] = {0, -23.56, -58.06, -69.31, -72.34, -11.55, 35.38, 61.27, 66.42};
    const kinematics::Machine machine = tool_post();
    const Vector3 b(300, 400, 500);
    for (int i = 0; i <= 8; ++i) {
        AxisPositions q;
        q[Axis::Y] = i;
        const Vector3 error = machine.tip_W(q, b) - (b + Vector3(0, i, 0));
        near_um(error.x(), x_um[i], 0.02);  // the exact rotation differs by up to 0.01 um
        near_um(error.y(), y_um[i], 0.02);
        near_um(error.z(), z_um[i], 0.02);
    }
}

TEST_CASE("the correction vector takes the tool point back onto the work") {
    kinematics::Machine machine = tool_post();
    machine.chain = kinematics::parse_chain("w b X Y Z t");
    machine.errors.location({'C', true, Axis::Y}) = 3e-5;
    machine.errors.motion({'Y', false, Axis::X}).slope = 2e-5;
    const Vector3 tip(300, 400, 500), wanted(310, 405.5, 490);
    AxisPositions q;
    for (const Axis axis : {Axis::X, Axis::Y, Axis::Z})
        q[axis] = (wanted - tip)[Eigen::Index(index_of(axis))];
    const Vector3 correction = machine.tip_W(q, tip) - wanted;  // r_Q - r_P, eq. (25)
    CHECK(correction.norm() > 0.02);
    for (const Axis axis : {Axis::X, Axis::Y, Axis::Z})
        q[axis] -= correction[Eigen::Index(index_of(axis))];
    CHECK((machine.tip_W(q, tip) - wanted).norm() < 0.03 * correction.norm());  // first order
}
