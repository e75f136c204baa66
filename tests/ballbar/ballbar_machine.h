// The machine of the single-set-up ballbar tests: A-C table, paper's values, lengths of our own.
#pragma once

#include <string>
#include <vector>

#include "ballbar/test/ballbar_published.h"
#include "ballbar/test/ballbar_result.h"
#include "base/random.h"

namespace trunnion::ballbar_test {

/// W at the centre pivot's home: A through (0, 0, -Oz), C through (-Ox, 0, 0); both at the nominal
/// intersection. Table axes turn against the tool.
inline kinematics::Machine nominal_ac(double ox_mm = 75, double oz_mm = 110) {
    kinematics::Machine machine;
    const Vector3 p0(-ox_mm, 0, -oz_mm);
    const auto axis = [](Axis letter, bool rotary, const Vector3& direction, const Vector3& point) {
        kinematics::AxisGeometry geometry;
        geometry.axis = letter;
        geometry.rotary = rotary;
        geometry.direction = direction;
        geometry.point_mm = point;
        return geometry;
    };
    machine.chain.work = {axis(Axis::A, true, -Vector3::UnitX(), p0),
                          axis(Axis::C, true, -Vector3::UnitZ(), p0)};
    for (const Axis letter : {Axis::X, Axis::Y, Axis::Z})
        machine.chain.tool.push_back(axis(
            letter, false, Vector3::Unit(static_cast<int>(index_of(letter))), Vector3::Zero()));
    return machine;
}

/// Uncompensated values of the paper's Table 2 (two misprints corrected, docs/sources.md): lines
/// in M at the nominal intersection.
inline std::vector<ballbar::test::NamedError> paper_errors() {
    return {{{'Y', true, Axis::A}, 0.0726},    {{'Z', true, Axis::A}, -0.0202},
            {{'B', true, Axis::A}, 1.1284e-5}, {{'C', true, Axis::A}, -1.3006e-4},
            {{'X', true, Axis::C}, 0.0283},    {{'Y', true, Axis::C}, 0.1041},
            {{'A', true, Axis::C}, 5.1954e-6}, {{'B', true, Axis::C}, -4.1544e-5}};
}

inline ballbar::test::AxisLine line_of(const kinematics::AxisGeometry& axis,
                                       const std::vector<ballbar::test::NamedError>& errors,
                                       const Vector3& point_mm) {
    Vector3 shift = Vector3::Zero(), tilt = Vector3::Zero();
    for (const ballbar::test::NamedError& e : errors) {
        if (e.name.axis != axis.axis) continue;
        (e.name.angular() ? tilt : shift)(
            static_cast<int>(std::string("XYZABC").find(e.name.direction) % 3)) = e.value;
    }
    return {point_mm + shift, rotation_of(tilt) * axis.direction};
}

/// `nominal` with axis lines as `errors` say at the nominal intersection in M.
inline kinematics::Machine with_lines(kinematics::Machine nominal,
                                      const std::vector<ballbar::test::NamedError>& errors) {
    const auto [first, second] = ballbar::test::table_axes(nominal.chain);
    const auto [p1, p2] = ballbar::test::nominal_intersection(first, second);
    const auto chain = ballbar::test::chain_errors(line_of(first, errors, p1),
                                                   line_of(second, errors, p2), nominal);
    for (const ballbar::test::NamedError& e : chain) nominal.errors.location(e.name) = e.value;
    return nominal;
}

/// What is physically there; the evaluation knows only the layout.
struct Truth {
    kinematics::Machine machine;
    Vector3 cup_S_mm, pivot_W_mm;
    double length_mm = 100.0;
};

/// The machine as its control has it, the truth, and the layout of the test.
struct PassSource {
    const kinematics::Machine& nominal;
    const Truth& truth;
    const ballbar::test::BallbarLayout& layout;
};

inline void add_pass(std::vector<records::Reading>& rows, const PassSource& source,
                     const std::string& test, int count, bool negative) {
    const auto& [nominal, truth, layout] = source;
    const auto path = ballbar::test::ideal_path(
        nominal, layout, *ballbar::test::parse_ballbar_test(test), count, negative);
    for (const AxisPositions& q : path) {
        records::Reading row;
        row.index = static_cast<int>(rows.size());
        row.time_s = 0.1 * row.index;
        row.test = test + (negative ? "_neg" : "_pos");
        row.device = records::Device::ballbar;
        row.commanded = q;
        const kinematics::MachinePose pose = truth.machine.poses(q);
        row.value_mm = (pose.pose_MS * truth.cup_S_mm - pose.pose_MW * truth.pivot_W_mm).norm() -
                       truth.length_mm;
        rows.push_back(row);
    }
}

/// The four tests of the rotary axes (A every half degree, C every degree), or all seven.
inline std::vector<records::Reading> measure(const kinematics::Machine& nominal, const Truth& truth,
                                             const ballbar::test::BallbarLayout& layout,
                                             bool planar = true, bool both = false) {
    std::vector<records::Reading> rows;
    const auto [first, second] = ballbar::test::table_axes(nominal.chain);
    for (const bool negative : {false, true}) {
        if (negative && !both) break;
        if (planar) {
            add_pass(rows, {nominal, truth, layout}, "xy", 361, negative);
            add_pass(rows, {nominal, truth, layout}, "yz", 221, negative);
            add_pass(rows, {nominal, truth, layout}, "zx", 221, negative);
        }
        for (const std::string kind : {"radial_", "axial_"}) {
            add_pass(rows, {nominal, truth, layout}, kind + letter_of(first.axis), 241, negative);
            add_pass(rows, {nominal, truth, layout}, kind + letter_of(second.axis), 361, negative);
        }
    }
    return rows;
}

inline std::vector<double> values_of(const std::vector<records::Reading>& rows) {
    std::vector<double> values;
    for (const records::Reading& row : rows) values.push_back(*row.value_mm);
    return values;
}

inline void add_noise(std::vector<double>& values, double sigma_mm, SeededNoise& noise) {
    for (double& value : values) value += sigma_mm * noise.normal();
}

/// The A-C trunnion of the paper with its errors, and the test on it.
struct Bench {
    kinematics::Machine nominal = nominal_ac();
    ballbar::test::BallbarLayout layout;
    Truth truth;

    Bench() {
        truth = {with_lines(nominal, paper_errors()), layout.cup_S_mm, layout.pivot_W_mm, 100.0};
        // The operator clamps the centre pivot where the spindle says the origin is: with all axes
        // at zero it stands at its stated place in M, errors of the table or not.
        truth.pivot_W_mm = truth.machine.poses({}).pose_MW.inverse() * layout.pivot_W_mm;
    }
    double true_value(const ballbar::test::NamedError& e) const {
        return truth.machine.errors.location(e.name);
    }
};

}  // namespace trunnion::ballbar_test
