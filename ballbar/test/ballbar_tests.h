// The passes of a single-set-up ballbar run: which test a row belongs to, and the ideal axis paths.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "kinematics/machine.h"
#include "records/readings.h"

namespace trunnion::ballbar::test {

/// planar: XY, YZ, ZX circles about the centre pivot, rotary axes at zero. radial, axial: the bar
/// points at, or along, a rotary axis and turns with the table (TCP active).
enum class BallbarTestKind : unsigned char { xy, yz, zx, radial, axial };

/// A test as its pass names begin: "xy_ccw_1000", "radial_A_pos", "axial_C_neg". What follows
/// (direction, feed, repetition) is free.
struct BallbarTest {
    BallbarTestKind kind = BallbarTestKind::xy;
    std::optional<Axis> rotary;  ///< of radial and axial

    bool planar() const { return !rotary; }
    friend bool operator==(const BallbarTest&, const BallbarTest&) = default;
};

std::optional<BallbarTest> parse_ballbar_test(std::string_view name);
std::string to_string(const BallbarTest& test);  ///< "xy", "radial_A"

/// Set-up of the run as the operator states it.
struct BallbarLayout {
    Vector3 pivot_W_mm = Vector3::Zero();    ///< centre pivot
    Vector3 cup_S_mm = Vector3(0, 0, -120);  ///< tool cup: (0, 0, -tool length)
    double length_mm = 100.0;                ///< nominal bar length L0
    bool inside = false;                     ///< cup on the smaller concentric circle, or on the
                                             ///< other side of it along the axis
    std::pair<double, double> first_rad = {-0.5235987755982988, 1.5707963267948966};
    std::pair<double, double> second_rad = {0.0, 6.283185307179586};
    double partial_rad = 3.839724354387525;  ///< arc of YZ and ZX tests, half of it each side
                                             ///< of +Z
};

/// The table's two rotary axes, from the bed outwards. Throws InputError for other machines.
std::pair<kinematics::AxisGeometry, kinematics::AxisGeometry> table_axes(
    const kinematics::Chain& chain);

/// Unit vector from pivot to cup of a rotary test at home: radial tests across the axis, away from
/// it (towards it when `inside`), axial ones along it, on the side on which the pivot stands.
Vector3 bar_at_home(const BallbarLayout& layout, const BallbarTest& test,
                    const kinematics::AxisGeometry& axis);

/// Gauge point and rotary angles of `count` points of a test along its ideal path (equal steps,
/// both ends included, rotary or circle angle rising; reversed when `negative`): what an ideal
/// control that knows `nominal` commands.
std::vector<AxisPositions> ideal_path(const kinematics::Machine& nominal,
                                      const BallbarLayout& layout, const BallbarTest& test,
                                      int count, bool negative = false);

/// Rows of one pass: one value of `test`, consecutive.
struct BallbarPass {
    std::string name;
    BallbarTest test;
    std::size_t begin = 0, end = 0;
    double travel = 0.0;  ///< rad the bar or the rotary axis went, + counter-clockwise or + angle
};

/// All passes with a recognised name, in order; rows of other devices and tests are left out.
std::vector<BallbarPass> ballbar_passes(const std::vector<records::Reading>& rows);

}  // namespace trunnion::ballbar::test
