// The programmed point of a probe against the closed forms of a BC table, and against the sphere.
#include "setup/programmed_point.h"

#include <catch2/catch.hpp>

#include "base/units.h"

namespace trunnion {

namespace {

setup::Setup bc_table() {
    std::vector<std::string> notes;
    return setup::load_setup(std::string(TRUNNION_SOURCE_DIR) + "/machines/bc_table.toml", notes);
}

/// A + command turns the table against the right hand.
Matrix3 turned(const Vector3& axis, double angle_rad) {
    return Eigen::AngleAxisd(-angle_rad, axis).toRotationMatrix();
}

struct TurnedTable {
    double b_rad, c_rad;
    Matrix3 rb = turned(Vector3::UnitY(), b_rad), rc = turned(Vector3::UnitZ(), c_rad);
    /// Positions with a tip of 150 mm on a point of M.
    AxisPositions with_tip(const Vector3& tip_M, double longer_mm = 0.0) const {
        AxisPositions q;
        q[Axis::X] = tip_M.x();
        q[Axis::Y] = tip_M.y();
        q[Axis::Z] = tip_M.z() + 150.0 + longer_mm;
        q[Axis::B] = b_rad;
        q[Axis::C] = c_rad;
        return q;
    }
};

const Vector3 point_W(120.0, 7.0, 80.0);

}  // namespace

TEST_CASE("the programmed point inverts what each function commands", "[setup][pivot]") {
    const setup::Setup setup = bc_table();
    const setup::ProgrammedPoint meant(setup);
    const Vector3 g = Vector3::Constant(0.1443), p(0.1443, 0.1443, 0.0534), d(0.0, 0.0, 0.0909);
    for (const TurnedTable& pose :
         {TurnedTable{0.0, 0.0}, TurnedTable{0.7, 0.0}, TurnedTable{-1.2, 2.1}}) {
        const Vector3 by_g54 = g + pose.rb * pose.rc * (point_W - g);
        const Vector3 by_1970x = p + pose.rb * (d + pose.rc * (point_W - p - d));
        const auto off = [&](PositioningMode mode, const Vector3& tip_M, double longer_mm = 0.0) {
            return (*meant.at(mode, pose.with_tip(tip_M, longer_mm), longer_mm) - point_W).norm();
        };
        CHECK(off(PositioningMode::dpp, by_g54) < 1e-12);
        CHECK(off(PositioningMode::rtdfo, by_g54, 60.0) < 1e-12);
        CHECK(off(PositioningMode::rtcp, by_1970x) < 1e-12);
        CHECK(off(PositioningMode::tw, by_1970x) < 1e-12);
        CHECK_FALSE(meant.at(PositioningMode::none, pose.with_tip(by_g54), 0.0));
    }
}

TEST_CASE("other stores in force mean another point", "[setup][pivot]") {
    const setup::Setup setup = bc_table();
    auto stores = setup::rotary_stores(setup.machine.chain, setup.stores);
    const TurnedTable pose{0.0, pi};
    const AxisPositions q = pose.with_tip(Vector3(-120.0, 0.0, 80.0));
    stores->g54 = Vector3(0.05, 0.0, 0.0);  // half a turn about x = 0.05
    const setup::ProgrammedPoint meant(setup, stores);
    CHECK((*meant.at(PositioningMode::dpp, q, 0.0) - Vector3(120.1, 0.0, 80.0)).norm() < 1e-12);
}

TEST_CASE("a control without stores of rotary axes means no point on the table", "[setup]") {
    setup::Setup setup = bc_table();
    setup.stores.parameters.set(19680, 0);
    const setup::ProgrammedPoint meant(setup);
    CHECK_FALSE(meant.at(PositioningMode::rtcp, {}, 0.0));
}

}  // namespace trunnion
