// Converts the commands of a control into the segments of a layer. The kinematics are believed; of
// the machine only the lengths of its tools are known here.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

#include "motion/motion.h"
#include "regression/chords.h"
#include "regression/short_runs.h"

namespace trunnion::regression {

/// Meaning of a segment's points: the tip in the table frame, or the joints of the machine.
enum class PathSpace : unsigned char { tip, joints };

/// The sink for a Controller that writes a PathRecord.
class PathRecorder : public motion::MotionSink {
  public:
    PathRecorder(PathRecord& record, PathSpace space, const Tolerances& tolerances);

    /// Uses this transform and these tool lengths (mm, by offset number) instead of the control's
    /// own: the path of the tip on a machine for which they are true.
    void see_through(const positioning::RotaryTransform* transform,
                     std::vector<double> tool_length_mm);

    /// Length of the tool T from gauge point to tip, mm; 0 where nobody knows it. With it the path
    /// is that of the tip of the tool in the spindle, whatever offset is active: a wrong or missing
    /// H moves the tip, and so does a cut without one. A tool of unknown length is as long as the
    /// active offset says, and so is any in rapids before the first offset.
    void tools_are(std::function<double(int tool)> length_mm) { tools_ = std::move(length_mm); }

    /// As told by tools_are, mm.
    double length_of_tool_mm(int tool);

    motion::MoveResult move(const motion::AxisMove& move) override;
    /// `on`: the feed of the following moves follows from length and time (G93).
    void feeds_by_time(bool on) { by_time_ = on; }
    void finish();

  private:
    Vector3 offset_vector_mm(const motion::AxisMove& move) const;
    Vector3 tool_vector_mm(const motion::AxisMove& move);
    motion::MoveResult record(const motion::AxisMove& move);
    PathPoint point(const motion::AxisMove& move, const AxisPositions& at);
    void refresh();
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
    std::function<double(int)> tools_;
    std::optional<int> tool_;  ///< whose length `tool_length_mm_` is
    double tool_length_mm_ = 0.0;
    /// Of the present move: from the tip to the gauge point, and the kinematics it is seen through.
    Vector3 vector_mm_ = Vector3::Zero();
    const positioning::RotaryTransform* transform_ = nullptr;
    /// Length active before G49: the path of a fixed spindle point is followed, without jumps.
    std::optional<Vector3> held_vector_mm_;
    const std::string* program_ = nullptr;
    std::uint16_t program_index_ = 0;
    std::vector<PathPoint> points_;
    Segment last_;

    /// With the rotary axes at rest, tip and direction are affine functions of X Y Z.
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
