// Stated scatter of the zeroing of tests: against the dense matrix, and against the mean of tests.
#include "identification/zero_scatter.h"

#include <Eigen/LU>
#include <catch2/catch.hpp>

#include "base/units.h"
#include "identification/identify.h"

namespace trunnion {
namespace {

/// One sphere whose centre is free, on a machine without location errors to fit.
setup::Setup machine(const std::string& noise) {
    std::vector<std::string> notes;
    return setup::parse_setup(
        "[machine]\nname = \"m\"\nchain = \"w C B b X Y Z t\"\n"
        "[machine.axis.B]\ndirection = [0, -1, 0]\npoint_mm = [0, 0, 0]\n"
        "[machine.axis.C]\ndirection = [0, 0, -1]\npoint_mm = [0, 0, 0]\n"
        "[probe]\ntip_mm = [0, 0, -150]\nball_diameter_mm = 6\n"
        "[[artefact]]\nname = \"S1\"\nkind = \"sphere\"\ncenter_mm = [120, 0, 80]\n"
        "diameter_mm = 25.4\nfree = [\"center\"]\n"
        "[model]\nmodelled = []\nnoise_um = { sphere = 1" +
            noise + " }\n",
        "s.toml", notes);
}

constexpr int tests = 4, repeats = 5;

/// Found centres at home: tests differ by `apart_mm` along X, repeats not at all.
records::ReadingTable found_centres(const setup::Setup& setup, double apart_mm, int more = 0) {
    records::ReadingTable table;
    table.path = "r.csv";
    table.names = setup.machine.chain.names();
    for (const kinematics::AxisGeometry& axis : setup.machine.chain.axes())
        table.axes.push_back(axis.axis);
    for (int t = 0; t < tests; ++t)
        for (int k = 0; k < repeats + (t == 0 ? more : 0); ++k)
            for (int d = 0; d < 3; ++d) {
                records::Reading row;
                row.index = static_cast<int>(table.rows.size());
                row.time_s = row.index;
                row.test = "T" + std::to_string(t);
                row.device = records::Device::sphere;
                row.feature = "S1";
                row.commanded[Axis::X] = 120.0;
                row.commanded[Axis::Z] = 230.0;
                row.direction_M = Vector3::Unit(d);
                row.value_mm = d == 0 && t == 0 ? apart_mm : 0.0;
                table.rows.push_back(row);
            }
    return table;
}

const identification::FitParameter& centre_x(const identification::Identification& fit) {
    for (const auto& p : fit.parameters)
        if (p.name == "S1.x_mm") return p;
    throw std::runtime_error("no S1.x_mm");
}

}  // namespace

TEST_CASE("the sigma of a centre is that of the mean of its tests", "[identification][zero]") {
    for (const double zero_um : {0.0, 0.3, 3.0}) {
        const setup::Setup setup =
            machine(zero_um > 0.0 ? ", zero = " + std::to_string(zero_um) : std::string());
        const auto fit = identification::identify(setup, found_centres(setup, 0.0), {});
        const double expected_um = std::sqrt(1.0 / (tests * repeats) + zero_um * zero_um / tests);
        CHECK(um_from_mm(centre_x(fit).sigma) == Approx(expected_um).epsilon(1e-6));
    }
}

TEST_CASE("a test with many readings counts for no more than its zero allows",
          "[identification][zero]") {
    // Test 0 is 10.3 um off and has 95 repeats more. The weight of a test is 1 / (s^2 + 1 / n).
    const auto value_um = [](const std::string& noise) {
        const setup::Setup setup = machine(noise);
        const auto fit = identification::identify(setup, found_centres(setup, 0.0103, 95), {});
        return um_from_mm(centre_x(fit).value - 120.0);
    };
    const double w0 = 1.0 / (9.0 + 1.0 / 100), w = 1.0 / (9.0 + 1.0 / 5);
    CHECK(std::abs(value_um(", zero = 3")) == Approx(10.3 * w0 / (w0 + 3 * w)).epsilon(0.02));
    CHECK(std::abs(value_um("")) > 5.0);
}

TEST_CASE("products equal those with the dense covariance", "[identification][zero]") {
    const setup::Setup setup = machine(", zero = 2");
    const records::ReadingTable table = found_centres(setup, 0.0);
    const emulator::Replay replay(setup, table);
    const kinematics::ForwardModel forward(setup.machine);
    std::vector<kinematics::Perturbation> gradient;
    for (std::size_t i = 0; i < replay.size(); ++i)
        gradient.push_back(replay.gradient(i, forward, {}));
    const auto n = static_cast<Eigen::Index>(replay.size());
    Eigen::VectorXd weight(n);
    Eigen::MatrixXd left(n, 2), right(n, 3), v = Eigen::MatrixXd::Identity(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
        const auto k = static_cast<double>(i);
        weight(i) = 1000.0 / (1.0 + 0.1 * k);
        left.row(i) << std::sin(k), std::cos(0.3 * k);
        right.row(i) << 1.0, k, std::sin(2.0 * k);
    }
    for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0; j < n; ++j) {
            const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
            if (table.rows[a].test == table.rows[b].test)
                v(i, j) += weight(i) * weight(j) * 4e-6 *
                           gradient[a].work_shift_mm.dot(gradient[b].work_shift_mm);
        }
    const Eigen::MatrixXd dense = left.transpose() * v.inverse() * right;
    const identification::ZeroScatter zeros(setup, table, replay, gradient);
    CHECK((zeros.product(left, right, weight) - dense).norm() < 1e-9 * dense.norm());
}

}  // namespace trunnion
