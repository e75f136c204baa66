#include "effects/catalogue.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace trunnion::effects {
namespace {

using AxisMaker = Effect (*)(const kinematics::AxisGeometry&);

constexpr AxisMaker rotary_effects[] = {rotary_zero,     rotary_positioning,   rotary_cyclic,
                                        rotary_radial,   rotary_axial,         rotary_tilt,
                                        rotary_backlash, rotary_reversal_spike};
constexpr AxisMaker linear_effects[] = {
    linear_scale,    linear_straightness,   linear_angular,      linear_cyclic,
    linear_backlash, linear_reversal_spike, linear_lateral_play, linear_play_load};

/// The first rotary axis on the work side: the one that gravity loads.
const kinematics::AxisGeometry* tilting_axis(const kinematics::Chain& chain) {
    for (const kinematics::AxisGeometry& axis : chain.work)
        if (axis.rotary) return &axis;
    return nullptr;
}

void append_axis_effects(Catalogue& list, const kinematics::Chain& chain) {
    for (const kinematics::AxisGeometry& axis : chain.axes()) {
        if (axis.rotary)
            for (const AxisMaker make : rotary_effects) list.push_back(make(axis));
        else
            for (const AxisMaker make : linear_effects) list.push_back(make(axis));
    }
}

/// True when the machine has X, Y and Z, which NC words and stores require (a G54 is set in X, Y
/// and Z).
bool has_basic_axes(const kinematics::Chain& chain) {
    const AxisNames names = chain.names();
    return names.find("X") && names.find("Y") && names.find("Z");
}

void append_squareness(Catalogue& list, const kinematics::Chain& chain) {
    list.push_back(squareness("XY", *chain.find(Axis::Y), 2));
    list.push_back(squareness("YZ", *chain.find(Axis::Z), 0));
    list.push_back(squareness("ZX", *chain.find(Axis::Z), 1));
}

std::string parameter_text(const Effect& effect) {
    std::string text, last;
    for (const EffectParameter& p : effect.parameters) {
        if (p.name == last) continue;
        last = p.name;
        text += fmt::format("{}`{}` [{}] {:.3g}{}{}", text.empty() ? "" : ", ", p.name, p.unit,
                            p.typical, p.is_key() ? " (searched)" : "",
                            std::isfinite(p.most) ? fmt::format(" (at most {:.3g})", p.most) : "");
    }
    return text;
}

}  // namespace

namespace {

/// A servo log shows the behaviour of the drive up to the encoder, not the position of the machine.
void hide_from_encoders(Effect& effect) {
    effect.add = [add = std::move(effect.add), seen = effect.seen_by](
                     const AxisSample& sample, const emulator::Contact& contact,
                     std::span<const double> value, kinematics::Perturbation& out) {
        const bool hidden =
            contact.device == records::Device::axis &&
            (seen == SeenBy::no_encoder || (seen == SeenBy::scale && !contact.scale_encoder));
        if (!hidden) add(sample, contact, value, out);
    };
}

}  // namespace

namespace {

/// The line of sight of two crossing axes, perpendicular to both at zero: of its two ends the one
/// that a positive turn raises.
Vector3 line_of_sight(const kinematics::Chain& chain, const Vector3& otherwise) {
    if (chain.tool.size() < 2 || !chain.tool[chain.tool.size() - 2].rotary) return otherwise;
    const Vector3 last = chain.tool.back().direction,
                  across = chain.tool[chain.tool.size() - 2].direction.cross(last);
    if (across.norm() < 1e-6) return otherwise;
    return last.cross(across).z() < 0.0 ? -across.normalized() : across.normalized();
}

/// Of a machine the spindle; of an arm the mean of its targets, or without one its last axis; of a
/// telescope, whose target is on the last axis, the line of sight.
CarriedTool carried_tool(const setup::Setup& setup) {
    CarriedTool tool;
    if (!setup::is_arm(setup.machine.chain)) return tool;
    Vector3 sum_mm = Vector3::Zero();
    double count = 0.0;
    for (const setup::Artefact& target : setup.artefacts) {
        if (!target.tool_S_mm) continue;
        sum_mm += setup.target_S_mm(target);
        count += 1.0;
    }
    const Vector3 last_mm = setup.machine.chain.tool.back().point_mm;
    tool.centre_S_mm = count > 0.0 ? Vector3(sum_mm / count) : last_mm;
    if (const Vector3 reach_mm = tool.centre_S_mm - last_mm; reach_mm.norm() > 1e-6)
        tool.along_S = reach_mm.normalized();
    else
        tool.along_S = line_of_sight(setup.machine.chain, tool.along_S);
    return tool;
}

/// What depends on the range over which an axis is read: the periods of a ripple that are looked
/// for, and the usual slope of a rotary axis. An axis that turns by a few degrees at most gets its
/// angle from an arm or a wedge, whose gain is right by parts of its travel (assumed).
void fit_to_range(const DataExtent& extent, Effect& effect) {
    constexpr double small_rad = 0.3, stands_rad = 1e-3;  // below: jitter of an axis at rest
    if (!effect.axis) return;
    const double range = extent.most[*effect.axis] - extent.least[*effect.axis];
    for (EffectParameter& p : effect.parameters) {
        if (effect.kind == EffectKind::cyclic && p.is_key() && !p.counts_periods)
            p.grid = ripple_periods_mm(range);
        if (p.name == "slope_rad_per_rad" && range >= stands_rad && range < small_rad)
            p.typical *= small_rad / range;
    }
}

}  // namespace

Catalogue make_catalogue(const setup::Setup& setup, const DataExtent& extent) {
    const kinematics::Chain& chain = setup.machine.chain;
    const bool basic = has_basic_axes(chain);
    const bool pivots = basic && tilting_axis(chain);  // the tables of other machines turn nothing
    Catalogue list{location_effect(chain, pivots)};
    if (pivots) {
        list.push_back(pivot_g54(chain));
        list.push_back(pivot_p1970x(chain));
    }
    append_axis_effects(list, chain);
    if (basic) append_squareness(list, chain);
    const bool logged = extent.devices.count(records::Device::axis) > 0;
    list.push_back(servo_mismatch(chain, logged));
    list.push_back(servo_contour(chain, logged));
    list.push_back(thermal_drift(extent, chain));
    list.push_back(thermal_expansion(chain));
    if (const kinematics::AxisGeometry* tilting = tilting_axis(chain))
        list.push_back(gravity_sag(*tilting));
    list.push_back(probe_pretravel());
    list.push_back(probe_radius());
    list.push_back(probe_runout());
    list.push_back(tool_length());
    list.push_back(ballbar_length());
    list.push_back(artefact_position(setup.artefacts));
    list.push_back(artefact_form(setup.artefacts));
    list.push_back(artefact_moved(setup.artefacts, extent));
    list.push_back(control_rounding(chain));
    if (basic) list.push_back(control_chord(chain));
    list.push_back(clamp_shift(chain));
    list.push_back(sensor_gain(setup.instruments));
    list.push_back(machine_expansion(chain));
    if (std::any_of(chain.tool.begin(), chain.tool.end(),
                    [](const kinematics::AxisGeometry& axis) { return axis.rotary; })) {
        const CarriedTool tool = carried_tool(setup);
        list.push_back(gravity_tool(chain, tool));
        list.push_back(chain_collimation(chain));
        list.push_back(chain_flexure(chain, tool));
    }
    for (Effect& effect : list) {
        fit_to_range(extent, effect);
        hide_from_encoders(effect);
    }
    return list;
}

DataExtent extent_of(const setup::Setup& setup, const records::ReadingTable& table) {
    DataExtent extent;
    if (table.rows.empty()) return extent;
    extent.start_s = extent.end_s = table.rows.front().time_s;
    for (const records::Reading& row : table.rows) {
        if (row.device == records::Device::none) continue;
        extent.start_s = std::min(extent.start_s, row.time_s);
        extent.end_s = std::max(extent.end_s, row.time_s);
        const bool first = extent.devices.empty();
        extent.devices.insert(row.device);
        for (const Axis axis : table.axes) {
            double &least = extent.least[axis], &most = extent.most[axis];
            least = first ? row.commanded[axis] : std::min(least, row.commanded[axis]);
            most = first ? row.commanded[axis] : std::max(most, row.commanded[axis]);
        }
    }
    for (const setup::Artefact& artefact : setup.artefacts) {
        std::vector<double> times;
        for (const records::Reading& row : table.rows)
            if (row.device != records::Device::none && row.feature == artefact.name)
                times.push_back(row.time_s);
        extent.times_s.push_back(std::move(times));
    }
    return extent;
}

const Effect* find_effect(const Catalogue& catalogue, const std::string& name) {
    for (const Effect& effect : catalogue)
        if (effect.name == name) return &effect;
    return nullptr;
}

const Effect* find_effect(const Catalogue& catalogue, EffectKind kind, Axis axis) {
    for (const Effect& effect : catalogue)
        if (effect.kind == kind && effect.axis == axis) return &effect;
    return nullptr;
}

std::string describe_catalogue(const Catalogue& catalogue) {
    std::string text =
        "| effect | what it is | usual cause | what to do | formula | parameters [unit] typical |\n"
        "|---|---|---|---|---|---|\n";
    for (const Effect& effect : catalogue)
        text += fmt::format("| `{}` | {} | {} | {} | {} | {} |\n", effect.name, effect.what,
                            effect.cause, effect.remedy, effect.formula, parameter_text(effect));
    return text;
}

}  // namespace trunnion::effects
