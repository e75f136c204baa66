// A setup as TOML text that reads back to the same value.
#include <cmath>

#include "base/numbers.h"
#include "base/units.h"
#include "offsets/parameter_units.h"
#include "setup/artefact_keys.h"
#include "setup/body_keys.h"
#include "setup/hurco_keys.h"
#include "setup/session_keys.h"
#include "setup/setup.h"
#include "setup/toml_text.h"
#include "setup/tool_keys.h"

namespace trunnion::setup {
namespace {

/// Text of a number that `to_inside` converts back to exactly `value`: the shortest of the
/// neighbours.
template <class ToInside>
std::string text_for(double value, double guess, const ToInside& to_inside) {
    std::string best;
    double below = guess, above = guess;
    for (int ulp = 0; ulp < 4; ++ulp) {
        for (const double candidate : {below, above})
            if (to_inside(candidate) == value)
                if (const std::string text = shortest(candidate);
                    best.empty() || text.size() < best.size())
                    best = text;
        below = std::nextafter(below, -INFINITY);
        above = std::nextafter(above, INFINITY);
    }
    return best.empty() ? shortest(guess) : best;
}

std::string position(bool rotary, double value) {
    return rotary ? shortest_degrees(value) : shortest(value);
}

std::string speed(bool rotary, double value) {
    const auto inside = [=](double v) { return (rotary ? rad_from_deg(v) : v) / 60.0; };
    return text_for(value, 60.0 * (rotary ? deg_from_rad(value) : value), inside);
}

std::string curve_text(const kinematics::ErrorCurve& curve, bool rotary) {
    std::string out;
    const auto add = [&](const std::string& key, const std::string& value) {
        out += (out.empty() ? "" : ", ") + key + " = " + value;
    };
    if (curve.constant != 0.0) add("constant", shortest(curve.constant));
    if (curve.slope != 0.0) add("slope", shortest(curve.slope));
    if (!curve.at.empty()) {
        add(rotary ? "at_rad" : "at_mm", toml_numbers(curve.at));
        add("value", toml_numbers(curve.value));
        add("interpolation", toml_quoted(std::string(to_string(curve.interpolation))));
    }
    if (curve.period_mm != 0.0) add("period_mm", shortest(curve.period_mm));
    if (!curve.harmonics.empty())
        add("harmonics", toml_list(curve.harmonics, [](const kinematics::ErrorCurve::Harmonic& h) {
                return toml_numbers(std::array{h.order, h.cosine, h.sine});
            }));
    return "{ " + out + " }";
}

std::string travel_text(const kinematics::AxisGeometry& axis) {
    std::string out;
    if (axis.min && axis.max)
        out += std::string(axis.rotary ? "limits_deg" : "limits_mm") + " = [" +
               position(axis.rotary, *axis.min) + ", " + position(axis.rotary, *axis.max) + "]\n";
    if (axis.max_speed)
        out += std::string(axis.rotary ? "max_deg_min" : "max_mm_min") + " = " +
               speed(axis.rotary, *axis.max_speed) + '\n';
    if (axis.max_acceleration)
        out += std::string(axis.rotary ? "accel_deg_s2" : "accel_mm_s2") + " = " +
               position(axis.rotary, *axis.max_acceleration) + '\n';
    return out;
}

std::string axis_text(const kinematics::AxisGeometry& axis) {
    return "\n[machine.axis." + axis.name + "]\ndirection = " + toml_numbers(axis.direction) +
           '\n' + (axis.rotary ? "point_mm = " + toml_numbers(axis.point_mm) + '\n' : "") +
           travel_text(axis);
}

std::string auxiliary_text(const std::vector<kinematics::AxisGeometry>& axes) {
    const auto quoted = [](const kinematics::AxisGeometry& axis) { return toml_quoted(axis.name); };
    return axes.empty() ? "" : "auxiliary = " + toml_list(axes, quoted) + '\n';
}

std::string axis_error_text(const kinematics::AxisGeometry& axis,
                            const kinematics::AxisErrors& errors) {
    std::string out;
    for (std::size_t k = 0; k < 6; ++k) {
        const std::string unit = k < 3 ? "_mm = " : "_rad = ", error{'E', "XYZABC"[k]};
        if (errors.location[k] != 0.0)
            out += error + '0' + axis.name + unit + shortest(errors.location[k]) + '\n';
        if (!errors.motion[k].is_zero())
            out += error + axis.name + unit + curve_text(errors.motion[k], axis.rotary) + '\n';
    }
    return out;
}

std::string spindle_error_text(const kinematics::AxisErrors& errors) {
    std::string out;
    for (std::size_t k = 0; k < 5; ++k) {
        const std::string unit = k < 3 ? "_mm = " : "_rad = ";
        if (errors.location[k] != 0.0)
            out += to_string(kinematics::SpindleErrorName{k, true}) + unit +
                   shortest(errors.location[k]) + '\n';
        if (!errors.motion[k].is_zero())
            out += to_string(kinematics::SpindleErrorName{k, false}) + unit +
                   curve_text(errors.motion[k], true) + '\n';
    }
    return out;
}

/// The axes that arrived from the minus side; plus is the default of a file without the key.
std::string sides_text(const Setup& setup) {
    std::string out;
    for (const kinematics::AxisGeometry& axis : setup.machine.chain.axes())
        if (setup.side_before[index_of(axis.axis)] < 0)
            out += (out.empty() ? "" : ", ") + axis.name + " = \"-\"";
    return out.empty() ? out : "side = { " + out + " }\n";
}

std::string machine_text(const Setup& setup) {
    std::string out =
        "schema = \"trunnion.setup/1\"\n\n[machine]\nname = " + toml_quoted(setup.name) +
        "\nchain = " + toml_quoted(setup.chain_text) + '\n' + auxiliary_text(setup.auxiliary) +
        sides_text(setup);
    std::string errors;
    for (const kinematics::AxisGeometry& axis : setup.machine.chain.axes()) {
        const kinematics::AxisErrors& own = setup.machine.errors.axis[index_of(axis.axis)];
        out += axis_text(axis);
        if (setup.scale_encoder[index_of(axis.axis)]) out += "encoder = \"scale\"\n";
        if (const double zero = setup.encoder_zero[index_of(axis.axis)]; zero != 0.0)
            out += (axis.rotary ? "encoder_zero_rad = " : "encoder_zero_mm = ") + shortest(zero) +
                   '\n';
        if (const double seconds = setup.time_constant_s[index_of(axis.axis)]; seconds != 0.0)
            out += "time_constant_s = " + shortest(seconds) + '\n';
        if (const kinematics::ErrorCurve& gap = setup.gap[index_of(axis.axis)]; !gap.is_zero())
            out += (axis.rotary ? "backlash_rad = " : "backlash_mm = ") +
                   curve_text(gap, axis.rotary) + '\n';
        errors += axis_error_text(axis, own);
    }
    for (const kinematics::AxisGeometry& axis : setup.auxiliary)
        if (const std::string travel = travel_text(axis); !travel.empty())
            out += "\n[machine.axis." + axis.name + "]\n" + travel;
    errors += spindle_error_text(setup.machine.errors.spindle);
    return errors.empty() ? out : out + "\n[machine.errors]\n" + errors;
}

std::string offset_text(const offsets::OffsetVector& offset, const std::string& more = "") {
    std::string out;
    for (const Axis axis : all_axes)
        if (offset[axis] != 0.0)
            out += (out.empty() ? "" : ", ") + std::string(1, letter_of(axis)) + " = " +
                   shortest(offset[axis]);
    if (!more.empty()) out += (out.empty() ? "" : ", ") + more;
    return out.empty() ? "{}" : "{ " + out + " }";
}

std::string work_text(const offsets::WorkOffsets& work) {
    std::string out;
    const auto add = [&](const std::string& key, const offsets::OffsetVector& offset) {
        if (offset != offsets::OffsetVector{}) out += key + " = " + offset_text(offset) + '\n';
    };
    add("external", work.external);
    add("G52", work.local);
    add("G92", work.preset);
    for (std::size_t i = 0; i < work.standard.size(); ++i)
        add("G5" + std::to_string(4 + i), work.standard[i]);
    for (std::size_t i = 0; i < work.additional.size(); ++i)
        add("\"G54.1 P" + std::to_string(i + 1) + '"', work.additional[i]);
    return out.empty() ? out : "\n[control.work_offsets]\n" + out;
}

std::string fixture_text(const offsets::FixtureOffsets& fixture) {
    std::string out;
    for (std::size_t i = 0; i < fixture.set.size(); ++i) {
        const offsets::FixtureOffset& set = fixture.set[i];
        if (set.offset == offsets::OffsetVector{} &&
            set.reference_angles == offsets::OffsetVector{})
            continue;
        out += 'P' + std::to_string(i + 1) + " = " +
               offset_text(set.offset, "reference = " + offset_text(set.reference_angles)) + '\n';
    }
    return out.empty() ? out : "\n[control.fixture_offsets]\n" + out;
}

std::string tools_text(const offsets::ToolOffsets& tools) {
    std::string out;
    for (std::size_t i = 1; i < tools.tool.size(); ++i) {
        const offsets::ToolOffset& tool = tools.tool[i];
        std::string line;
        const auto add = [&](const char* key, double value, bool given = false) {
            if (value != 0.0 || given)
                line += (line.empty() ? "" : ", ") + std::string(key) + " = " + shortest(value);
        };
        add("length_mm", tool.length_geometry_mm, tool.length_given && tool.length_mm() == 0.0);
        add("length_wear_mm", tool.length_wear_mm);
        add("diameter_mm", 2.0 * tool.radius_geometry_mm,
            tool.radius_given && tool.radius_mm() == 0.0);
        add("diameter_wear_mm", 2.0 * tool.radius_wear_mm);
        if (!line.empty()) out += std::to_string(i) + " = { " + line + " }\n";
    }
    return out.empty() ? out : "\n[control.tools]\n" + out;
}

/// `unit_mm`: unit of the number as typed.
std::string parameter_text(const offsets::Parameter& parameter, double unit_mm) {
    if (parameter.by_axis.empty()) return shortest(parameter.value / unit_mm);
    std::string out;
    for (const auto& [axis, value] : parameter.by_axis)
        out += (out.empty() ? "" : ", ") + std::to_string(axis) + " = " + shortest(value);
    return "{ " + out + " }";
}

std::string numbered_text(const char* title, const std::map<int, double>& store) {
    std::string out;
    for (const auto& [number, value] : store)
        if (std::isfinite(value)) out += std::to_string(number) + " = " + shortest(value) + '\n';
    return out.empty() ? out : std::string("\n[control.") + title + "]\n" + out;
}

std::string clamps_text(const std::vector<controller::ClampCode>& clamps) {
    std::string out = clamps.empty() ? "" : "\n[control.clamps]\n";
    for (const controller::ClampCode& c : clamps)
        out += std::string(1, letter_of(c.axis)) + " = { clamp = " + std::to_string(c.m_clamp) +
               ", release = " + std::to_string(c.m_release) +
               ", alarm = " + (c.alarm ? "true" : "false") + " }\n";
    return out;
}

std::string list_text(const char* key, const std::vector<int>& numbers) {
    std::string out;
    for (const int n : numbers) out += (out.empty() ? "" : ", ") + std::to_string(n);
    return out.empty() ? out : std::string(key) + " = [" + out + "]\n";
}

std::string builder_text(const controller::BuilderProfile& builder) {
    std::string codes, ranges;
    for (const controller::GCode& code : builder.g_codes)
        codes += (codes.empty() ? "" : ", ") + shortest(code.code10 / 10.0);
    for (const auto& [first, last] : builder.variables)
        ranges += (ranges.empty() ? "[" : ", [") + std::to_string(first) + ", " +
                  std::to_string(last) + "]";
    std::string out;
    if (!codes.empty()) out += "g_codes = [" + codes + "]\n";
    out += list_text("m_codes", builder.m_codes);
    out += list_text("m_codes_after", builder.m_codes_after);
    if (!ranges.empty()) out += "variables = [" + ranges + "]\n";
    return out.empty() ? out : "\n[control.builder]\n" + out;
}

std::string generation_text(interpreter::ControlGeneration generation) {
    if (generation == interpreter::ControlGeneration::fanuc_16i) return "generation = \"16i\"\n";
    return generation == interpreter::ControlGeneration::fanuc_0i_f ? "generation = \"0i-F\"\n"
                                                                    : "";
}

std::string rounding_text(controller::VariableRounding rounding) {
    for (const controller::VariableRoundingName& row : controller::variable_roundings)
        if (row.rounding == rounding && rounding != controller::VariableRounding::none)
            return std::string("variable_rounding = \"") + row.name + "\"\n";
    return "";
}

std::string control_text(const Setup& setup) {
    std::string out =
        std::string("\n[control]\ndialect = ") +
        (setup.dialect.family == interpreter::DialectFamily::hurco ? "\"hurco\"\n" : "\"fanuc\"\n");
    out += generation_text(setup.dialect.generation);
    if (!setup.work_positions_with_length) out += "work_positions_with_length = false\n";
    if (setup.work_offset_is_group_12) out += "work_offset_is_group_12 = true\n";
    if (!setup.g89_feeds_to_initial) out += "g89_feeds_to_initial = false\n";
    if (setup.g53_under_g91_moves) out += "g53_under_g91_moves = true\n";
    if (setup.rapids_are_doglegs) out += "rapids_are_doglegs = true\n";
    out += rounding_text(setup.variable_rounding);
    if (setup.optional_stop) out += "optional_stop = true\n";
    if (setup.threading) out += "threading = true\n";
    if (!setup.block_skip.empty()) {
        out += "block_skip = [";
        for (const int n : setup.block_skip) out += std::to_string(n) + ", ";
        out.replace(out.size() - 2, 2, "]\n");
    }
    out +=
        "# frame of X Y Z under G43.4: \"start\", as the table stands when it starts (the "
        "manual's),\n# or \"rotary_zero\", with all rotary axes at zero\n";
    out += setup.tcp_frame == positioning::TcpFrame::rotary_zero ? "tcp_frame = \"rotary_zero\"\n"
                                                                 : "tcp_frame = \"start\"\n";
    out += clamps_text(setup.clamps) + builder_text(setup.builder) + hurco_text(setup);
    out += work_text(setup.stores.work) + fixture_text(setup.stores.fixture);
    if (!setup.stores.parameters.entry.empty()) out += "\n[control.parameters]\n";
    for (const auto& [number, parameter] : setup.stores.parameters.entry)
        out +=
            std::to_string(number) + " = " +
            parameter_text(parameter, offsets::parameter_unit_mm(setup.stores.parameters, number)) +
            '\n';
    out += tools_text(setup.stores.tools);
    out += numbered_text("variables", setup.stores.variables);
    return out + numbered_text("signals", setup.stores.signals);
}

std::string extensions_text(const ExtensionErrors& errors) {
    std::vector<double> flat;
    for (const auto& [length_mm, shift] : errors)
        for (const double v : {length_mm, shift.x(), shift.y(), shift.z()}) flat.push_back(v);
    return flat.empty() ? "" : "extension_errors_mm = " + toml_numbers(flat) + '\n';
}

std::string probe_text(const ProbeSettings& probe) {
    std::string out = "\n[probe]\n";
    if (probe.tool != 0) out += "tool = " + std::to_string(probe.tool) + '\n';
    return out + "tip_mm = " + toml_numbers(probe.tip_S_mm) +
           "\nball_diameter_mm = " + shortest(probe.ball_diameter_mm) +
           "\nrepeatability_um = " + shortest(probe.repeatability_um) + '\n' +
           extensions_text(probe.extension_errors);
}

std::string texts(const std::vector<std::string>& list) {
    return toml_list(list, toml_quoted);
}

std::string ballbar_text(const BallbarSettings& bar) {
    std::vector<std::string> free;
    if (bar.free_cup) free.push_back("cup");
    if (bar.free_length) free.push_back("length");
    return "\n[ballbar]\ncup_mm = " + toml_numbers(bar.cup_S_mm) +
           "\nlength_mm = " + shortest(bar.length_mm) +
           "\nexpansion_per_k = " + shortest(bar.expansion_per_k) +
           "\ntemperature_c = " + shortest(bar.temperature_c) +
           "\nread_temperature_c = " + shortest(bar.read_temperature_c) +
           "\nnoise_um = " + shortest(bar.noise_um) + "\nsample_hz = " + shortest(bar.sample_hz) +
           (bar.sample_deg > 0.0 ? "\nsample_deg = " + shortest(bar.sample_deg) : "") +
           "\nfree = " + texts(free) + '\n' + extensions_text(bar.extension_errors);
}

std::string noise_text(const char* key, const std::map<std::string, double>& noise) {
    std::string out;
    for (const auto& [device, sigma] : noise)
        out += (out.empty() ? "" : ", ") + device + " = " + shortest(sigma);
    return out.empty() ? out : std::string(key) + " = { " + out + " }\n";
}

std::string model_text(const ModelSettings& model, const AxisNames& names) {
    std::string out = "\n[model]\nmodelled = " + texts(model.modelled) + '\n' +
                      noise_text("noise_um", model.noise_um) +
                      noise_text("noise_urad", model.noise_urad);
    if (!model.calibration.empty()) out += "\n[model.calibration]\n";
    for (const auto& [name, prior] : model.calibration) {
        const auto error = kinematics::parse_error_name(name, names);
        const std::string unit = error && error->angular() ? "_rad = " : "_mm = ";
        out += name + " = { value" + unit + shortest(prior.value) + ", sigma" + unit +
               shortest(prior.sigma) + " }\n";
    }
    return out;
}

std::string effects_text(const std::vector<EffectSetting>& effects) {
    std::string out;
    for (const EffectSetting& effect : effects) {
        std::string inner;
        for (const auto& [name, values] : effect.parameters)
            inner += (inner.empty() ? "" : ", ") + name + " = " +
                     (values.size() == 1 ? shortest(values[0]) : toml_numbers(values));
        out += toml_quoted(effect.name) + " = { " + inner + " }\n";
    }
    return out.empty() ? out : "\n[effects]\n" + out;
}

}  // namespace

std::string format_setup(const Setup& setup) {
    std::string out = machine_text(setup) + effects_text(setup.effects) + control_text(setup);
    if (setup.probe) out += probe_text(*setup.probe);
    if (setup.ballbar) out += ballbar_text(*setup.ballbar);
    for (const Artefact& artefact : setup.artefacts) out += artefact_text(artefact);
    for (const Body& body : setup.bodies) out += body_text(body);
    out += physical_tools_text(setup.tools);
    for (const Instrument& instrument : setup.instruments) out += instrument_text(instrument);
    for (const SessionValues& session : setup.sessions) out += session_text(session);
    return out + model_text(setup.model, setup.machine.chain.names());
}

}  // namespace trunnion::setup
