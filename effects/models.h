// Factory functions of all effects (*.cpp, by subject), called by the catalogue for each axis.
#pragma once

#include <set>

#include "effects/effect.h"

namespace trunnion::effects {

/// Extent of a set of readings, for the search range of keys.
struct DataExtent {
    double start_s = 0.0;
    double end_s = 7200.0;
    std::vector<std::vector<double>> times_s;  ///< times of the rows of each artefact, rising
    std::set<records::Device> devices;         ///< that read at least one row
    AxisPositions least, most;  ///< commanded positions of rows of devices, mm and rad; both 0
                                ///< without rows
};

/// What the last axis of the tool side carries: where its weight acts, and where it points to.
struct CarriedTool {
    Vector3 centre_S_mm = Vector3::Zero(), along_S = -Vector3::UnitZ();
};

/// `pivots`: the control has stores for where its rotary axes lie.
Effect location_effect(const kinematics::Chain& chain, bool pivots);
Effect rotary_zero(const kinematics::AxisGeometry& axis);
Effect rotary_positioning(const kinematics::AxisGeometry& axis);
Effect rotary_cyclic(const kinematics::AxisGeometry& axis);
Effect rotary_radial(const kinematics::AxisGeometry& axis);
Effect rotary_axial(const kinematics::AxisGeometry& axis);
Effect rotary_tilt(const kinematics::AxisGeometry& axis);
Effect rotary_backlash(const kinematics::AxisGeometry& axis);
Effect rotary_reversal_spike(const kinematics::AxisGeometry& axis);
Effect linear_scale(const kinematics::AxisGeometry& axis);
Effect linear_straightness(const kinematics::AxisGeometry& axis);
Effect linear_angular(const kinematics::AxisGeometry& axis);
Effect linear_cyclic(const kinematics::AxisGeometry& axis);
/// Periods (mm) of ripples that are looked for where an axis is read over this range, mm: 4 to 50,
/// the leads of machine tools; from 200 mm down to shorter ones, because a short stage has a fine
/// screw or scale (100 mm: 1 mm), and to half the range, but not below a 200th of it. 0 mm, where
/// nothing is known of the range: as for a long one.
std::vector<double> ripple_periods_mm(double range_mm);
Effect linear_backlash(const kinematics::AxisGeometry& axis);
Effect linear_reversal_spike(const kinematics::AxisGeometry& axis);
Effect linear_lateral_play(const kinematics::AxisGeometry& axis);
/// XY, YZ or ZX: `moving` is the axis with the squareness error, tilted about direction `about`.
Effect squareness(const std::string& plane, const kinematics::AxisGeometry& moving, int about);
/// `logged`: readings of a servo log see the whole lag of an axis, others what it has more than the
/// other axes.
Effect servo_mismatch(const kinematics::Chain& chain, bool logged);
Effect servo_contour(const kinematics::Chain& chain, bool logged);
/// Where a rotary axis carries the tool, the structure drifts in M besides the tip in S.
Effect thermal_drift(const DataExtent& extent, const kinematics::Chain& chain);
Effect thermal_expansion(const kinematics::Chain& chain);
Effect machine_expansion(const kinematics::Chain& chain);
Effect gravity_sag(const kinematics::AxisGeometry& tilting);
Effect probe_pretravel();
Effect probe_radius();
Effect probe_runout();
Effect tool_length();
Effect ballbar_length();
Effect artefact_position(const std::vector<setup::Artefact>& artefacts);
Effect artefact_form(const std::vector<setup::Artefact>& artefacts);
Effect artefact_moved(const std::vector<setup::Artefact>& artefacts, const DataExtent& extent);
Effect control_rounding(const kinematics::Chain& chain);
Effect control_chord(const kinematics::Chain& chain);
Effect clamp_shift(const kinematics::Chain& chain);
Effect linear_play_load(const kinematics::AxisGeometry& axis);
Effect sensor_gain(const std::vector<setup::Instrument>& instruments);
/// Three effects of chains with a rotary axis on the tool side (required there).
Effect gravity_tool(const kinematics::Chain& chain, const CarriedTool& tool);
Effect chain_collimation(const kinematics::Chain& chain);
Effect chain_flexure(const kinematics::Chain& chain, const CarriedTool& tool);
Effect pivot_g54(const kinematics::Chain& chain);
Effect pivot_p1970x(const kinematics::Chain& chain);

// Helper functions for the factories.

/// Harmonic sum of orders 1, 2, ... of an angle: values[2 (n - 1)] is the cosine, the next one the
/// sine coefficient.
double harmonic_sum(double angle_rad, std::span<const double> values);
/// Parameters PREFIX cosN_UNIT and PREFIX sinN_UNIT, N = 1 .. `orders`, with typical sizes
/// proportional to 1 / N. Most machines show the first `usual_orders` only.
struct Harmonics {
    std::string prefix, unit;
    int orders;
    double typical;
    int usual_orders;
};
void append_harmonics(std::vector<EffectParameter>& list, const Harmonics& harmonics);
/// 0 for an axis along (or about) X, 1 for Y, 2 for Z: the largest component of its direction.
int main_direction(const kinematics::AxisGeometry& axis);
/// Values from `low` to `high` in geometric progression.
std::vector<double> geometric_grid(double low, double high, int count);
/// "EXC", "EAC": ISO 230 name of an error motion; direction 0..5 = X Y Z A B C.
std::string motion_name(int direction, const kinematics::AxisGeometry& axis);
/// An effect of one axis: "C.backlash".
EffectIdentity identity_of(const kinematics::AxisGeometry& axis, EffectKind kind);
/// "tau_" + "x" + "_s".
std::string axis_parameter(const char* before, const kinematics::AxisGeometry& axis,
                           const char* after);
bool is_probe(const emulator::Contact& contact);

}  // namespace trunnion::effects
