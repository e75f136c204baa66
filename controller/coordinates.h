// From program words to machine coordinates: all coordinate stages, compiled into one affine map.
#pragma once

#include <array>
#include <optional>

#include "offsets/control_position.h"

namespace trunnion::controller {

/// The stages between an absolute program position and the gauge point, in the order applied:
///
///   program --mirror, scaling--> --2-D rotation--> shaped        (#5001.. are shaped positions)
///   shaped  --local shift G52--> [--tilted plane--> ] --G92, work offset, external, G54.2--> tip
///   tip     --tool length--> machine (gauge point, mm and deg)
///
/// After changing a stage, call compile() and let the control derive its program position again.
/// Tool centre point control replaces the last step (motion/tool_centre_point.h).
class Coordinates {
  public:
    /// G51.1 and G51, axis by axis: p' = centre + factor (p - centre).
    struct AxisFactor {
        offsets::ControlPosition centre;
        offsets::ControlPosition factor;
    };
    /// G68: right-handed rotation about `axis` through `centre` (program coordinates after mirror
    /// and scaling).
    struct PlaneRotation {
        Vector3 centre = Vector3::Zero();
        Vector3 axis = Vector3::UnitZ();
        double angle_deg = 0.0;
    };

    std::optional<AxisFactor> mirror;
    std::optional<AxisFactor> scaling;
    std::optional<PlaneRotation> rotation;
    offsets::ControlPosition local;  ///< G52; in a tilted plane along the plane's axes
    /// G68.2: the feature frame in machine coordinates without tool length. While it is active it
    /// replaces `work_origin` for X Y Z; other axes keep their work offset.
    std::optional<Pose> feature_MF;
    offsets::ControlPosition plane_local;  ///< G52 active when G68.2 was given; part of work_origin
    offsets::ControlPosition preset;       ///< G92
    offsets::ControlPosition external;     ///< external offset
    offsets::ControlPosition work;         ///< G54-G59 or G54.1 Pn
    offsets::ControlPosition fixture;      ///< G54.2, rotated with the table
    offsets::ControlPosition length;       ///< tool length vector, from tip to gauge point

    Coordinates() { compile(); }
    void compile();

    /// Origin of the work frame in machine coordinates: all shifts except G52.
    offsets::ControlPosition work_origin() const;
    offsets::ControlPosition machine_from_program(const offsets::ControlPosition& program) const {
        if (!is_shift_) return machine_general(program);
        offsets::ControlPosition out;
        for (std::size_t i = 0; i < axis_count; ++i)
            out.value[i] = program.value[i] + total_.value[i];
        return out;
    }
    offsets::ControlPosition program_from_machine(const offsets::ControlPosition& machine) const;
    /// Position after mirror, scaling and 2-D rotation, as shown by #5001.
    offsets::ControlPosition shaped_from_program(const offsets::ControlPosition& program) const;

    /// True when the map of X Y Z is a pure shift, so arcs and feeds need no transformation.
    bool is_shift() const { return is_shift_; }
    /// The linear part of the map of X Y Z.
    const Matrix3& linear() const { return linear_; }

  private:
    offsets::ControlPosition machine_general(const offsets::ControlPosition& program) const;

    bool is_shift_ = true;
    Matrix3 linear_ = Matrix3::Identity(), inverse_ = Matrix3::Identity();
    Matrix3 shape_ = Matrix3::Identity();
    offsets::ControlPosition shape_shift_;  ///< shaped = shape * program + shape_shift
    offsets::ControlPosition factor_;       ///< for the axes other than X Y Z
    offsets::ControlPosition total_;        ///< machine = linear * program + total
};

}  // namespace trunnion::controller
