// The passes of a single-set-up ballbar run: assignment of rows to tests, and the ideal axis paths.
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
/// is perpendicular or parallel to a rotary axis and rotates with the table (TCP active).
enum class BallbarTestKind : unsigned char { xy, yz, zx, radial, axial };

/// A test, from the start of the pass name: "xy_ccw_1000", "radial_A_pos", "axial_C_neg". The rest
/// of the name (direction, feed, repetition) is free.
struct BallbarTest {
    BallbarTestKind kind = BallbarTestKind::xy;
    std::optional<Axis> rotary;  ///< of radial and axial

    bool planar() const { return !rotary; }
    friend bool operator==(const BallbarTest&, const BallbarTest&) = default;
};

std::optional<BallbarTest> parse_ballbar_test(std::string_view name);
std::string to_string(const BallbarTest& test);  ///< "xy", "radial_A"

/// Set-up of the run as stated by the operator.
struct BallbarLayout {
    Vector3 pivot_W_mm = Vector3::Zero();    ///< centre pivot
    Vector3 cup_S_mm = Vector3(0, 0, -120);  ///< tool cup: (0, 0, -tool length)
    double length_mm = 100.0;                ///< nominal bar length L0
    bool inside = false;                     ///< cup on the smaller concentric circle, or on the
                                             ///< other side along the axis
    std::pair<double, double> first_rad = {-0.5235987755982988, 1.5707963267948966};
    std::pair<double, double> second_rad = {0.0, 6.283185307179586};
    double partial_rad = 3.839724354387525;  ///< arc of YZ and ZX tests, symmetrical about +Z
};

/// The two rotary table axes, from the bed outwards. Throws InputError for other machines.
std::pair<kinematics::AxisGeometry, kinematics::AxisGeometry> table_axes(
    const kinematics::Chain& chain);

/// Unit vector from pivot to cup of a rotary test at home. Radial tests: perpendicular to the axis,
/// away from it (towards it when `inside`). Axial tests: along the axis, on the pivot's side.
Vector3 bar_at_home(const BallbarLayout& layout, const BallbarTest& test,
                    const kinematics::AxisGeometry& axis);

/// Gauge point and rotary angles of `count` points of a test on its ideal path, as commanded by an
/// ideal control that knows `nominal`: equal steps, both ends included, with rising rotary or
/// circle angle; reversed when `negative`.
std::vector<AxisPositions> ideal_path(const kinematics::Machine& nominal,
                                      const BallbarLayout& layout, const BallbarTest& test,
                                      int count, bool negative = false);

/// Rows of one pass: consecutive rows with the same `test`.
struct BallbarPass {
    std::string name;
    BallbarTest test;
    std::size_t begin = 0, end = 0;
    double travel = 0.0;  ///< rad travelled by the bar or the rotary axis, + counter-clockwise or +
                          ///< angle
};

/// All passes with a recognised name, in order; rows of other devices and tests are ignored.
std::vector<BallbarPass> ballbar_passes(const std::vector<records::Reading>& rows);

}  // namespace trunnion::ballbar::test
