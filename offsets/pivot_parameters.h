// Parameters 19680-19714: what G43.4 and G68.2/G53.1 believe about the rotary axes.
#pragma once

#include <optional>
#include <vector>

#include "geometry/axes.h"
#include "geometry/parallel_axes.h"
#include "geometry/pose.h"
#include "offsets/stores.h"

namespace trunnion::offsets {

/// Parameter 19680: where the two rotary axes sit.
enum class MechanicalUnit : int { none = 0, tool_tool = 2, table_table = 12, mixed = 21 };

/// One rotary axis as the control believes it.
struct PivotAxis {
    Axis axis = Axis::B;
    Vector3 line =
        Vector3::UnitZ();  ///< unit vector of the axis line (19682/19687, inclined: 19683/19688)
    double sign = 1.0;     ///< 19684/19689: +1 right-hand thread, -1 left-hand
    bool hypothetical = false;  ///< 19696#0/#1: no such axis, it stands at 19685/19690
    double hypothetical_rad = 0.0;
    std::optional<double> min_rad, max_rad;  ///< 19741-19744, used when choosing solutions
    /// Unit vector with the sign of a + command: sign * line.
    Vector3 direction() const { return sign * line; }
};

/// The believed five-axis geometry, decoded. First = master (19681..), second = slave (19686..):
/// for a table-table machine the first carries the second, the second carries the work.
struct PivotParameters {
    MechanicalUnit unit = MechanicalUnit::none;
    PivotAxis first, second;
    Vector3 table_point_mm = Vector3::Zero();   ///< 19700-19702: machine zero -> first table axis
    Vector3 table_offset_mm = Vector3::Zero();  ///< 19703-19705: first -> second table axis
    Vector3 tool_offset_mm =
        Vector3::Zero();  ///< 19709-19711: tool axis -> first rotary axis of the tool
    Vector3 tool_second_offset_mm =
        Vector3::Zero();  ///< 19712-19714: 2nd -> 1st rotary axis of the tool
    Vector3 tool_direction =
        Vector3::UnitZ();             ///< 19697 (+ 19698, 19699): tip to spindle, rotaries at zero
    double holder_offset_mm = 0.0;    ///< 19666
    bool frame_follows_work = false;  ///< 19696#5 WKP
    ParallelAxes parallel;            ///< 1022 of U V W
};

/// Decodes the store; nothing when 19680 is 0 or absent. Throws Alarm 5459 (MACHINE PARAMETER
/// INCORRECT) when a value cannot be. `axis_order`: the control's axes, number 1 first (all letters
/// in the order of `Axis` when empty); parameter 1020 of an axis, when set, wins.
/// Inclined axes (19682/19687 = 4, 5, 6) lie in the XY, YZ, ZX plane, turned by 19683/19688 from
/// the first letter towards the second (assumed). 19697 = 0 or absent is +Z (assumed).
std::optional<PivotParameters> decode_pivot(const Parameters& parameters,
                                            const std::vector<Axis>& axis_order = {});
/// Writes the numbers back (used when a setup derives them from its machine): decoding gives the
/// same `direction()` of each axis. Throws InputError for an axis line that lies in no coordinate
/// plane or a tool direction along no linear axis: the numbers cannot say that.
void encode_pivot(const PivotParameters& pivot, Parameters& parameters,
                  const std::vector<Axis>& axis_order = {});

}  // namespace trunnion::offsets
