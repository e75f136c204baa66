// Measured and touched spheres: rows and program of a measurement.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/units.h"
#include "diagnosis/advice/measurement_plan.h"
#include "setup/program_language.h"

namespace trunnion::diagnosis {
namespace {

constexpr double above_mm = sphere_start_mm;
constexpr double stand_off_mm = 3.0;   ///< R of O8100
constexpr double overtravel_mm = 2.0;  ///< Q of O8100
constexpr double probing_feed = 100.0;
constexpr double touch_s = 4.0;

}  // namespace

void MeasurementPlan::touch(const AxisPositions& stand_off, const AxisPositions& end,
                            const Vector3& direction, const std::string& feature) {
    AxisPositions up = last_;
    up[Axis::X] = stand_off[Axis::X];
    up[Axis::Y] = stand_off[Axis::Y];
    const double z = up[Axis::Z];
    pass_through(up);
    pass_through(stand_off);
    records::Reading row = state_;
    row.commanded = end;
    row.device = records::Device::touch;
    row.feature = feature;
    row.direction_M = direction;
    row.feed_mm_min = probing_feed;
    row.clamped = clamped_;
    row.time_s = time_s_ += touch_s;
    result_.table.rows.push_back(row);
    pass_through(stand_off);
    up[Axis::Z] = z;
    pass_through(up);
}

void MeasurementPlan::nine_touches(const setup::Artefact& sphere, const AxisPositions& center) {
    const double reach = 0.5 * (sphere.diameter_mm + setup_.probe->ball_diameter_mm);
    for (int k = 0; k < 9; ++k) {
        const double lift = rad_from_deg(k == 0 ? 90.0 : k < 5 ? 45.0 : 15.0);
        const double turn = rad_from_deg(k == 0  ? 0.0
                                         : k < 5 ? 90.0 * (k - 1)
                                                 : 90.0 * (k - 5) + 45.0);
        const Vector3 out(std::cos(lift) * std::cos(turn), std::cos(lift) * std::sin(turn),
                          std::sin(lift));
        const auto at = [&](double distance) {
            AxisPositions q = center;
            for (const Axis axis : {Axis::X, Axis::Y, Axis::Z})
                q[axis] += distance * out(static_cast<int>(index_of(axis)));
            return q;
        };
        touch(at(reach + stand_off_mm), at(reach - overtravel_mm), -out, sphere.name);
    }
    AxisPositions home = center;
    home[Axis::Z] = last_[Axis::Z];
    pass_through(home);
}

void MeasurementPlan::call_sphere(const setup::Artefact& sphere, const AxisPositions& center) {
    const controller::ClampCode* clamp = setup_.clamps.empty() ? nullptr : &setup_.clamps.front();
    if (clamped_) {
        clamp ? void(result_.program += fmt::format("M{}\n", clamp->m_clamp))
              : stop("CLOSE THE CLAMPS");
        tell("CLAMPED 1");
    }
    result_.program += fmt::format("G65 P8100 D{:.4f} S{:.4f} H{:.1f}\n", sphere.diameter_mm,
                                   setup_.probe->ball_diameter_mm, above_mm);
    nine_touches(sphere, center);
    if (!clamped_) return;
    clamp ? void(result_.program += fmt::format("M{}\n", clamp->m_release))
          : stop("OPEN THE CLAMPS");
    tell("CLAMPED 0");
}

bool MeasurementPlan::sphere(std::size_t which, const std::vector<double>& angles_deg,
                             double approach_deg) {
    const setup::Artefact& sphere = spheres_[which % spheres_.size()];
    const AxisPositions before = rotary_at(angles_deg, approach_deg);
    const Target target = aim(rotary_at(angles_deg, 0.0), sphere.center_W_mm, tip_S());
    if (!target.reachable || !aim(before, sphere.center_W_mm, tip_S()).reachable) return false;
    AxisPositions over = target.at;
    over[Axis::Z] += above_mm;
    go_clear();
    go(before, false);
    go(target.at, false);
    AxisPositions high = over;
    high[Axis::Z] = last_[Axis::Z];
    go(high, true);
    go(over, true);
    call_sphere(sphere, target.at);
    return true;
}

/// Stores the position of the sphere at home: in #520-#522 relative to G54, or in G55.
void MeasurementPlan::keep_home(bool dpp) {
    if (dpp) {
        result_.program += fmt::format(
            "G54\n(SPHERE FOUND AT HOME, IN G54. FROM HERE ON THE PROGRAM TURNS IT ABOUT G54.)\n"
            "#520=#5041+#100\n#521=#5042+#101\n#522=#5043-{:.1f}+#102\nG59\n",
            above_mm);
        return;
    }
    overwrites_ = "G55, G59, tool offset 99, #520 to #522";
    const double tip_z = tip_S().z();
    std::string zeros;
    for (const kinematics::AxisGeometry& axis : rotary_)
        zeros += fmt::format("{}0.", letter_of(axis.axis));
    result_.program += fmt::format(
        "(SPHERE FOUND AT HOME INTO G55, PROBE LENGTH INTO OFFSET 99)\n"
        "G10 L2 P2 X[#5041+#100] Y[#5042+#101] Z[#5043-{:.1f}+#102{:+.4f}] {}\n"
        "G10 L10 P99 R{:.4f}\n",
        above_mm, tip_z, zeros, -tip_z);
}

/// The gauge point above the rotated sphere as a post processor would compute it: relative to G54.
void MeasurementPlan::lead_by_g54(const AxisPositions& rotary) {
    const Vector3 tip = tip_S();
    Vector3 g54 = Vector3::Zero();
    for (std::size_t d = 0; d < 3; ++d)
        g54(static_cast<int>(d)) = setup_.stores.work.standard[0][all_axes[d]];
    const Pose turned = setup_.machine.poses(rotary).pose_MW;
    const Matrix3& a = turned.rotation;
    const Vector3 c = turned * Vector3(g54 + tip) - tip - g54;
    const auto point = [&](int d, double lift) {
        return fmt::format("{}[{:.7f}*#520{:+.7f}*#521{:+.7f}*#522{:+.4f}]", "XYZ"[d], a(d, 0),
                           a(d, 1), a(d, 2), c(d) + lift);
    };
    result_.program += fmt::format("G54\nG0 {} {}\nM98P8102\nG0 {}\nM98P8102\nG59\n", point(0, 0.0),
                                   point(1, 0.0), point(2, above_mm));
}

/// The same by tool centre point control; the control rotates the point about 19700-19705.
void MeasurementPlan::lead_by_tcp(const AxisPositions& before, const AxisPositions& rotary) {
    const Vector3 over_W =
        setup_.machine.poses(rotary).pose_MW.rotation.transpose() * (above_mm * Vector3::UnitZ());
    const auto lead = [&](const AxisPositions& at) {
        return fmt::format("G0 X{:.4f} Y{:.4f} Z{:.4f}{}\nM98P8102\n",
                           plan_rounded(over_W.x(), 1e-4), plan_rounded(over_W.y(), 1e-4),
                           plan_rounded(over_W.z(), 1e-4), words(at, false));
    };
    const bool hurco = setup::is_hurco(setup::language_of(setup_));  // its G43.4 leads no tip alone
    result_.program += fmt::format(
                           "DPRNT[MODE*DIRECT]\nG0{}\nM98P8102\nG55\nDPRNT[MODE*RTCP]\n"
                           "{} H99 X0. Y0. Z{:.1f}\n{}M98P8102\n",
                           words({}, false), hurco ? "G43" : "G43.4", above_mm + 60.0,
                           hurco ? "M128\nG43.4\n" : "") +
                       lead(before) + lead(rotary) +
                       fmt::format(
                           "#7=#5021\n#8=#5022\n#9=#5023\n{}G49 G53 G0 X#7 Y#8 Z#9\n"
                           "M98P8102\nG59\n",
                           hurco ? "M129\n" : "");
    const Vector3 center_W = spheres_.front().center_W_mm;
    pass_through(aim({}, center_W + (above_mm + 60.0) * Vector3::UnitZ(), tip_S()).at);
    pass_through(aim(before, center_W + over_W, tip_S()).at);
    pass_through(aim(rotary, center_W + over_W, tip_S()).at);
}

/// Under G43.4 the linear axes follow the turn from home, and go further than at both ends.
bool MeasurementPlan::can_lead_by_tcp(const AxisPositions& before, const Vector3& center_W) const {
    constexpr int looks = 40;
    const Vector3 from = (above_mm + 60.0) * Vector3::UnitZ();
    const Vector3 to =
        setup_.machine.poses(before).pose_MW.rotation.transpose() * (above_mm * Vector3::UnitZ());
    for (int k = 0; k <= looks; ++k) {
        const double part = static_cast<double>(k) / looks;
        AxisPositions at = before;
        for (double& q : at.value) q *= part;
        if (!aim(at, center_W + from + part * (to - from), tip_S()).reachable) return false;
    }
    return true;
}

void MeasurementPlan::sphere_by_store(PositioningMode mode,
                                      const std::vector<std::vector<double>>& angles_deg,
                                      double approach_deg) {
    const auto& tool = setup_.machine.chain.tool;
    if (std::any_of(tool.begin(), tool.end(),
                    [](const kinematics::AxisGeometry& a) { return a.rotary; }))
        return;  // the code below is for tables only
    const setup::Artefact& sphere = spheres_.front();
    if (!this->sphere(0, {0.0, 0.0}, approach_deg)) return;
    const bool dpp = mode == PositioningMode::dpp;
    keep_home(dpp);
    for (const auto& angles : angles_deg) {
        const AxisPositions at = rotary_at(angles, 0.0), before = rotary_at(angles, approach_deg);
        const Target target = aim(at, sphere.center_W_mm, tip_S());
        if (!target.reachable || !aim(before, sphere.center_W_mm, tip_S()).reachable ||
            !can_lead_by_tcp(before, sphere.center_W_mm))  // the same poses in both modes
            continue;
        go_clear();
        state_.mode = mode;
        if (dpp) {
            tell("POSITIONS STORE");
            go(before, false);
            go(at, false);
            lead_by_g54(at);
        } else {
            lead_by_tcp(before, at);
        }
        AxisPositions over = target.at;
        if (dpp) {
            over[Axis::Z] = last_[Axis::Z];
            pass_through(over);
        }
        over[Axis::Z] = target.at[Axis::Z] + above_mm;
        pass_through(over);
        call_sphere(sphere, target.at);
        if (dpp) tell("POSITIONS DIRECT");
        state_.mode = PositioningMode::none;
    }
}

/// One touch of the first sphere along -out, from above its approach point.
void MeasurementPlan::ring_touch(const Target& target, const AxisPositions& over,
                                 const Vector3& out) {
    const setup::Artefact& sphere = spheres_.front();
    const double reach = 0.5 * (sphere.diameter_mm + setup_.probe->ball_diameter_mm);
    const auto at = [&](double distance) {
        AxisPositions q = target.at;
        for (const Axis axis : {Axis::X, Axis::Y, Axis::Z})
            q[axis] =
                plan_rounded(q[axis] + distance * out(static_cast<int>(index_of(axis))), 1e-4);
        return q;
    };
    const AxisPositions off = at(reach + stand_off_mm), end = at(reach - overtravel_mm);
    AxisPositions up = off;
    up[Axis::Z] = over[Axis::Z];
    Vector3 way;
    for (const Axis axis : {Axis::X, Axis::Y, Axis::Z})
        way(static_cast<int>(index_of(axis))) = end[axis] - off[axis];
    const std::string here = "\nM98P8102\n";
    result_.program +=
        "G0" + words(up, true) + here + "G0" + words(off, true) + here +
        "#7=#5041\n#8=#5042\n#9=#5043\nG31" + words(end, true) +
        fmt::format(" F{0:.0f}\nG65P8101X#7Y#8Z#9I{1:.4f}J{2:.4f}K{3:.4f}F{0:.0f}\nG0",
                    probing_feed, way.x(), way.y(), way.z()) +
        words(off, true) + here + "G0" + words(up, true) + here;
    touch(off, end, way.normalized(), sphere.name);
}

void MeasurementPlan::azimuth_touches(const std::vector<double>& angles_deg,
                                      const std::vector<Ring>& rings) {
    const setup::Artefact& sphere = spheres_.front();
    const Target target = aim(rotary_at(angles_deg, 0.0), sphere.center_W_mm, tip_S());
    if (!target.reachable) return;
    go_clear();
    go(target.at, false);
    const double reach = 0.5 * (sphere.diameter_mm + setup_.probe->ball_diameter_mm);
    AxisPositions over = target.at;
    over[Axis::Z] = last_[Axis::Z];
    go(over, true);
    over[Axis::Z] = target.at[Axis::Z] + above_mm;
    go(over, true);
    for (const Ring& ring : rings) {
        const double lift = rad_from_deg(ring.lift_deg);
        if (std::sin(lift) * (reach + stand_off_mm) > above_mm) continue;
        for (int k = 0; k < ring.touches; ++k) {
            const double turn = 2.0 * pi * k / ring.touches;
            ring_touch(
                target, over,
                {std::cos(lift) * std::cos(turn), std::cos(lift) * std::sin(turn), std::sin(lift)});
        }
    }
}

}  // namespace trunnion::diagnosis
