#include "emulator/body_touch.h"

#include <algorithm>

#include "base/units.h"
#include "kinematics/tool_sense.h"
#include "probe/cylinders.h"

namespace trunnion::emulator {

namespace {

probe::Solid box(const Vector3& low, const Vector3& high) {
    return {false, low, high, 0.0, 0.0};
}

/// Four walls that overlap at the corners.
std::vector<probe::Solid> walls(const setup::Body& body) {
    const double x = 0.5 * body.size_mm.x(), y = 0.5 * body.size_mm.y();
    const double out_x = x + body.wall_mm, out_y = y + body.wall_mm, z = -body.size_mm.z();
    return {box({-out_x, -out_y, z}, {-x, out_y, 0.0}), box({x, -out_y, z}, {out_x, out_y, 0.0}),
            box({-out_x, -out_y, z}, {out_x, -y, 0.0}), box({-out_x, y, z}, {out_x, out_y, 0.0}),
            box({-out_x, -out_y, z - body.wall_mm}, {out_x, out_y, z})};
}

/// The machine on the move, and the feeler that comes along it.
class OnMove {
  public:
    OnMove(const motion::AxisMove& move, const AxisSample& start, const Feeler& feeler,
           const Observer& observer)
        : move_(move), start_(start), feeler_(feeler), observer_(observer) {
        const Vector3 way =
            kinematics::tool_senses(observer.setup().machine.chain)
                .cwiseProduct(move.parallel.linear(move.to) - move.parallel.linear(move.from));
        length_mm_ = way.norm();
        if (!feeler.is_tool()) contact_.device = records::Device::touch;
        contact_.stylus = !feeler.is_tool();
        contact_.tip = feeler.is_tool();
        contact_.direction_M = length_mm_ > 0.0 ? Vector3(way / length_mm_) : Vector3::UnitZ();
        const kinematics::MachinePose poses = observer.nominal(start);
        contact_.direction_W = poses.pose_MW.rotation.transpose() * contact_.direction_M;
    }

    Vector3 middle_W_mm(double s) const {
        const PhysicalState state = observer_.at(sample(s), contact_);
        const Vector3 tip_S = feeler_.middle_S_mm + state.extra.tip_shift_mm;
        return state.poses.pose_MW.inverse() * (state.poses.pose_MS * tip_S) -
               state.extra.work_shift_mm;
    }
    /// The tool in the frame of the body.
    probe::Cylinder tool_B(double s, const Pose& pose_BW) const {
        const kinematics::MachinePose poses = observer_.at(sample(s), contact_).poses;
        const Vector3 axis_W =
            poses.pose_MW.rotation.transpose() * (poses.pose_MS.rotation * Vector3::UnitZ());
        return {pose_BW * middle_W_mm(s), (pose_BW.rotation * axis_W).normalized(),
                feeler_.length_mm, feeler_.radius_mm};
    }
    /// Pretravel delays the skip signal by this fraction of the move.
    double later(double s, const setup::Body& body) const {
        if (length_mm_ == 0.0) return 0.0;
        const double later_mm = feeler_.is_tool()
                                    ? mm_from_um(body.pretravel_um)
                                    : observer_.at(sample(s), contact_).extra.reading_mm;
        return later_mm / length_mm_;
    }

  private:
    AxisSample sample(double s) const {
        AxisSample here = start_;
        here.position = move_.at(s);
        here.time_s += s * move_.duration_s;
        return here;
    }

    const motion::AxisMove& move_;
    const AxisSample& start_;
    const Feeler& feeler_;
    const Observer& observer_;
    Contact contact_;
    double length_mm_ = 0.0;
};

}  // namespace

Feeler stylus_of(const setup::ProbeSettings& probe) {
    return {probe.tip_S_mm, 0.5 * probe.ball_diameter_mm, 0.0};
}

Feeler feeler_of(const setup::PhysicalTool& tool, const motion::AxisMove& move,
                 double spindle_rad) {
    const bool turns = move.spindle_rpm != 0.0;
    return {tool.tip_S_mm(spindle_rad, turns), tool.radius_mm(turns), tool.length_mm};
}

std::vector<probe::Solid> solids_of(const setup::Body& body) {
    const double radius = 0.5 * body.diameter_mm;
    const Vector3 half(0.5 * body.size_mm.x(), 0.5 * body.size_mm.y(), 0.0);
    const Vector3 low(0.0, 0.0, -body.height_mm);
    switch (body.kind) {
        case setup::Body::Kind::block:
            return {box({-half.x(), -half.y(), -body.size_mm.z()}, half)};
        case setup::Body::Kind::pocket: return walls(body);
        case setup::Body::Kind::boss:
        case setup::Body::Kind::setter: return {{true, low, Vector3::Zero(), 0.0, radius}};
        case setup::Body::Kind::ring:
            return {{true, low, Vector3::Zero(), radius, radius + body.wall_mm}};
    }
    return {};
}

namespace {

std::optional<double> contact_of_ball(const OnMove& on, const setup::Body& body, double radius_mm) {
    const Pose pose_BW = body.pose_WB().inverse();
    return probe::first_contact(
        solids_of(body), [&](double s) { return Vector3(pose_BW * on.middle_W_mm(s)); }, radius_mm);
}

/// A tool meets setters alone.
std::optional<double> contact_of_tool(const OnMove& on, const setup::Body& body) {
    if (body.kind != setup::Body::Kind::setter) return std::nullopt;
    const Pose pose_BW = body.pose_WB().inverse();
    const probe::Cylinder disc{Vector3(0.0, 0.0, -body.height_mm), Vector3::UnitZ(), body.height_mm,
                               0.5 * body.diameter_mm};
    return probe::first_contact(disc, [&](double s) { return on.tool_B(s, pose_BW); });
}

}  // namespace

std::optional<BodyTouch> touch_bodies(const motion::AxisMove& move, const AxisSample& start,
                                      const Feeler& feeler, const Observer& observer) {
    const OnMove on(move, start, feeler, observer);
    std::optional<BodyTouch> first;
    for (const setup::Body& body : observer.setup().bodies) {
        const auto s = feeler.is_tool() ? contact_of_tool(on, body)
                                        : contact_of_ball(on, body, feeler.radius_mm);
        if (s && (!first || *s < first->contact_s)) first = {{*s, *s, &body}};
    }
    if (!first) return first;
    first->s = first->contact_s + on.later(first->contact_s, *first->body);
    if (first->s > 1.0) return std::nullopt;
    first->s = std::max(0.0, first->s);
    return first;
}

}  // namespace trunnion::emulator
