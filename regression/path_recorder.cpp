#include "regression/path_recorder.h"

#include <algorithm>
#include <cmath>

#include "base/units.h"
#include "positioning/rotary_transform.h"

namespace trunnion::regression {

namespace {

/// Duration of a move at constant rate, without the ramps, which depend on its neighbours.
double even_time_s(const motion::AxisMove& move) {
    const bool even = move.length_mm > 0.0 && move.feed_mm_min > 0.0;
    return even ? 60.0 * move.length_mm / move.feed_mm_min : move.duration_s;
}

Vector3 rotary_of(const AxisPositions& p) {
    return {p[Axis::A], p[Axis::B], p[Axis::C]};
}

/// For a control without five-axis transform the machine is unknown: the rotary axes are applied in
/// the order A, B, C about X, Y, Z to a direction parallel to none of them, so that each one has an
/// effect.
Vector3 direction_without_transform(const AxisPositions& p) {
    const Vector3 rotary = rotary_of(p);
    if (rotary.isZero(0.0)) return Vector3(0.36, 0.48, 0.8);
    return rotation_about(Vector3::UnitX(), rotary.x()) *
           (rotation_about(Vector3::UnitY(), rotary.y()) *
            (rotation_about(Vector3::UnitZ(), rotary.z()) * Vector3(0.36, 0.48, 0.8)));
}

void set_end(Segment& segment, const PathPoint& p) {
    segment.end_mm = {p.position_mm.x(), p.position_mm.y(), p.position_mm.z()};
    segment.end_orientation = {p.orientation.x(), p.orientation.y(), p.orientation.z()};
}

double turned_rad(const motion::AxisMove& move) {
    return (rotary_of(move.to) - rotary_of(move.from)).cwiseAbs().maxCoeff();
}

}  // namespace

PathRecorder::PathRecorder(PathRecord& record, PathSpace space, const Tolerances& tolerances)
    : record_(record),
      runs_(record, tolerances.position_mm),
      space_(space),
      tolerances_(tolerances) {}

void PathRecorder::finish() {
    runs_.finish();
    record_.finish();
}

/// Prepares the map from X Y Z to the tip for the rotary positions in frame_.
void PathRecorder::refresh() {
    frame_.tool_vector_mm = vector_mm_;
    frame_.transform = transform_;
    frame_.valid = true;
    if (transform_ == nullptr) {
        frame_.rotation = Matrix3::Identity();
        frame_.translation_mm = -vector_mm_;
        frame_.direction = direction_without_transform(frame_.rotary);
        return;
    }
    frame_.table_point_mm = transform_->pivot().table_point_mm;
    frame_.table_offset_mm = transform_->pivot().table_offset_mm;
    AxisPositions at = frame_.rotary;
    const Pose pose_WM = transform_->pose_MW(at).inverse();
    for (const Axis axis : all_axes)
        if (!is_rotary(axis)) at[axis] = 0.0;
    frame_.rotation = pose_WM.rotation;
    frame_.translation_mm = transform_->tip_W(at, vector_mm_);
    frame_.direction = transform_->tool_direction_W(at);
}

PathPoint PathRecorder::point(const motion::AxisMove& move, const AxisPositions& at) {
    const Vector3 linear_mm = move.parallel.linear(at);
    if (space_ == PathSpace::joints) return {linear_mm, rotary_of(at)};
    const positioning::RotaryTransform* t = transform_;
    const bool same = frame_.valid && frame_.transform == t &&
                      rotary_of(frame_.rotary) == rotary_of(at) &&
                      frame_.tool_vector_mm == vector_mm_ &&
                      (t == nullptr || (t->pivot().table_point_mm == frame_.table_point_mm &&
                                        t->pivot().table_offset_mm == frame_.table_offset_mm));
    if (!same) {
        frame_.rotary = at;
        refresh();
    }
    return {frame_.rotation * linear_mm + frame_.translation_mm, frame_.direction};
}

Segment PathRecorder::plain_segment(const motion::AxisMove& move) {
    Segment s;
    s.kind = move.kind == motion::MotionKind::rapid ? SegmentKind::rapid : SegmentKind::feed;
    s.feed_mm_min = s.kind == SegmentKind::feed ? static_cast<float>(move.feed_mm_min) : 0.0F;
    s.spindle_rpm = static_cast<float>(move.spindle_rpm);
    s.coolant = move.coolant;
    s.timed = by_time_;
    s.tool = static_cast<std::uint16_t>(move.tool);
    s.mode = static_cast<std::uint8_t>(move.mode);
    s.line = static_cast<std::uint32_t>(move.line);
    if (move.program != program_ && move.program != nullptr) {
        program_ = move.program;
        program_index_ = record_.program_index(*move.program);
    }
    s.program = program_index_;
    return s;
}

void PathRecorder::see_through(const positioning::RotaryTransform* transform,
                               std::vector<double> tool_length_mm) {
    seen_through_ = transform;
    seen_length_mm_ = std::move(tool_length_mm);
}

/// As the active offset says; without one, as the last one said, so that G49 is no jump.
Vector3 PathRecorder::offset_vector_mm(const motion::AxisMove& move) const {
    if (move.tool_vector_mm.isZero(0.0)) return held_vector_mm_.value_or(move.tool_vector_mm);
    const auto offset = static_cast<std::size_t>(std::max(0, move.tool_offset));
    if (seen_through_ == nullptr || offset >= seen_length_mm_.size()) return move.tool_vector_mm;
    return seen_length_mm_[offset] / move.tool_vector_mm.norm() * move.tool_vector_mm;
}

double PathRecorder::length_of_tool_mm(int tool) {
    if (tool_ != tool) {
        tool_ = tool;
        tool_length_mm_ = tools_ ? tools_(tool) : 0.0;
    }
    return tool_length_mm_;
}

Vector3 PathRecorder::tool_vector_mm(const motion::AxisMove& move) {
    const double length_mm = length_of_tool_mm(move.tool);
    // Rapids before the first G43 say nothing of the tool's length, which may be measured again.
    const bool before_any = !held_vector_mm_ && move.tool_vector_mm.isZero(0.0) &&
                            move.kind == motion::MotionKind::rapid;
    if (length_mm == 0.0 || before_any) return offset_vector_mm(move);
    return length_mm *
           (transform_ != nullptr ? transform_->pivot().tool_direction : Vector3::UnitZ());
}

motion::MoveResult PathRecorder::move(const motion::AxisMove& move) {
    transform_ = seen_through_ != nullptr ? seen_through_ : move.transform;
    vector_mm_ = tool_vector_mm(move);
    if (!vector_mm_.isZero(0.0)) held_vector_mm_ = vector_mm_;
    return record(move);
}

motion::MoveResult PathRecorder::record(const motion::AxisMove& move) {
    Segment segment = plain_segment(move);
    const PathPoint start = point(move, move.from);
    if (!begun_) {
        begun_ = true;
        Segment origin = segment;
        origin.kind = SegmentKind::origin;
        set_end(origin, start);
        runs_.add(origin);
        last_ = origin;
    } else if (Vector3(last_.end_mm.data()) != start.position_mm) {
        // G43, G49, a new table frame: the believed tip changes without motion.
        const double jump_mm = (Vector3(last_.end_mm.data()) - start.position_mm).norm();
        Segment jump = segment;
        jump.kind = SegmentKind::jump;
        jump.feed_mm_min = 0.0F;
        set_end(jump, start);
        if (jump_mm > 1e-9) runs_.add(jump);
    }
    const PathPoint end = point(move, move.to);
    segment.turning = turned_rad(move) > 0.0;
    segment.timed = segment.timed || segment.turning;
    set_end(segment, end);
    const bool curved = move.curve != nullptr || (space_ == PathSpace::tip && segment.turning);
    if (move.arc && !segment.turning)
        add_arc(move, segment, end);
    else if ((curved || move.arc) && segment.kind == SegmentKind::feed)
        add_curve(move, segment);
    else
        runs_.add(segment);  // rapids with rotation: only their end is relevant
    last_ = segment;
    return {};
}

void PathRecorder::add_arc(const motion::AxisMove& move, Segment segment, const PathPoint& end) {
    AxisPositions at = move.from;
    const Vector3& c = move.arc->centre_mm;
    at[Axis::X] = c.x();
    at[Axis::Y] = c.y();
    at[Axis::Z] = c.z();
    const Vector3 centre = point(move, at).position_mm;
    at[Axis::X] += move.arc->normal.x();
    at[Axis::Y] += move.arc->normal.y();
    at[Axis::Z] += move.arc->normal.z();
    const Vector3 normal = point(move, at).position_mm - centre;
    segment.centre_mm = {centre.x(), centre.y(), centre.z()};
    segment.normal = {static_cast<float>(normal.x()), static_cast<float>(normal.y()),
                      static_cast<float>(normal.z())};
    segment.sweep_rad = move.arc->sweep_rad;
    set_end(segment, end);
    runs_.add(segment);
}

void PathRecorder::add_curve(const motion::AxisMove& move, const Segment& segment) {
    points_.clear();
    const int pieces = 1 + static_cast<int>(turned_rad(move) / (pi / 4.0));
    sample_curve([&](double s) { return point(move, move.at(s)); }, pieces, tolerances_, points_);
    Segment chord = segment;
    if (space_ == PathSpace::tip && move.duration_s > 0.0) {
        // The speed of the tip, however it is programmed (G43.4, or G93 with own kinematics).
        double length_mm = 0.0;
        Vector3 from = point(move, move.from).position_mm;
        for (const PathPoint& p : points_) {
            length_mm += (p.position_mm - from).norm();
            from = p.position_mm;
        }
        if (length_mm > tolerances_.position_mm)
            chord.feed_mm_min = static_cast<float>(60.0 * length_mm / even_time_s(move));
    }
    for (const PathPoint& p : points_) {
        set_end(chord, p);
        runs_.add(chord);
    }
}

}  // namespace trunnion::regression
