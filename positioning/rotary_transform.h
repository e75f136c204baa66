// The believed five-axis transform, forward and inverse: stores in, axis positions out.
#pragma once

#include <optional>
#include <vector>

#include "geometry/axes.h"
#include "geometry/pose.h"
#include "offsets/pivot_parameters.h"

namespace trunnion::positioning {

/// One solution of the orientation inverse.
struct RotarySolution {
    double first_rad = 0.0;
    double second_rad = 0.0;
    friend bool operator==(const RotarySolution&, const RotarySolution&) = default;
};

/// Derivatives with respect to X, Y, Z (mm) and the first and second rotary axis (rad), in W. The
/// column of a hypothetical axis is zero.
struct TipDerivative {
    Eigen::Matrix<double, 3, 5> tip;
    Eigen::Matrix<double, 3, 2> direction;  ///< of the tool direction, by the rotary axes only
};

/// Built from the pivot parameters alone; never reads a work offset, never a physical machine.
/// W is the table frame: it coincides with M when all rotary axes are at zero. A hypothetical axis
/// of the table is a fixed wedge below the second axis; one of the tool tilts the tool for good.
class RotaryTransform {
  public:
    explicit RotaryTransform(const offsets::PivotParameters& pivot);

    const offsets::PivotParameters& pivot() const { return pivot_; }

    /// Table frame seen from M at these positions (identity for tool-tool machines).
    Pose pose_MW(const AxisPositions& machine) const;
    /// How far the tool has turned from its direction with the rotaries at zero (identity for
    /// table-table machines).
    Matrix3 tool_rotation_M(const AxisPositions& machine) const;
    /// Believed tip in W; `tool_vector_mm` from tip to gauge point with the rotaries at zero.
    Vector3 tip_W(const AxisPositions& machine, const Vector3& tool_vector_mm) const;
    /// Believed unit vector from tip to spindle, in W.
    Vector3 tool_direction_W(const AxisPositions& machine) const;
    /// X Y Z that put the tip on p_W with the rotary axes and U V W as in `machine`; other axes are
    /// copied.
    AxisPositions machine_for_tip(const Vector3& p_W, const AxisPositions& machine,
                                  const Vector3& tool_vector_mm) const;
    /// Both branches of the rotary angles that point the tool along unit vector n_W, in (-pi, pi];
    /// empty when out of reach. An angle on which nothing depends (the tool along the second axis
    /// of a table, along the first of a head) is free and stays as in `keep`.
    std::vector<RotarySolution> orient(const Vector3& n_W, const RotarySolution& keep) const;
    /// d tip_W / d axis positions and d tool_direction_W / d rotary positions.
    TipDerivative derivative(const AxisPositions& machine, const Vector3& tool_vector_mm) const;

    /// The rotary axes' positions, a hypothetical one at its fixed angle.
    RotarySolution rotaries(const AxisPositions& machine) const;
    /// `machine` with its real rotary axes set.
    AxisPositions with_rotaries(AxisPositions machine, const RotarySolution& angles) const;
    /// The axis that tilts the tool against the work: the one not along the tool with all at zero.
    bool first_tilts() const;

  private:
    /// An axis line with the sign of a + command, all axes at zero; of the table in M, of the tool
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
    double first_fixed_rad_ = 0.0, second_fixed_rad_ = 0.0;  ///< of a hypothetical axis
};

}  // namespace trunnion::positioning
