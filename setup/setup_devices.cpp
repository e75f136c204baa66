// [probe], [ballbar], [model] and [effects] of a setup file.
#include "base/units.h"
#include "setup/artefact_keys.h"
#include "setup/body_keys.h"
#include "setup/session_keys.h"
#include "setup/setup_reader.h"
#include "setup/tool_keys.h"

namespace trunnion::setup {
namespace {

/// Four numbers an entry: length of the extension, then the position of its ball relative to that
/// below.
ExtensionErrors read_extensions(const TomlFile& file, const TomlValue& table) {
    ExtensionErrors errors;
    const TomlValue* list = table.find("extension_errors_mm");
    if (!list) return errors;
    const std::vector<double> v = file.numbers(*list);
    if (v.size() % 4 != 0)
        file.fail(*list, "extension_errors_mm holds four numbers an extension: length, x, y, z");
    for (std::size_t k = 0; k < v.size(); k += 4)
        errors[v[k]] = Vector3(v[k + 1], v[k + 2], v[k + 3]);
    return errors;
}

void read_probe(const TomlFile& file, const TomlValue& table, Setup& setup) {
    ProbeSettings probe;
    const double tool = file.find_number(file.table(table), "tool").value_or(0.0);
    if (tool < 0 || tool > 99999999 || tool != static_cast<int>(tool))
        file.fail(*table.find("tool"), "a tool number is expected here");
    probe.tool = static_cast<int>(tool);
    if (const TomlValue* tip = table.find("tip_mm")) probe.tip_S_mm = file.vector3(*tip);
    if (const TomlValue* ball = table.find("ball_diameter_mm"))
        probe.ball_diameter_mm = file.positive(*ball);
    probe.repeatability_um = file.find_number(table, "repeatability_um").value_or(0.0);
    if (const TomlValue* pretravel = table.find("pretravel_um"))
        add_effect_key(file, *pretravel,
                       {"probe.radius", "radius_mm", -mm_from_um(file.number(*pretravel))}, setup);
    probe.extension_errors = read_extensions(file, table);
    setup.probe = probe;
}

void read_ballbar(const TomlFile& file, const TomlValue& table, Setup& setup) {
    BallbarSettings bar;
    if (const TomlValue* cup = file.table(table).find("cup_mm")) bar.cup_S_mm = file.vector3(*cup);
    if (const TomlValue* length = table.find("length_mm")) bar.length_mm = file.positive(*length);
    if (const TomlValue* step = table.find("sample_deg")) bar.sample_deg = file.positive(*step);
    if (const TomlValue* rate = table.find("sample_hz")) bar.sample_hz = file.positive(*rate);
    bar.noise_um = file.find_number(table, "noise_um").value_or(0.0);
    bar.expansion_per_k = file.find_number(table, "expansion_per_k").value_or(0.0);
    bar.temperature_c = file.find_number(table, "temperature_c").value_or(20.0);
    bar.read_temperature_c = file.find_number(table, "read_temperature_c").value_or(20.0);
    if (const TomlValue* free = table.find("free")) {
        const auto names = read_free(file, *free, {"cup", "length"});
        bar.free_cup = names.contains("cup");
        bar.free_length = names.contains("length");
    }
    bar.extension_errors = read_extensions(file, table);
    setup.ballbar = bar;
}

CalibrationPrior read_prior(const TomlFile& file, const std::string& name, const TomlValue& table,
                            const AxisNames& names) {
    const auto error = kinematics::parse_error_name(name, names);
    if (!error)
        file.fail(table, "'" + name + "' is not an error name of ISO 230 of an axis, e.g. EX0C");
    const std::string unit = error->angular() ? "_rad" : "_mm";
    const TomlValue* sigma = file.table(table).find("sigma" + unit);
    if (!sigma) file.fail(table, name + " needs value" + unit + " and sigma" + unit);
    return {file.find_number(table, "value" + unit).value_or(0.0), file.positive(*sigma)};
}

/// One sigma of each device; other names are reported as unknown keys.
std::map<std::string, double> read_noise(const TomlFile& file, const TomlValue& table,
                                         const char* key, const std::set<std::string>& devices) {
    std::map<std::string, double> noise;
    const TomlValue* list = table.find(key);
    if (!list) return noise;
    for (const auto& [device, value] : file.table(*list).entries) {
        if (!devices.contains(device)) continue;
        value.used = true;
        noise[device] = file.positive(value);
    }
    return noise;
}

void read_model(const TomlFile& file, const TomlValue& table, const AxisNames& names,
                ModelSettings& model) {
    if (const TomlValue* modelled = file.table(table).find("modelled"))
        model.modelled = file.texts(*modelled);
    model.noise_um = read_noise(file, table, "noise_um",
                                {"sphere", "touch", "ballbar", "linear", "point", "axis", "zero"});
    model.noise_urad = read_noise(file, table, "noise_urad", {"angle", "axis"});
    if (const TomlValue* calibration = table.find("calibration"))
        for (const auto& [name, value] : file.table(*calibration).entries) {
            value.used = true;
            model.calibration[name] = read_prior(file, name, value, names);
        }
}

/// TOML reads X.backlash = {...} as a table X with a key backlash: no effect has tables in it.
void refuse_dotted_name(const TomlFile& file, const TomlEntry& entry) {
    if (entry.value.kind != TomlValue::Kind::table) return;
    for (const TomlEntry& inner : entry.value.entries)
        if (inner.value.kind == TomlValue::Kind::table)
            file.fail(inner.value, "the name of an effect stands in quotes: \"" + entry.key + "." +
                                       inner.key + "\" = { ... }");
}

void read_effects(const TomlFile& file, const TomlValue& table, Setup& setup) {
    for (const TomlEntry& entry : file.table(table).entries) {
        const auto& [name, value] = entry;
        value.used = true;
        refuse_dotted_name(file, entry);
        EffectSetting effect;
        effect.name = name;
        for (const auto& [parameter, number] : file.table(value).entries) {
            number.used = true;
            effect.parameters[parameter] = file.numbers(number);
        }
        setup.effects.push_back(std::move(effect));
    }
}

}  // namespace

void read_devices(const TomlFile& file, Setup& setup) {
    const TomlValue& root = file.root();
    if (const TomlValue* table = root.find("probe")) read_probe(file, *table, setup);
    if (const TomlValue* table = root.find("ballbar")) read_ballbar(file, *table, setup);
    read_artefacts(file, setup);
    read_bodies(file, setup);
    read_physical_tools(file, setup);
    read_instruments(file, setup);
    read_sessions(file, setup);
    if (const TomlValue* table = root.find("model"))
        read_model(file, *table, setup.machine.chain.names(), setup.model);
    if (const TomlValue* table = root.find("effects")) read_effects(file, *table, setup);
}

}  // namespace trunnion::setup
