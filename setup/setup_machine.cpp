// [machine]: chain, axes and geometric errors of a setup file.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/units.h"
#include "setup/setup_reader.h"

namespace trunnion::setup {
namespace {

double from_file(bool rotary, double value) {
    return rotary ? rad_from_deg(value) : value;
}

void read_limits(const TomlFile& file, const TomlValue& table, kinematics::AxisGeometry& axis) {
    const TomlValue* limits = table.find(axis.rotary ? "limits_deg" : "limits_mm");
    if (!limits) return;
    const std::vector<double> both = file.numbers(*limits);
    if (both.size() != 2 || both[0] >= both[1])
        file.fail(*limits, "limits are two rising numbers [lowest, highest]");
    axis.min = from_file(axis.rotary, both[0]);
    axis.max = from_file(axis.rotary, both[1]);
}

void read_dynamics(const TomlFile& file, const TomlValue& table, kinematics::AxisGeometry& axis) {
    if (const TomlValue* speed = table.find(axis.rotary ? "max_deg_min" : "max_mm_min"))
        axis.max_speed = from_file(axis.rotary, file.positive(*speed)) / 60.0;
    if (const TomlValue* most = table.find(axis.rotary ? "accel_deg_s2" : "accel_mm_s2"))
        axis.max_acceleration = from_file(axis.rotary, file.positive(*most));
}

constexpr const char* rotary_keys[] = {"point_mm", "limits_deg", "max_deg_min", "accel_deg_s2",
                                       "backlash_rad"};
constexpr const char* linear_keys[] = {"limits_mm", "max_mm_min", "accel_mm_s2", "backlash_mm"};

template <class Keys>
const TomlValue* first_of(const TomlValue& table, const Keys& keys) {
    for (const char* key : keys)
        if (const TomlValue* value = table.find(key)) return value;
    return nullptr;
}

/// A, B and C are rotary, the other letters linear, as NC words address them. An axis with another
/// name is rotary if it has a key of rotary axes. Keys of both kinds are refused.
void read_kind(const TomlFile& file, const TomlValue& table, kinematics::AxisGeometry& axis) {
    if (!is_letter(axis)) axis.rotary = first_of(table, rotary_keys) != nullptr;
    const TomlValue* other =
        axis.rotary ? first_of(table, linear_keys) : first_of(table, rotary_keys);
    if (other)
        file.fail(*other, fmt::format("this key is for a {} axis, and {} is a {} one",
                                      axis.rotary ? "linear" : "rotary", axis.name,
                                      axis.rotary ? "rotary" : "linear"));
}

/// The direction of a linear axis with a letter follows from its letter. Whether a rotary table
/// turns with its word or against it must be given.
void read_direction(const TomlFile& file, const TomlValue& table, kinematics::AxisGeometry& axis) {
    const TomlValue* direction = table.find("direction");
    if (!direction && is_letter(axis) && !axis.rotary) return;
    if (!direction)
        file.fail(table, "axis " + axis.name +
                             " has no direction: what a + command does to the carried body, in M");
    const Vector3 v = file.vector3(*direction);
    if (v.norm() < 1e-9) file.fail(*direction, "a direction is not the zero vector");
    axis.direction = std::abs(v.norm() - 1.0) < 1e-15 ? v : Vector3(v.normalized());
}

kinematics::ErrorCurve read_curve(const TomlFile& file, const TomlValue& value, bool rotary);

/// One gap everywhere is the effect; a gap that depends on the place is a curve.
void read_gap(const TomlFile& file, const TomlValue& table, const kinematics::AxisGeometry& axis,
              Setup& setup) {
    const TomlValue* gap = table.find(axis.rotary ? "backlash_rad" : "backlash_mm");
    if (!gap) return;
    if (gap->kind == TomlValue::Kind::table)
        setup.gap[index_of(axis.axis)] = read_curve(file, *gap, axis.rotary);
    else
        add_effect_key(
            file, *gap,
            {axis.name + ".backlash", axis.rotary ? "gap_rad" : "gap_mm", file.number(*gap)},
            setup);
}

void read_axis(const TomlFile& file, const TomlValue& table, kinematics::AxisGeometry& axis,
               Setup& setup) {
    read_kind(file, table, axis);
    if (axis.rotary) {
        const TomlValue* point = table.find("point_mm");
        if (!point)
            file.fail(table, "rotary axis " + axis.name +
                                 " has no point_mm: a point of its line in M, all axes at zero");
        axis.point_mm = file.vector3(*point);
    }
    read_direction(file, table, axis);
    read_limits(file, table, axis);
    read_dynamics(file, table, axis);
    read_gap(file, table, axis, setup);
}

kinematics::AxisGeometry* find_axis(kinematics::Chain& chain, std::string_view name) {
    for (auto* side : {&chain.work, &chain.tool})
        for (kinematics::AxisGeometry& axis : *side)
            if (axis.name == name) return &axis;
    return nullptr;
}

/// Location of the axis's own encoder: at the motor, or a scale behind the drive.
bool read_scale_encoder(const TomlFile& file, const TomlValue& table) {
    const TomlValue* encoder = table.find("encoder");
    if (!encoder) return false;
    if (file.text(*encoder) != "motor" && file.text(*encoder) != "scale")
        file.fail(*encoder, "encoder is \"motor\" or \"scale\"");
    return encoder->text == "scale";
}

double read_encoder_zero(const TomlFile& file, const TomlValue& table, bool rotary) {
    const TomlValue* zero = table.find(rotary ? "encoder_zero_rad" : "encoder_zero_mm");
    if (!zero) return 0.0;
    return file.number(*zero);
}

double read_time_constant(const TomlFile& file, const TomlValue& table) {
    const TomlValue* constant = table.find("time_constant_s");
    if (!constant) return 0.0;
    const double seconds = file.number(*constant);
    if (seconds < 0.0 || seconds > 10.0)
        file.fail(*constant, "time_constant_s is from 0 to 10 seconds");
    return seconds;
}

/// Sides from which the axes arrived before their first move; default: travelling +.
void read_sides(const TomlFile& file, const TomlValue& sides, Setup& setup) {
    for (const auto& [name, value] : file.table(sides).entries) {
        value.used = true;
        const kinematics::AxisGeometry* axis = find_axis(setup.machine.chain, name);
        if (!axis) file.fail(value, "axis " + name + " does not stand in the chain");
        if (file.text(value) != "+" && file.text(value) != "-")
            file.fail(value, "a side is \"+\" or \"-\"");
        setup.side_before[index_of(axis->axis)] = value.text == "+" ? 1 : -1;
    }
}

/// Letters beside the chain.
void read_auxiliary(const TomlFile& file, const TomlValue& names, Setup& setup) {
    for (const std::string& name : file.texts(names)) {
        const auto axis = name.size() == 1 ? axis_of(name[0]) : std::nullopt;
        if (!axis) file.fail(names, "an auxiliary axis is one of X Y Z A B C U V W");
        const auto twice = [&](const auto& other) { return other.axis == *axis; };
        if (setup.machine.chain.find(*axis) ||
            std::any_of(setup.auxiliary.begin(), setup.auxiliary.end(), twice))
            file.fail(names, "axis " + name + " stands twice, in the chain or here");
        kinematics::AxisGeometry geometry;
        geometry.axis = *axis;
        geometry.name = name;
        geometry.rotary = is_rotary(*axis);
        setup.auxiliary.push_back(geometry);
    }
}

/// Travel and speeds only.
bool read_auxiliary_axis(const TomlFile& file, const std::string& name, const TomlValue& table,
                         Setup& setup) {
    for (kinematics::AxisGeometry& axis : setup.auxiliary) {
        if (axis.name != name) continue;
        for (const char* key :
             {"direction", "point_mm", "encoder", "encoder_zero_mm", "encoder_zero_rad",
              "time_constant_s", "backlash_mm", "backlash_rad"})
            if (const TomlValue* value = file.table(table).find(key))
                file.fail(*value, "axis " + name + " is auxiliary: it has travel and speeds only");
        read_kind(file, table, axis);
        read_limits(file, table, axis);
        read_dynamics(file, table, axis);
        return true;
    }
    return false;
}

void read_axes(const TomlFile& file, const TomlValue& axes, Setup& setup) {
    for (const auto& [name, value] : file.table(axes).entries) {
        value.used = true;
        if (read_auxiliary_axis(file, name, value, setup)) continue;
        kinematics::AxisGeometry* axis = find_axis(setup.machine.chain, name);
        if (!axis) file.fail(value, "axis " + name + " does not stand in the chain");
        const std::size_t k = index_of(axis->axis);
        read_axis(file, file.table(value), *axis, setup);
        setup.scale_encoder[k] = read_scale_encoder(file, value);
        setup.encoder_zero[k] = read_encoder_zero(file, value, axis->rotary);
        setup.time_constant_s[k] = read_time_constant(file, value);
    }
}

/// X, Y and Z must span space: none is parallel to another or in the plane of the other two.
void check_linear_axes(const TomlFile& file, const TomlValue& axes,
                       const kinematics::Chain& chain) {
    constexpr double least_sine = 0.01;
    Matrix3 span = Matrix3::Zero();
    Eigen::Index rank = 0;
    for (const Axis axis : {Axis::X, Axis::Y, Axis::Z}) {
        const kinematics::AxisGeometry* geometry = chain.find(axis);
        if (!geometry || geometry->rotary) continue;
        Vector3 apart = geometry->direction;
        for (Eigen::Index k = 0; k < rank; ++k) apart -= apart.dot(span.col(k)) * span.col(k);
        const TomlValue* table = axes.find(geometry->name);
        if (apart.norm() < least_sine)
            file.fail(table ? *table : axes,
                      fmt::format("axis {} moves only where the linear axes before it do: "
                                  "directions of X, Y and Z in one plane",
                                  geometry->name));
        span.col(rank++) = apart.normalized();
    }
}

/// Only a linear axis with a letter of ISO 841 may omit its table.
void check_axes(const TomlFile& file, const TomlValue& chain_text, const TomlValue* axes,
                const kinematics::Chain& chain) {
    for (const kinematics::AxisGeometry& axis : chain.axes()) {
        if ((is_letter(axis) && !axis.rotary) || (axes && axes->find(axis.name))) continue;
        const std::string lacks = axis.rotary ? "rotary axis " + axis.name + " has no point_mm"
                                              : "axis " + axis.name + " has no direction";
        file.fail(chain_text, lacks + ": [machine.axis." + axis.name + "] is missing");
    }
}

std::vector<double> table_positions(const TomlFile& file, const TomlValue& table, bool rotary) {
    if (!rotary) {
        const TomlValue* at = table.find("at_mm");
        return at ? file.numbers(*at) : std::vector<double>{};
    }
    if (const TomlValue* at = table.find("at_rad")) return file.numbers(*at);
    std::vector<double> list;
    if (const TomlValue* at = table.find("at_deg"))
        for (const double deg : file.numbers(*at)) list.push_back(rad_from_deg(deg));
    return list;
}

void read_table(const TomlFile& file, const TomlValue& table, bool rotary,
                kinematics::ErrorCurve& curve) {
    curve.at = table_positions(file, table, rotary);
    if (const TomlValue* value = table.find("value")) curve.value = file.numbers(*value);
    if (curve.at.size() != curve.value.size() || curve.at.size() == 1)
        file.fail(table, "at and value are lists of the same length, two points or more");
    for (std::size_t i = 1; i < curve.at.size(); ++i)
        if (curve.at[i] <= curve.at[i - 1]) file.fail(table, "positions of a table rise");
    if (const TomlValue* kind = table.find("interpolation")) {
        const auto named = kinematics::parse_interpolation(file.text(*kind));
        if (!named) file.fail(*kind, "interpolation is \"linear\", \"cubic\" or \"none\"");
        curve.interpolation = *named;
    }
}

void read_harmonics(const TomlFile& file, const TomlValue& table, bool rotary,
                    kinematics::ErrorCurve& curve) {
    if (const TomlValue* period = table.find("period_mm")) curve.period_mm = file.positive(*period);
    const TomlValue* list = table.find("harmonics");
    if (!list) return;
    if (!rotary && curve.period_mm == 0.0)
        file.fail(*list, "harmonics of a linear axis need period_mm");
    for (const TomlValue& item : list->items) {
        const Vector3 h = file.vector3(item);
        curve.harmonics.push_back({h[0], h[1], h[2]});
    }
}

kinematics::ErrorCurve read_curve(const TomlFile& file, const TomlValue& value, bool rotary) {
    kinematics::ErrorCurve curve;
    if (value.kind == TomlValue::Kind::number) {
        curve.constant = file.number(value);
        return curve;
    }
    file.table(value);
    curve.constant = file.find_number(value, "constant").value_or(0.0);
    curve.slope = file.find_number(value, "slope").value_or(0.0);
    read_table(file, value, rotary, curve);
    read_harmonics(file, value, rotary, curve);
    return curve;
}

}  // namespace

void add_effect_key(const TomlFile& file, const TomlValue& place, const EffectKey& key,
                    Setup& setup) {
    const TomlValue* effects = file.root().find("effects");
    if (effects && effects->find(key.effect))
        file.fail(place, "this is " + key.effect + ", which [effects] gives too: say it once");
    if (key.value != 0.0) setup.effects.push_back({key.effect, {{key.parameter, {key.value}}}});
}

void read_machine(const TomlFile& file, const TomlValue& machine, Setup& setup) {
    if (const TomlValue* name = machine.find("name")) setup.name = file.text(*name);
    const TomlValue* chain = machine.find("chain");
    if (!chain) file.fail(machine, "[machine] has no chain, e.g. chain = \"w C B b X Y Z t\"");
    try {
        setup.chain_text = file.text(*chain);
        setup.machine.chain = kinematics::parse_chain(setup.chain_text);
    } catch (const InputError& error) {
        file.fail(*chain, error.message);
    }
    if (const TomlValue* names = machine.find("auxiliary")) read_auxiliary(file, *names, setup);
    const TomlValue* axes = machine.find("axis");
    check_axes(file, *chain, axes, setup.machine.chain);
    if (axes) {
        read_axes(file, *axes, setup);
        check_linear_axes(file, *axes, setup.machine.chain);
    }
    if (const TomlValue* sides = machine.find("side")) read_sides(file, *sides, setup);
    if (const TomlValue* errors = machine.find("errors"))
        read_machine_errors(file, file.table(*errors), setup);
}

namespace {

/// Checks the unit of a name: "_mm" or "_rad".
void check_unit(const TomlFile& file, const TomlValue& value, const std::string& key,
                const std::string& name, bool angular) {
    if (key.substr(name.size()) != (angular ? "_rad" : "_mm"))
        file.fail(value, "the unit of " + name + " is " + (angular ? "_rad" : "_mm"));
}

void read_spindle_error(const TomlFile& file, const TomlValue& value,
                        const kinematics::SpindleErrorName& name, kinematics::AxisErrors& spindle) {
    if (name.location) {
        spindle.location[name.direction] = file.number(value);
        return;
    }
    kinematics::ErrorCurve& curve = spindle.motion[name.direction] = read_curve(file, value, true);
    if (curve.slope != 0.0 || !curve.at.empty())
        file.fail(value, "an error motion of the spindle is a constant and harmonics of its angle");
}

}  // namespace

void read_machine_errors(const TomlFile& file, const TomlValue& table, Setup& setup) {
    kinematics::GeometricErrors& errors = setup.machine.errors;
    const AxisNames names = setup.machine.chain.names();
    for (const auto& [key, value] : table.entries) {
        value.used = true;
        const std::string_view word = std::string_view(key).substr(0, key.find('_'));
        if (const auto spindle = kinematics::parse_spindle_error_name(word)) {
            check_unit(file, value, key, to_string(*spindle), spindle->angular());
            read_spindle_error(file, value, *spindle, errors.spindle);
            continue;
        }
        const auto name = kinematics::parse_error_name(word, names);
        if (!name && kinematics::parse_error_name(word))
            file.fail(value, "the machine has no axis " + std::string(1, word.back()));
        if (!name)
            file.fail(
                value,
                "'" + key + "' is not an error of ISO 230 of an axis of the chain, e.g. EX0C_mm");
        check_unit(file, value, key, to_string(*name, names), name->angular());
        if (name->location)
            errors.location(*name) = file.number(value);
        else
            errors.motion(*name) = read_curve(file, value, names.is_rotary(name->axis));
    }
}

}  // namespace trunnion::setup
