// Turns what a control commands into segments of a layer. Belief only: no physical machine.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "motion/motion.h"
#include "regression/chords.h"
#include "regression/short_runs.h"

namespace trunnion::regression {

/// What a segment's points are: the tip in the table frame, or the joints of the machine.
enum class PathSpace : unsigned char { tip, joints };

/// The sink for a Controller that writes a PathRecord.
class PathRecorder : public motion::MotionSink {
  public:
    PathRecorder(PathRecord& record, PathSpace space, const Tolerances& tolerances);

    /// Sees the axes through this transform and these tool lengths (mm, by offset number) instead
    /// of the control's own: where the tip goes on a machine for which they are true.
    void see_through(const positioning::RotaryTransform* transform,
                     std::vector<double> tool_length_mm);

    motion::MoveResult move(const motion::AxisMove& move) override;
    /// The feed of the moves that come is that of their length and time: G93.
    void feeds_by_time(bool on) { by_time_ = on; }
    void finish();

  private:
    motion::MoveResult record(const motion::AxisMove& move);
    PathPoint point(const motion::AxisMove& move, const AxisPositions& at);
    void refresh(const motion::AxisMove& move);
    Segment plain_segment(const motion::AxisMove& move);
    void add_arc(const motion::AxisMove& move, Segment segment, const PathPoint& end);
    void add_curve(const motion::AxisMove& move, const Segment& segment);

    PathRecord& record_;
    ShortRuns runs_;
    PathSpace space_;
    Tolerances tolerances_;
    bool begun_ = false, by_time_ = false;
    const positioning::RotaryTransform* seen_through_ = nullptr;
    std::vector<double> seen_length_mm_;
    /// Length in force before G49, kept: a point of the spindle that does not jump is followed.
    std::optional<Vector3> held_vector_mm_;
    const std::string* program_ = nullptr;
    std::uint16_t program_index_ = 0;
    std::vector<PathPoint> points_;
    Segment last_;

    /// With the rotary axes standing, tip and direction are an affine map of X Y Z.
    struct Frame {
        AxisPositions rotary;
        Vector3 tool_vector_mm = Vector3::Zero();
        const positioning::RotaryTransform* transform = nullptr;
        Vector3 table_point_mm = Vector3::Zero(), table_offset_mm = Vector3::Zero();
        Matrix3 rotation = Matrix3::Identity();
        Vector3 translation_mm = Vector3::Zero();
        Vector3 direction = Vector3::UnitZ();
        bool valid = false;
    } frame_;
};

}  // namespace trunnion::regression
