// [probe], [ballbar], [[artefact]], [model] and [effects] of a setup file.
#include "setup/setup_reader.h"

namespace trunnion {
namespace {

/// Four numbers an entry: length of the extension, then the place of its ball beside that below.
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
    probe.pretravel_um = file.find_number(table, "pretravel_um").value_or(0.0);
    probe.extension_errors = read_extensions(file, table);
    setup.probe = probe;
}

bool lists(const std::vector<std::string>& list, const char* name) {
    for (const std::string& item : list)
        if (item == name) return true;
    return false;
}

void check_free(const TomlFile& file, const TomlValue& value, const std::vector<std::string>& list,
                const std::vector<std::string>& allowed) {
    for (const std::string& item : list)
        if (!lists(allowed, item.c_str())) file.fail(value, "'" + item + "' cannot be free here");
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
        const auto list = file.texts(*free);
        check_free(file, *free, list, {"cup", "length"});
        bar.free_cup = lists(list, "cup");
        bar.free_length = lists(list, "length");
    }
    bar.extension_errors = read_extensions(file, table);
    setup.ballbar = bar;
}

Artefact read_artefact(const TomlFile& file, const TomlValue& table, const Setup& setup) {
    Artefact artefact;
    const TomlValue* name = file.table(table).find("name");
    if (!name) file.fail(table, "this [[artefact]] has no name");
    artefact.name = file.text(*name);
    if (setup.find_artefact(artefact.name)) file.fail(*name, "two artefacts have this name");
    if (const TomlValue* kind = table.find("kind")) {
        if (file.text(*kind) != "sphere" && file.text(*kind) != "center_pivot")
            file.fail(*kind, "kind is \"sphere\" or \"center_pivot\"");
        artefact.kind =
            kind->text == "sphere" ? Artefact::Kind::sphere : Artefact::Kind::center_pivot;
    }
    const TomlValue* center = table.find("center_mm");
    if (!center) file.fail(table, "artefact " + artefact.name + " has no center_mm");
    artefact.center_W_mm = file.vector3(*center);
    if (const TomlValue* d = table.find("diameter_mm")) artefact.diameter_mm = file.positive(*d);
    if (const TomlValue* free = table.find("free")) {
        check_free(file, *free, file.texts(*free), {"center"});
        artefact.free_center = lists(file.texts(*free), "center");
    }
    return artefact;
}

CalibrationPrior read_prior(const TomlFile& file, const std::string& name, const TomlValue& table) {
    const auto error = parse_error_name(name);
    if (!error) file.fail(table, "'" + name + "' is not an error name of ISO 230, e.g. EX0C");
    const std::string unit = error->angular() ? "_rad" : "_mm";
    const TomlValue* sigma = file.table(table).find("sigma" + unit);
    if (!sigma) file.fail(table, name + " needs value" + unit + " and sigma" + unit);
    return {file.find_number(table, "value" + unit).value_or(0.0), file.positive(*sigma)};
}

void read_model(const TomlFile& file, const TomlValue& table, ModelSettings& model) {
    if (const TomlValue* modelled = file.table(table).find("modelled"))
        model.modelled = file.texts(*modelled);
    if (const TomlValue* noise = table.find("noise_um"))
        for (const auto& [device, value] : file.table(*noise).entries) {
            if (device != "sphere" && device != "touch" && device != "ballbar") continue;
            value.used = true;
            model.noise_um[device] = file.positive(value);
        }
    if (const TomlValue* calibration = table.find("calibration"))
        for (const auto& [name, value] : file.table(*calibration).entries) {
            value.used = true;
            model.calibration[name] = read_prior(file, name, value);
        }
}

void read_effects(const TomlFile& file, const TomlValue& table, Setup& setup) {
    for (const auto& [name, value] : file.table(table).entries) {
        value.used = true;
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
    if (const TomlValue* list = root.find("artefact")) {
        if (list->kind != TomlValue::Kind::array)
            file.fail(*list, "write [[artefact]], twice in brackets");
        for (const TomlValue& item : list->items)
            setup.artefacts.push_back(read_artefact(file, item, setup));
    }
    if (const TomlValue* table = root.find("model")) read_model(file, *table, setup.model);
    if (const TomlValue* table = root.find("effects")) read_effects(file, *table, setup);
}

}  // namespace trunnion
