#include "setup/artefact_keys.h"

#include <array>

#include "setup/toml_text.h"

namespace trunnion::setup {
namespace {

constexpr std::array<const char*, 3> kind_names{"sphere", "center_pivot", "target"};

Artefact::Kind read_kind(const TomlFile& file, const TomlValue& value) {
    for (std::size_t k = 0; k < kind_names.size(); ++k)
        if (file.text(value) == kind_names[k]) return static_cast<Artefact::Kind>(k);
    file.fail(value, "kind is \"sphere\", \"center_pivot\" or \"target\"");
}

/// Reads center_mm or, for a target, tool_mm: exactly one of the two.
void read_place(const TomlFile& file, const TomlValue& table, Artefact& artefact) {
    const TomlValue* center = table.find("center_mm");
    const TomlValue* tool = table.find("tool_mm");
    const bool target = artefact.kind == Artefact::Kind::target;
    if (tool && !target) file.fail(*tool, "tool_mm belongs to kind = \"target\"");
    if (tool && center) file.fail(*tool, "a target has tool_mm or center_mm, not both");
    if (!tool && !center)
        file.fail(table, "artefact " + artefact.name + " has no center_mm" +
                             (target ? " and no tool_mm" : ""));
    if (center) artefact.center_W_mm = file.vector3(*center);
    if (tool) artefact.tool_S_mm = file.vector3(*tool);
    if (!target) return;
    if (const TomlValue* found = table.find("shift_mm")) artefact.found_mm = file.vector3(*found);
}

Artefact read_artefact(const TomlFile& file, const TomlValue& table, const Setup& setup) {
    Artefact artefact;
    const TomlValue* name = file.table(table).find("name");
    if (!name) file.fail(table, "this [[artefact]] has no name");
    artefact.name = file.text(*name);
    if (setup.find_artefact(artefact.name)) file.fail(*name, "two artefacts have this name");
    if (const TomlValue* kind = table.find("kind")) artefact.kind = read_kind(file, *kind);
    read_place(file, table, artefact);
    if (const TomlValue* d = table.find("diameter_mm")) artefact.diameter_mm = file.positive(*d);
    if (const TomlValue* free = table.find("free")) {
        const auto names = read_free(file, *free, {artefact.tool_S_mm ? "tool" : "center"});
        artefact.free_center = names.contains("center");
        artefact.free_tool = names.contains("tool");
    }
    return artefact;
}

Instrument read_instrument(const TomlFile& file, const TomlValue& table, const Setup& setup) {
    Instrument instrument;
    const TomlValue* name = file.table(table).find("name");
    if (!name) file.fail(table, "this [[instrument]] has no name");
    instrument.name = file.text(*name);
    if (setup.find_instrument(instrument.name)) file.fail(*name, "two instruments have this name");
    if (const TomlValue* frame = table.find("frame")) {
        if (file.text(*frame) != "M" && file.text(*frame) != "W")
            file.fail(*frame, "frame is \"M\" (machine) or \"W\" (table)");
        instrument.sees_table = frame->text == "W";
    }
    if (const TomlValue* origin = table.find("origin_mm"))
        instrument.origin_mm = file.vector3(*origin);
    if (const TomlValue* turn = table.find("rotation_deg"))
        instrument.rotation_deg = file.vector3(*turn);
    if (const TomlValue* shift = table.find("shift_mm"))
        instrument.pose_error.shift_mm = file.vector3(*shift);
    if (const TomlValue* tilt = table.find("tilt_rad"))
        instrument.pose_error.tilt_rad = file.vector3(*tilt);
    instrument.scale_error = file.find_number(table, "scale").value_or(0.0);
    if (const TomlValue* free = table.find("free")) {
        const auto names = read_free(file, *free, {"pose", "scale"});
        instrument.free_pose = names.contains("pose");
        instrument.free_scale = names.contains("scale");
    }
    return instrument;
}

template <class Item>
void read_list(const TomlFile& file, const char* key, Setup& setup, std::vector<Item>& items,
               Item (*read)(const TomlFile&, const TomlValue&, const Setup&)) {
    const TomlValue* list = file.root().find(key);
    if (!list) return;
    if (list->kind != TomlValue::Kind::array)
        file.fail(*list, std::string("write [[") + key + "]], twice in brackets");
    for (const TomlValue& item : list->items) items.push_back(read(file, item, setup));
}

std::string free_text(const std::set<std::string>& names) {
    std::string out;
    for (const std::string& name : names) out += (out.empty() ? "" : ", ") + toml_quoted(name);
    return out.empty() ? out : "free = [" + out + "]\n";
}

}  // namespace

void read_artefacts(const TomlFile& file, Setup& setup) {
    read_list(file, "artefact", setup, setup.artefacts, read_artefact);
}

void read_instruments(const TomlFile& file, Setup& setup) {
    read_list(file, "instrument", setup, setup.instruments, read_instrument);
}

std::set<std::string> read_free(const TomlFile& file, const TomlValue& value,
                                const std::set<std::string>& allowed) {
    std::set<std::string> names;
    for (const std::string& name : file.texts(value)) {
        if (!allowed.contains(name)) file.fail(value, "'" + name + "' cannot be free here");
        names.insert(name);
    }
    return names;
}

std::string artefact_text(const Artefact& artefact) {
    const char* kind = kind_names[static_cast<std::size_t>(artefact.kind)];
    std::string out = "\n[[artefact]]\nname = " + toml_quoted(artefact.name) +
                      "\nkind = " + toml_quoted(kind) + '\n';
    out += artefact.tool_S_mm ? "tool_mm = " + toml_numbers(*artefact.tool_S_mm)
                              : "center_mm = " + toml_numbers(artefact.center_W_mm);
    if (artefact.kind != Artefact::Kind::target)
        out += "\ndiameter_mm = " + toml_number(artefact.diameter_mm);
    if (!artefact.found_mm.isZero(0.0)) out += "\nshift_mm = " + toml_numbers(artefact.found_mm);
    std::set<std::string> free;
    if (artefact.free_center) free.insert("center");
    if (artefact.free_tool) free.insert("tool");
    return out + '\n' + free_text(free);
}

std::string instrument_text(const Instrument& instrument) {
    std::set<std::string> free;
    std::string found;
    if (!instrument.pose_error.is_zero())
        found = "shift_mm = " + toml_numbers(instrument.pose_error.shift_mm) +
                "\ntilt_rad = " + toml_numbers(instrument.pose_error.tilt_rad) + '\n';
    if (instrument.scale_error != 0.0)
        found += "scale = " + toml_number(instrument.scale_error) + '\n';
    if (instrument.free_pose) free.insert("pose");
    if (instrument.free_scale) free.insert("scale");
    return "\n[[instrument]]\nname = " + toml_quoted(instrument.name) +
           (instrument.sees_table ? "\nframe = \"W\"" : "") +
           "\norigin_mm = " + toml_numbers(instrument.origin_mm) +
           "\nrotation_deg = " + toml_numbers(instrument.rotation_deg) + '\n' + found +
           free_text(free);
}

}  // namespace trunnion::setup
