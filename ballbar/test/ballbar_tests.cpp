#include "ballbar/test/ballbar_tests.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "base/alarm.h"
#include "base/units.h"

namespace trunnion::ballbar::test {
namespace {

constexpr std::array<std::string_view, 5> kind_names = {"xy", "yz", "zx", "radial", "axial"};

std::string lower(std::string_view text) {
    std::string out(text);
    std::transform(out.begin(), out.end(), out.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return out;
}

/// Unit vectors of a planar test: the angle is counted from `first` to `second`.
std::pair<Vector3, Vector3> plane_of(BallbarTestKind kind) {
    switch (kind) {
        case BallbarTestKind::xy: return {Vector3::UnitX(), Vector3::UnitY()};
        case BallbarTestKind::yz: return {Vector3::UnitY(), Vector3::UnitZ()};
        default: return {Vector3::UnitZ(), Vector3::UnitX()};
    }
}

/// Start and end angle of a planar test: XY a full turn, the others symmetrical about +Z.
std::pair<double, double> planar_range(BallbarTestKind kind, double partial_rad) {
    if (kind == BallbarTestKind::xy) return {0.0, 2.0 * pi};
    const double middle = kind == BallbarTestKind::yz ? 0.5 * pi : 0.0;
    return {middle - 0.5 * partial_rad, middle + 0.5 * partial_rad};
}

}  // namespace

std::optional<BallbarTest> parse_ballbar_test(std::string_view name) {
    const std::string text = lower(name);
    for (std::size_t k = 0; k < kind_names.size(); ++k) {
        if (text.rfind(kind_names[k], 0) != 0) continue;
        const auto kind = static_cast<BallbarTestKind>(k);
        std::size_t end = kind_names[k].size();
        BallbarTest test{kind, std::nullopt};
        if (kind == BallbarTestKind::radial || kind == BallbarTestKind::axial) {
            if (text.size() < end + 2 || text[end] != '_') return std::nullopt;
            test.rotary = axis_of(static_cast<char>(std::toupper(text[end + 1])));
            if (!test.rotary || !is_rotary(*test.rotary)) return std::nullopt;
            end += 2;
        }
        if (end < text.size() && std::isalnum(static_cast<unsigned char>(text[end])))
            return std::nullopt;
        return test;
    }
    return std::nullopt;
}

std::string to_string(const BallbarTest& test) {
    std::string name(kind_names[static_cast<std::size_t>(test.kind)]);
    if (test.rotary) name += std::string("_") + letter_of(*test.rotary);
    return name;
}

std::pair<kinematics::AxisGeometry, kinematics::AxisGeometry> table_axes(
    const kinematics::Chain& chain) {
    std::vector<kinematics::AxisGeometry> rotary;
    for (const kinematics::AxisGeometry& axis : chain.work)
        if (axis.rotary) rotary.push_back(axis);
    if (rotary.size() != 2)
        throw InputError("the single-set-up ballbar test requires two rotary axes under the table");
    return {rotary[0], rotary[1]};
}

Vector3 bar_at_home(const BallbarLayout& layout, const BallbarTest& test,
                    const kinematics::AxisGeometry& axis) {
    const double side = layout.inside ? -1.0 : 1.0;
    const Vector3 arm = layout.pivot_W_mm - axis.point_mm;
    const double along = axis.direction.dot(arm);
    if (test.kind == BallbarTestKind::radial)
        return side * (arm - along * axis.direction).normalized();
    Vector3 up = axis.direction;
    if (along < 0.0 || (along == 0.0 && up.sum() < 0.0)) up = -up;
    return side * up;
}

std::vector<AxisPositions> ideal_path(const kinematics::Machine& nominal,
                                      const BallbarLayout& layout, const BallbarTest& test,
                                      int count, bool negative) {
    const auto [first, second] = table_axes(nominal.chain);
    const bool on_first = test.rotary == first.axis;
    auto range = test.planar() ? planar_range(test.kind, layout.partial_rad)
                 : on_first    ? layout.first_rad
                               : layout.second_rad;
    if (negative) std::swap(range.first, range.second);
    const auto [u, v] = plane_of(test.kind);
    std::vector<AxisPositions> path;
    for (int i = 0; i < count; ++i) {
        const double angle =
            range.first + (range.second - range.first) * i / std::max(1, count - 1);
        AxisPositions q;
        Vector3 bar_W = u * std::cos(angle) + v * std::sin(angle);
        if (test.rotary) {
            q[*test.rotary] = angle;
            bar_W = bar_at_home(layout, test, on_first ? first : second);
        }
        const Vector3 cup_W = layout.pivot_W_mm + layout.length_mm * bar_W;
        const Vector3 gauge_M = nominal.poses(q).pose_MW * cup_W - layout.cup_S_mm;
        q[Axis::X] = gauge_M.x();
        q[Axis::Y] = gauge_M.y();
        q[Axis::Z] = gauge_M.z();
        path.push_back(q);
    }
    return path;
}

namespace {

/// Angle travelled by a planar pass about its own mean point, or by the rotary axis.
double travel_of(const std::vector<records::Reading>& rows, const BallbarPass& pass) {
    const std::size_t last = pass.end - 1;
    if (pass.test.rotary)
        return rows[last].commanded[*pass.test.rotary] -
               rows[pass.begin].commanded[*pass.test.rotary];
    const auto [u, v] = plane_of(pass.test.kind);
    const auto at = [&](std::size_t i) {
        const AxisPositions& q = rows[i].commanded;
        return Vector3(q[Axis::X], q[Axis::Y], q[Axis::Z]);
    };
    double turned = 0.0;  // rotation of the path's tangent
    for (std::size_t i = pass.begin + 1; i < last; ++i) {
        const Vector3 a = at(i) - at(i - 1), b = at(i + 1) - at(i);
        const double cross = u.dot(a) * v.dot(b) - v.dot(a) * u.dot(b);
        if (a.squaredNorm() > 0.0 && b.squaredNorm() > 0.0) turned += std::atan2(cross, a.dot(b));
    }
    // Between n points the tangent turns n - 2 times; the rest of the arc is extrapolated.
    const auto n = static_cast<double>(pass.end - pass.begin);
    return turned * (n - 1.0) / std::max(1.0, n - 2.0);
}

}  // namespace

std::vector<BallbarPass> ballbar_passes(const std::vector<records::Reading>& rows) {
    std::vector<BallbarPass> passes;
    for (std::size_t i = 0; i < rows.size();) {
        std::size_t end = i;
        while (end < rows.size() && rows[end].test == rows[i].test &&
               rows[end].device == rows[i].device)
            ++end;
        const auto test = parse_ballbar_test(rows[i].test);
        if (test && rows[i].device == records::Device::ballbar && end - i >= 3) {
            BallbarPass pass{rows[i].test, *test, i, end, 0.0};
            pass.travel = travel_of(rows, pass);
            passes.push_back(pass);
        }
        i = end;
    }
    return passes;
}

}  // namespace trunnion::ballbar::test
