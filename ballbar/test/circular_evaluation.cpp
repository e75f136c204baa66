#include "ballbar/test/circular_evaluation.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "base/units.h"
#include "records/samples.h"

namespace trunnion::ballbar::test {

namespace {

Vector2 in_plane(const AxisPositions& q, BallbarTestKind plane) {
    const auto [u, v] = axes_of_plane(plane);
    return {q[u], q[v]};
}

/// Angle, reading and sample of each row of a pass about the centre of the commanded circle.
CircularPass make_pass(const records::ReadingTable& table, const std::vector<AxisSample>& samples,
                       const BallbarPass& pass, const Vector2& center) {
    CircularPass out{pass.name, pass.travel > 0.0, table.rows[pass.begin].feed_mm_min, {}, {}, {},
                     {}};
    double last = 0.0;
    for (std::size_t i = pass.begin; i < pass.end; ++i) {
        if (!table.rows[i].value_mm) continue;
        const Vector2 arm = in_plane(table.rows[i].commanded, pass.test.kind) - center;
        double angle = std::atan2(arm.y(), arm.x());
        if (!out.angle_rad.empty()) angle += 2.0 * pi * std::round((last - angle) / (2.0 * pi));
        last = angle;
        out.angle_rad.push_back(angle);
        out.radial_mm.push_back(*table.rows[i].value_mm);
        out.samples.push_back(samples[i]);
    }
    return out;
}

Vector2 arm_of(const CircularPass& pass, std::size_t i, double radius_mm) {
    return radius_mm * Vector2(std::cos(pass.angle_rad[i]), std::sin(pass.angle_rad[i]));
}

/// Pivot and mean radius by least squares of reading = |arm - pivot| - nominal + (mean - nominal).
/// Exact for any eccentricity of the set-up, so that a perfect circle gives zero deviation.
CircleFit centre(const std::vector<const CircularPass*>& passes, double radius_mm) {
    Vector3 x = Vector3::Zero();  // pivot, mean - nominal
    for (int iteration = 0; iteration < 4; ++iteration) {
        Matrix3 normal = Matrix3::Zero();
        Vector3 right = Vector3::Zero();
        for (const CircularPass* pass : passes)
            for (std::size_t i = 0; i < pass->angle_rad.size(); ++i) {
                const Vector2 bar = arm_of(*pass, i, radius_mm) - x.head<2>();
                const Vector3 row(-bar.x() / bar.norm(), -bar.y() / bar.norm(), 1.0);
                normal += row * row.transpose();
                right += row * (pass->radial_mm[i] - (bar.norm() - radius_mm) - x.z());
            }
        const Eigen::LDLT<Matrix3> solver(normal);
        if (solver.vectorD().minCoeff() <= 1e-9 * normal.trace()) break;
        x += solver.solve(right);
    }
    return {x.head<2>(), radius_mm + x.z(), 0.0};
}

double spread_um(const std::vector<double>& values_mm) {
    const auto [low, high] = std::minmax_element(values_mm.begin(), values_mm.end());
    return um_from_mm(*high - *low);
}

/// Radius of the other pass at an angle, by linear interpolation; empty outside its arc.
class RadiusAt {
  public:
    RadiusAt(const CircularPass& pass, const std::vector<double>& radial_mm) {
        for (std::size_t i = 0; i < radial_mm.size(); ++i)
            points_.emplace_back(wrap(pass.angle_rad[i]), radial_mm[i]);
        std::sort(points_.begin(), points_.end());
    }
    static double wrap(double angle) { return angle - 2.0 * pi * std::floor(angle / (2.0 * pi)); }

    std::optional<double> operator()(double angle_rad) const {
        const double a = wrap(angle_rad);
        const auto above = std::lower_bound(points_.begin(), points_.end(), std::pair(a, -1e300));
        if (above == points_.begin() || above == points_.end()) return std::nullopt;
        const auto below = above - 1;
        const double gap = above->first - below->first;
        if (gap > 0.1) return std::nullopt;  // outside the measured arc
        const double t = gap > 0.0 ? (a - below->first) / gap : 0.0;
        return below->second + t * (above->second - below->second);
    }

  private:
    std::vector<std::pair<double, double>> points_;
};

void add_hysteresis(const CircularTest& test, const CircularPass& ccw, const CircularPass& cw,
                    CircularFigures& out) {
    const auto r_ccw = centred_radial_mm(ccw, test.circle, test.radius_mm);
    const RadiusAt r_cw(cw, centred_radial_mm(cw, test.circle, test.radius_mm));
    for (std::size_t i = 0; i < r_ccw.size(); ++i) {
        const auto other = r_cw(ccw.angle_rad[i]);
        if (!other) continue;
        const double gap_um = um_from_mm(std::abs(r_ccw[i] - *other));
        if (gap_um <= out.hysteresis_um) continue;
        out.hysteresis_um = gap_um;
        out.hysteresis_at_rad = RadiusAt::wrap(ccw.angle_rad[i]);
    }
}

}  // namespace

std::pair<Axis, Axis> axes_of_plane(BallbarTestKind plane) {
    switch (plane) {
        case BallbarTestKind::xy: return {Axis::X, Axis::Y};
        case BallbarTestKind::yz: return {Axis::Y, Axis::Z};
        default: return {Axis::Z, Axis::X};
    }
}

std::string plane_name(BallbarTestKind plane) {
    const auto [u, v] = axes_of_plane(plane);
    return {letter_of(u), letter_of(v)};
}

std::vector<double> centred_radial_mm(const CircularPass& pass, const CircleFit& circle,
                                      double radius_mm) {
    std::vector<double> out;
    for (std::size_t i = 0; i < pass.angle_rad.size(); ++i) {
        const double bar_mm = (arm_of(pass, i, radius_mm) - circle.center_mm).norm();
        out.push_back(pass.radial_mm[i] - (bar_mm - radius_mm));
    }
    return out;
}

std::vector<CircularTest> circular_tests(const records::ReadingTable& table, double radius_mm) {
    const std::vector<AxisSample> samples = records::samples_of(table);
    std::vector<CircularTest> tests;
    for (const BallbarPass& pass : ballbar_passes(table.rows)) {
        if (!pass.test.planar()) continue;
        std::vector<Vector2> commanded;
        for (std::size_t i = pass.begin; i < pass.end; ++i)
            commanded.push_back(in_plane(table.rows[i].commanded, pass.test.kind));
        const auto circle = fit_circle(commanded);
        if (!circle) continue;
        const CircularPass made = make_pass(table, samples, pass, circle->center_mm);
        auto same = std::find_if(tests.begin(), tests.end(), [&](const CircularTest& test) {
            return test.plane == pass.test.kind &&
                   std::abs(test.passes.front().feed_mm_min - made.feed_mm_min) < 1.0;
        });
        if (same == tests.end()) {
            tests.push_back(
                {pass.test.kind, radius_mm, std::abs(pass.travel), {}, circle->center_mm, {}});
            same = tests.end() - 1;
        }
        same->passes.push_back(made);
    }
    for (CircularTest& test : tests) {
        std::vector<const CircularPass*> all;
        for (CircularPass& pass : test.passes) {
            pass.circle = centre({&pass}, radius_mm);
            all.push_back(&pass);
        }
        test.circle = centre(all, radius_mm);
    }
    return tests;
}

CircularFigures circular_figures(const CircularTest& test) {
    CircularFigures out;
    std::vector<double> all;
    const CircularPass *ccw = nullptr, *cw = nullptr;
    for (const CircularPass& pass : test.passes) {
        double& figure = pass.ccw ? out.circularity_ccw_um : out.circularity_cw_um;
        figure = std::max(figure, spread_um(centred_radial_mm(pass, pass.circle, test.radius_mm)));
        const auto own = centred_radial_mm(pass, test.circle, test.radius_mm);
        all.insert(all.end(), own.begin(), own.end());
        (pass.ccw ? ccw : cw) = &pass;
    }
    if (all.empty()) return out;
    const auto [low, high] = std::minmax_element(all.begin(), all.end());
    out.radial_deviation_min_um = um_from_mm(*low);
    out.radial_deviation_max_um = um_from_mm(*high);
    out.mean_radial_deviation_um = um_from_mm(test.circle.radius_mm - test.radius_mm);
    out.bidirectional = ccw && cw;
    if (!out.bidirectional) return out;
    out.bidirectional_circularity_um = um_from_mm(*high - *low);
    add_hysteresis(test, *ccw, *cw, out);
    return out;
}

}  // namespace trunnion::ballbar::test
