// The believed five-axis transform, forward and inverse: stores in, axis positions out.
#pragma once

#include <optional>
#include <vector>

#include "geometry/axes.h"
#include "geometry/pose.h"
#include "offsets/pivot_parameters.h"

namespace trunnion {

/// One solution of the orientation inverse.
struct RotarySolution {
    double first_rad = 0.0;
    double second_rad = 0.0;
};

/// Built from the pivot parameters alone; never reads a work offset, never a physical machine.
/// W is the table frame: it coincides with M when all rotary axes are at zero.
class RotaryTransform {
  public:
    explicit RotaryTransform(const PivotParameters& pivot);

    const PivotParameters& pivot() const { return pivot_; }

    /// Table frame seen from M at these positions (identity for tool-tool machines).
    Pose pose_MW(const AxisPositions& machine) const;
    /// Believed tip in W; `tool_vector_mm` from tip to gauge point with the rotaries at zero.
    Vector3 tip_W(const AxisPositions& machine, const Vector3& tool_vector_mm) const;
    /// Believed unit vector from tip to spindle, in W.
    Vector3 tool_direction_W(const AxisPositions& machine) const;
    /// Gauge point (X Y Z of M) that puts the tip on p_W with the rotary axes as in `machine`; other
    /// axes are copied.
    AxisPositions machine_for_tip(const Vector3& p_W, const AxisPositions& machine,
                                  const Vector3& tool_vector_mm) const;
    /// Both branches of the rotary angles that point the tool along unit vector n_W; empty when out
    /// of reach. When the tool is along the second axis its angle is free: `keep_second_rad` is kept.
    std::vector<RotarySolution> orient(const Vector3& n_W, double keep_second_rad) const;

  private:
    PivotParameters pivot_;
};

}  // namespace trunnion
