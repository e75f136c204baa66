// A six-axis arm with axes called J1 to J6: predicted, identified, and held against a real one.
#include "tests/identification/arm.h"

#include <catch2/catch.hpp>
#include <cstdlib>
#include <numeric>

#include "base/random.h"
#include "effects/settings.h"
#include "identification/plausible.h"

namespace trunnion {
namespace {

std::vector<arm::Pose> random_poses(int count, std::uint64_t seed) {
    SeededNoise random(seed);
    std::vector<arm::Pose> poses(static_cast<std::size_t>(count));
    for (arm::Pose& pose : poses)
        for (double& q : pose.joints_deg) q = 280.0 * random.uniform() - 140.0;
    return poses;
}

const std::array<double, 6> zeros_deg{0.02, -0.03, 0.05, 0.04, -0.06, 0.0};
const Pose tracker{rotation_of({1e-3, -5e-4, 8e-4}), Vector3(1.5, -0.8, 0.6)};

/// Measured as an arm with other Denavit-Hartenberg numbers does, from a tracker somewhere else.
std::vector<arm::Pose> measured_by(const arm::DenavitHartenberg& real, double scale,
                                   std::vector<arm::Pose> poses, double noise_mm) {
    SeededNoise random(3);
    for (arm::Pose& pose : poses) {
        std::array<double, 6> turned = pose.joints_deg;
        for (std::size_t i = 0; i < 6; ++i) turned[i] += zeros_deg[i];
        pose.measured_mm = scale * (tracker * arm::target_mm(real, turned)) +
                           noise_mm * Vector3(random.normal(), random.normal(), random.normal());
    }
    return poses;
}

/// The same arm with its target 60 mm beside the last axis.
arm::DenavitHartenberg beside() {
    arm::DenavitHartenberg dh = arm::ur5;
    dh.a_mm[5] = 60;
    return dh;
}

arm::DenavitHartenberg worn() {
    arm::DenavitHartenberg real = arm::ur5;
    real.d_mm = {89.6, 0.3, -0.2, 109.0, 94.9, 113.6};
    real.a_mm = {0.2, -425.4, -391.9, 0.15, -0.2, 60.1};
    real.alpha_deg = {90.03, 0.02, -0.03, 89.96, -90.05, 0.0};
    return real;
}

}  // namespace

TEST_CASE("an arm that was never calibrated may miss by millimetres", "[identification][arm]") {
    setup::Setup setup = arm::setup(arm::ur5, 100);
    setup.model.modelled = {};
    arm::DenavitHartenberg real = arm::ur5;
    const auto rms_mm = [&](double off_mm) {
        real.a_mm[1] = arm::ur5.a_mm[1] + off_mm;
        const auto poses = measured_by(real, 1.0, random_poses(30, 4), 0.01);
        return 1e-3 *
               identification::identify(setup, arm::table(setup, arm::ur5, poses), {}).rms_after_um;
    };
    CHECK(rms_mm(5.0) > 1.0);
    CHECK_THROWS_WITH(rms_mm(50.0), Catch::Contains("wrong units"));  // a wrong frame or unit
}

// What turns a target that stands almost on the last axis is hardly seen: millimetres of that
// axis's location are within its uncertainty, and no sign of a wrong unit.
TEST_CASE("a location that the readings hardly see refuses nothing", "[identification][arm]") {
    const auto told = [](const setup::Setup& setup, double value_mm, double sigma_mm) {
        identification::BaseModel model;
        model.setup = setup;
        model.residual_mm = Eigen::VectorXd::Constant(30, 0.3);  // 10 times what was expected
        model.sigma_mm = Eigen::VectorXd::Constant(30, 0.03);
        identification::FitParameter p;
        p.name = "EZ0J6_mm";
        p.unit = "mm";
        p.location = kinematics::ErrorName{};
        p.value = value_mm;
        p.sigma = sigma_mm;
        identification::tell_absurd_value(model, p, {});
    };
    const setup::Setup arm = arm::setup(arm::ur5, 100);
    setup::Setup mill = arm;
    std::vector<std::string> notes;
    mill.machine.chain =
        setup::parse_setup("[machine]\nchain = \"w b X Y Z t\"\n", "m.toml", notes).machine.chain;
    CHECK_NOTHROW(told(mill, 4.9, 0.001));
    CHECK_THROWS_WITH(told(mill, 8.3, 0.001), Catch::Contains("wrong units"));
    CHECK_NOTHROW(told(mill, 8.3, 0.2));
    CHECK_NOTHROW(told(arm, 8.3, 0.001));
    CHECK_THROWS_WITH(told(arm, 83.0, 0.001), Catch::Contains("wrong units"));
}

TEST_CASE("an arm reads what its Denavit-Hartenberg matrices say", "[identification][arm]") {
    const setup::Setup setup = arm::setup(arm::ur5, 100);
    auto poses = random_poses(30, 4);
    for (arm::Pose& pose : poses) pose.measured_mm = arm::target_mm(arm::ur5, pose.joints_deg);
    const records::ReadingTable table = arm::table(setup, arm::ur5, poses);
    CHECK(arm::mean(arm::misses_mm(setup, table)) < 1e-10);
    setup::Setup turned = setup;
    turned.effects.push_back(
        effects::parse_injection("J3.zero=1mrad", effects::make_catalogue(setup)));
    for (arm::Pose& pose : poses) {
        auto q = pose.joints_deg;
        q[2] += deg_from_rad(1e-3);
        pose.measured_mm = arm::target_mm(arm::ur5, q);
    }
    CHECK(arm::mean(arm::misses_mm(turned, arm::table(setup, arm::ur5, poses))) < 1e-9);
}

TEST_CASE("kinematic parameters of an arm: 27 are seen by points, the rest is named",
          "[identification][arm]") {
    const setup::Setup setup = arm::setup(beside(), 20);
    const records::ReadingTable table =
        arm::table(setup, beside(), measured_by(worn(), 1.0, random_poses(200, 5), 0.0));
    const identification::Identification fit =
        identification::identify(setup, table, arm::kinematic_effects());
    // Six lines in space and a point: 6 * 4 + 3. Base pose and zero offsets name the same again.
    CHECK(fit.parameters.size() == 24 + 6 + 6 + 3);
    CHECK(fit.inseparable.size() == fit.parameters.size() - 27);
    // A target on the last axis does not tell the direction of that axis.
    const setup::Setup on_axis = arm::setup(arm::ur5, 20);
    const identification::Identification less = identification::identify(
        on_axis,
        arm::table(on_axis, arm::ur5, measured_by(arm::ur5, 1.0, random_poses(200, 5), 0.0)),
        arm::kinematic_effects());
    CHECK(less.inseparable.size() == less.parameters.size() - 25);
    const records::ReadingTable other =
        arm::table(setup, beside(), measured_by(worn(), 1.0, random_poses(100, 6), 0.0));
    CHECK(arm::mean(arm::misses_mm(setup, other)) > 1.0);
    CHECK(arm::mean(arm::misses_mm(fit.setup, other)) < 1e-5);
}

TEST_CASE("noise shows in the residual and hardly in the prediction", "[identification][arm]") {
    const setup::Setup setup = arm::setup(beside(), 20, "[\"pose\", \"scale\"]");
    const records::ReadingTable table =
        arm::table(setup, beside(), measured_by(worn(), 1.0 + 2e-5, random_poses(200, 5), 0.02));
    const identification::Identification fit =
        identification::identify(setup, table, arm::kinematic_effects());
    CHECK(fit.rms_after_um == Approx(20.0).epsilon(0.1));
    const records::ReadingTable other =
        arm::table(setup, beside(), measured_by(worn(), 1.0 + 2e-5, random_poses(100, 6), 0.0));
    CHECK(arm::mean(arm::misses_mm(fit.setup, other)) < 0.015);
}

// The data set of P. Jacobi, "Datasets for Hybrid Error Compensation in Serial Industrial Robots"
// (GitHub pauljac7700/serial_robots_datasets, MIT): TRUNNION_UR5 names its folder.
TEST_CASE("a real UR5 measured by a laser tracker: fitted on 1,000 poses, judged on 20 more",
          "[identification][arm]") {
    const char* folder = std::getenv("TRUNNION_UR5");
    if (!folder || !*folder) {
        WARN("skipped: TRUNNION_UR5 does not name the folder of the data set");
        return;
    }
    const setup::Setup setup = arm::setup(arm::ur5, 100);
    const std::string name = std::string(folder) + "/3D_UR5_uncalibrated_";
    const records::ReadingTable grid =
        arm::table(setup, arm::ur5, arm::published(name + "grid_cleaned.csv"));
    const records::ReadingTable fresh =
        arm::table(setup, arm::ur5, arm::published(name + "random_cleaned.csv"));
    REQUIRE(grid.rows.size() == 3000);
    REQUIRE(fresh.rows.size() == 60);
    CHECK(arm::mean(arm::misses_mm(setup, fresh)) == Approx(2.57).margin(0.01));
    const identification::Identification fit =
        identification::identify(setup, grid, arm::kinematic_effects());
    const double judged_mm = arm::mean(arm::misses_mm(fit.setup, fresh));
    WARN("mean error " << judged_mm << " mm on the 20, "
                       << arm::mean(arm::misses_mm(fit.setup, grid)) << " mm on the 1,000");
    CHECK(judged_mm <= 0.102);
}

}  // namespace trunnion
