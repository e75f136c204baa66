// Parameters 19680-19714: the control's belief about the rotary axes, for G43.4 and G68.2/G53.1.
#pragma once

#include <optional>
#include <vector>

#include "geometry/axes.h"
#include "geometry/parallel_axes.h"
#include "geometry/pose.h"
#include "offsets/stores.h"

namespace trunnion::offsets {

/// Parameter 19680: location of the two rotary axes.
enum class MechanicalUnit : int { none = 0, tool_tool = 2, table_table = 12, mixed = 21 };

/// One rotary axis in the control's belief.
struct PivotAxis {
    Axis axis = Axis::B;
    Vector3 line =
        Vector3::UnitZ();  ///< unit vector of the axis line (19682/19687, inclined: 19683/19688)
    double sign = 1.0;     ///< 19684/19689: +1 right-handed, -1 left-handed
    bool hypothetical = false;  ///< 19696#0/#1: the axis does not exist; its angle is 19685/19690
    double hypothetical_rad = 0.0;
    std::optional<double> min_rad, max_rad;  ///< 19741-19744, limits for the choice between
                                             ///< solutions
    /// Unit vector of the rotation of a + command: sign * line.
    Vector3 direction() const { return sign * line; }
};

/// The believed five-axis geometry, decoded. First = master (19681..), second = slave (19686..). On
/// a table-table machine the first axis carries the second, and the second carries the workpiece.
struct PivotParameters {
    MechanicalUnit unit = MechanicalUnit::none;
    PivotAxis first, second;
    Vector3 table_point_mm = Vector3::Zero();   ///< 19700-19702: machine zero -> first table axis
    Vector3 table_offset_mm = Vector3::Zero();  ///< 19703-19705: first -> second table axis
    Vector3 tool_offset_mm =
        Vector3::Zero();  ///< 19709-19711: tool axis -> first rotary axis of the tool
    Vector3 tool_second_offset_mm =
        Vector3::Zero();                        ///< 19712-19714: 2nd -> 1st rotary axis of the tool
    Vector3 tool_direction = Vector3::UnitZ();  ///< 19697 (+ 19698, 19699): from tip to spindle,
                                                ///< rotary axes at zero
    double holder_offset_mm = 0.0;              ///< 19666
    bool frame_follows_work = false;            ///< 19696#5 WKP
    ParallelAxes parallel;                      ///< 1022 of U V W
};

/// Decodes the store; empty when 19680 is 0 or absent. Throws Alarm 5459 (MACHINE PARAMETER
/// INCORRECT) for an invalid value. `axis_order`: axes of the control, number 1 first (empty: the
/// order of `Axis`); parameter 1020 of an axis has priority. Inclined axes (19682/19687 = 4, 5, 6)
/// lie in the XY, YZ, ZX plane, rotated by 19683/19688 from the first letter towards the second
/// (assumed). 19697 = 0 or absent means +Z (assumed).
std::optional<PivotParameters> decode_pivot(const Parameters& parameters,
                                            const std::vector<Axis>& axis_order = {});
/// Encodes the geometry as parameters (used when a setup derives them from its machine); decoding
/// gives the same `direction()` of each axis. Throws InputError for an axis line that lies in no
/// coordinate plane or a tool direction that is parallel to no linear axis: the parameters cannot
/// express these.
void encode_pivot(const PivotParameters& pivot, Parameters& parameters,
                  const std::vector<Axis>& axis_order = {});

}  // namespace trunnion::offsets
