// Thermal effects: drift of the spindle with time, expansion of the scales.
#include <algorithm>
#include <cmath>
#include <optional>

#include "effects/models.h"

namespace trunnion::effects {

namespace {

/// The axis next to the bed on the tool side, where the spindle side turns: what moves it moves all
/// that it carries, in the frame M. Empty where S and M are parallel.
std::optional<Axis> carrier_of_turning_tool(const kinematics::Chain& chain) {
    const bool turns =
        std::any_of(chain.tool.begin(), chain.tool.end(),
                    [](const kinematics::AxisGeometry& axis) { return axis.rotary; });
    return turns ? std::optional(chain.tool.front().axis) : std::nullopt;
}

/// Where the clock of the readings starts late (a time of day, a log in the middle of a shift)
/// nothing is known of the time before. An exponential that was counted from zero would have a size
/// that no reading shows: 7 mm for 11 um seen an hour later.
double drift_start_s(const DataExtent& extent, double span_s) {
    constexpr double at_once = 0.1;  // of the time of the readings
    return extent.start_s > at_once * span_s ? extent.start_s : 0.0;
}

}  // namespace

Effect thermal_drift(const DataExtent& extent, const kinematics::Chain& chain) {
    const double span_s = std::max(600.0, extent.end_s - extent.start_s);
    const double from_s = drift_start_s(extent, span_s);
    Effect effect{
        identity_of(EffectKind::thermal_drift),
        "Tool and table drift apart slowly as the machine warms up",
        "spindle and structure warming after switching on or a change of load",
        "warm up before measuring; return to a reference sphere every 15 minutes",
        "tool tip shifted by d_mm (1 - exp(-(time_s - from_s) / tau_s)), in S; none before "
        "from_s",
        {},
        {}};
    for (int d = 0; d < 3; ++d) effect.parameters.push_back({"d_mm", "mm", 15e-3, d, {}, true});
    effect.parameters.push_back(
        {"tau_s", "s", 1800.0, -1, geometric_grid(span_s / 60.0, span_s * 3.0, 9), true});
    effect.parameters.push_back({"from_s", "s", from_s, -1, {from_s}, false});
    const std::optional<Axis> carrier = carrier_of_turning_tool(chain);
    if (carrier) {
        effect.formula += "; spindle side by structure_mm (...), in M";
        for (int d = 0; d < 3; ++d)
            effect.parameters.push_back({"structure_mm", "mm", 15e-3, d, {}, true});
    }
    effect.add = [carrier](const AxisSample& sample, const emulator::Contact&,
                           std::span<const double> value, kinematics::Perturbation& out) {
        const double since_s = std::max(0.0, sample.time_s - value[4]);
        const double grown = -std::expm1(-since_s / value[3]);
        out.tip_shift_mm += grown * Vector3(value[0], value[1], value[2]);
        if (carrier)
            out.motion[index_of(*carrier)].shift_mm +=
                grown * Vector3(value[5], value[6], value[7]);
    };
    return effect;
}

namespace {

std::vector<Axis> linear_axes(const kinematics::Chain& chain) {
    std::vector<Axis> axes;
    for (const kinematics::AxisGeometry& axis : chain.axes())
        if (!axis.rotary) axes.push_back(axis.axis);
    return axes;
}

}  // namespace

Effect thermal_expansion(const kinematics::Chain& chain) {
    Effect effect{identity_of(EffectKind::thermal_expansion),
                  "Scales and screws grow with temperature: positions stretch away from zero",
                  "room or machine warmer than 20 degrees without scale compensation",
                  "let it settle, or switch on thermal compensation",
                  "position + growth_per_k * (temperature - 20) * q",
                  {},
                  {}};
    for (const kinematics::AxisGeometry& axis : chain.axes()) {
        if (axis.rotary) continue;
        effect.parameters.push_back(
            {axis_parameter("growth_", axis, "_per_k"), "1/K", 8e-6, -1, {}, true});
    }
    effect.add = [axes = linear_axes(chain)](const AxisSample& sample, const emulator::Contact&,
                                             std::span<const double> value,
                                             kinematics::Perturbation& out) {
        for (std::size_t j = 0; j < axes.size(); ++j)
            out.axis[axes[j]] +=
                value[j] * (sample.temperature_c - 20.0) * sample.position[axes[j]];
    };
    return effect;
}

Effect machine_expansion(const kinematics::Chain& chain) {
    return {
        identity_of(EffectKind::machine_expansion),
        "All linear axes stretch or shrink alike",
        "scales and screws as one warmer or colder than 20 degrees, without a record of the "
        "temperature",
        "measure at 20 degrees, or record the temperature; check the instrument: one that "
        "reads too long or too short looks the same",
        "position + stretch_ppm 1e-6 q, all linear axes",
        {{"stretch_ppm", "ppm", 20.0, -1, {}, true}},
        [axes = linear_axes(chain)](const AxisSample& sample, const emulator::Contact&,
                                    std::span<const double> value, kinematics::Perturbation& out) {
            for (const Axis axis : axes) out.axis[axis] += 1e-6 * value[0] * sample.position[axis];
        }};
}

}  // namespace trunnion::effects
