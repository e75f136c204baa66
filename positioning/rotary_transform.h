// The believed five-axis transform, forward and inverse, from the pivot parameters.
#pragma once

#include <optional>
#include <vector>

#include "geometry/axes.h"
#include "geometry/pose.h"
#include "offsets/pivot_parameters.h"

namespace trunnion::positioning {

/// One solution of the inverse orientation problem.
struct RotarySolution {
    double first_rad = 0.0;
    double second_rad = 0.0;
    friend bool operator==(const RotarySolution&, const RotarySolution&) = default;
};

/// Derivatives with respect to X, Y, Z (mm) and the first and second rotary axis (rad), in W: tip
/// mm per mm or rad, direction per rad. The column of a hypothetical axis is zero.
struct TipDerivative {
    Eigen::Matrix<double, 3, 5> tip;
    Eigen::Matrix<double, 3, 2> direction;  ///< of the tool direction, rotary axes only
};

/// The believed kinematics. It is built from the pivot parameters alone and uses neither work
/// offsets nor the physical machine. W is the table frame: it coincides with M when all rotary axes
/// are at zero. A hypothetical axis of the table is a constant rotation below the second axis; a
/// hypothetical axis of the tool tilts the tool by a constant angle.
///
/// Units: mm and rad. Closed formulas throughout. Forward and inverse agree to 1e-9 mm; orient() is
/// accurate to 1e-12 rad, and to 2e-11 rad for directions within 1e-10 rad of a singular one. The
/// transform is defined for all positions; only orient() has singular cases (see there).
class RotaryTransform {
  public:
    explicit RotaryTransform(const offsets::PivotParameters& pivot);

    const offsets::PivotParameters& pivot() const { return pivot_; }

    /// Table frame seen from M (identity on tool-tool machines).
    Pose pose_MW(const AxisPositions& machine) const;
    /// Believed tip in W, mm. `tool_vector_mm`: from the tip to the gauge point, rotary axes at
    /// zero, in M.
    Vector3 tip_W(const AxisPositions& machine, const Vector3& tool_vector_mm) const;
    /// Believed unit vector from the tip towards the spindle, in W.
    Vector3 tool_direction_W(const AxisPositions& machine) const;
    /// X Y Z that put the tip on p_W, with the rotary axes and U V W as in `machine`. Other axes
    /// are copied. Always solvable.
    AxisPositions machine_for_tip(const Vector3& p_W, const AxisPositions& machine,
                                  const Vector3& tool_vector_mm) const;
    /// All rotary angles in (-pi, pi] that point the tool along the unit vector n_W: two solutions
    /// in general, one at the limit of reach, none when n_W is out of reach or the two axes are
    /// parallel. Singular case: when the tool is parallel to the second axis of a table, or to the
    /// first axis of a head, that angle has no influence on the direction; it keeps its value of
    /// `keep`.
    std::vector<RotarySolution> orient(const Vector3& n_W, const RotarySolution& keep) const;
    /// Derivatives of tip_W and of the tool direction in W, analytic.
    TipDerivative derivative(const AxisPositions& machine, const Vector3& tool_vector_mm) const;

    /// Positions of the rotary axes; a hypothetical axis is at its fixed angle.
    RotarySolution rotaries(const AxisPositions& machine) const;
    /// `machine` with its real rotary axes set to `angles`.
    AxisPositions with_rotaries(AxisPositions machine, const RotarySolution& angles) const;
    /// True when the first axis tilts the tool against the workpiece, that is, when it is not
    /// parallel to the tool at zero.
    bool first_tilts() const;

  private:
    /// An axis line with the direction of a + command, all axes at zero: table axes in M, tool axes
    /// in S.
    struct Line {
        Vector3 u = Vector3::UnitZ();
        Vector3 point_mm = Vector3::Zero();
    };
    struct Turn {  ///< sine and cosine of an angle
        double s, c;
        Turn inverse() const { return {-s, c}; }
    };
    struct Turns {
        Turn first, second;
    };
    static Vector3 turned(const Line& line, const Turn& turn, const Vector3& v);
    static Vector3 moved(const Line& line, const Turn& turn, const Vector3& p);
    static Turn turn_of(const AxisPositions& machine, const offsets::PivotAxis& axis,
                        double fixed_rad);
    Turns turns(const AxisPositions& machine) const;
    Vector3 from_W(const Turns& q, const Vector3& p_W) const;
    Vector3 to_W(const Turns& q, const Vector3& p_M) const;
    Vector3 direction_to_W(const Turns& q, const Vector3& v_M) const;
    Vector3 swing(const Turns& q, const Vector3& p_S) const;
    Vector3 tool_direction_M(const Turns& q) const;
    void place_table_lines();
    void place_tool_lines();

    offsets::PivotParameters pivot_;
    Line first_, second_;
    double first_fixed_rad_ = 0.0, second_fixed_rad_ = 0.0;  ///< angle of a hypothetical axis
};

}  // namespace trunnion::positioning
