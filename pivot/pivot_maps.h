// Error maps of the positioning functions: measured as in pivot 2021, and predicted by a machine.
#pragma once

#include <string>
#include <vector>

#include "geometry/pose.h"
#include "kinematics/machine.h"
#include "pivot/pivot_plan.h"
#include "positioning/rotary_transform.h"

namespace trunnion::pivot {

/// One indexation: measured minus expected sphere centre along X Y Z of M; the sphere was zeroed
/// with both rotary axes at 0. First and second axis as in 19681, 19686.
struct PivotPoint {
    double first_deg = 0.0, second_deg = 0.0;
    Vector3 error_mm = Vector3::Zero();
};

/// Least-squares circle of the error as a function of the moving axis: e = centre + Rot(angle)
/// turning, in the plane perpendicular to the axis. Zero when the arc is too short.
struct ErrorCircle {
    Vector3 centre_mm = Vector3::Zero(), turning_mm = Vector3::Zero();
    double radius_mm() const { return turning_mm.norm(); }
};

/// One arc measured with one function.
struct PivotArc {
    std::string function;
    PivotGroup group = PivotGroup::g54;
    std::vector<PivotPoint> points;
    ErrorCircle circle;
    std::vector<Vector3> expected_mm;  ///< of each point, predicted by the known or fitted machine
    ErrorCircle expected;
};

/// One error map: an arc of one axis, the other at rest.
struct PivotMap {
    int number = 0;
    std::string name;  ///< "B arc at C90"
    bool first_moves = true;
    double fixed_deg = 0.0;
    std::vector<PivotArc> arcs;  ///< in the order of pivot_functions()

    double moving_deg(const PivotPoint& p) const {
        return first_moves ? p.first_deg : p.second_deg;
    }
};

/// Sets moving axis and name from the points.
void name_map(PivotMap& map, Axis first, Axis second);

/// `axis_M`: direction of the moving axis (rotation of a + command) in this map.
ErrorCircle fit_circle(const PivotMap& map, const std::vector<PivotPoint>& points,
                       const Vector3& axis_M);
/// Direction of the map's moving axis in M, the other axis at its position in the map.
Vector3 moving_axis_M(const offsets::PivotParameters& pivot, const PivotMap& map);

/// Prediction of the four functions on a physical machine: axis positions commanded from the
/// control's stores for the centre of a sphere, compared with those that actually reach it.
class PivotModel {
  public:
    /// `sphere_mm`: machine coordinates of the tip on the sphere with the rotary axes at zero;
    /// `tip_S_mm`: the stylus ball according to the control's tool length.
    PivotModel(const kinematics::Machine& machine, const setup::RotaryStores& in_force,
               const Vector3& sphere_mm, const Vector3& tip_S_mm);

    /// Measured minus expected centre, mm along M. Includes tilts and all other errors of the
    /// machine; the axes need not intersect. `zero_mm`: error of zeroing the sphere (believed minus
    /// true).
    Vector3 error_mm(PivotGroup group, double first_deg, double second_deg,
                     const Vector3& zero_mm = Vector3::Zero()) const;

  private:
    Vector3 reached_mm(const AxisPositions& turned) const;
    Vector3 commanded_mm(PivotGroup group, const AxisPositions& turned,
                         const Vector3& sphere_mm) const;

    kinematics::Machine machine_;
    positioning::RotaryTransform by_parameters_, by_g54_;
    Vector3 sphere_mm_, tip_S_mm_, sphere_W_mm_;
};

}  // namespace trunnion::pivot
