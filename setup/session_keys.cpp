#include "setup/session_keys.h"

#include <algorithm>

#include "base/numbers.h"
#include "setup/toml_text.h"

namespace trunnion::setup {
namespace {

/// "x_mm" .. "z_mm": 0 to 2, "a_rad" .. "c_rad": 3 to 5, "scale": 6; -1 for any other word.
int component_of(const std::string& word) {
    static constexpr const char* words[] = {"x_mm",  "y_mm",  "z_mm", "a_rad",
                                            "b_rad", "c_rad", "scale"};
    for (int k = 0; k < 7; ++k)
        if (word == words[k]) return k;
    return -1;
}

double* of_instrument(Instrument& instrument, int component) {
    if (component < 3) return &instrument.pose_error.shift_mm(component);
    if (component < 6) return &instrument.pose_error.tilt_rad(component - 3);
    return &instrument.scale_error;
}

/// "stylus+60", "cup-12.5": the ball of that extension.
double* of_extension(ExtensionErrors& errors, const std::string& length, int component) {
    const auto length_mm = parse_number(length.starts_with('+') ? length.substr(1) : length);
    if (!length_mm) return nullptr;
    return &errors.try_emplace(*length_mm, Vector3::Zero()).first->second(component);
}

double* of_device(Setup& setup, const std::string& owner, int component) {
    if (component > 2) return nullptr;
    if (owner == "cup" && setup.ballbar) return &setup.ballbar->cup_S_mm(component);
    if (owner.starts_with("cup") && setup.ballbar)
        return of_extension(setup.ballbar->extension_errors, owner.substr(3), component);
    if (owner.starts_with("stylus") && setup.probe)
        return of_extension(setup.probe->extension_errors, owner.substr(6), component);
    return nullptr;
}

}  // namespace

double* set_up_number(Setup& setup, const std::string& quantity) {
    if (quantity == "length_mm") return setup.ballbar ? &setup.ballbar->length_mm : nullptr;
    const std::size_t dot = quantity.rfind('.');
    const int component = dot == std::string::npos ? -1 : component_of(quantity.substr(dot + 1));
    if (component < 0) return nullptr;
    const std::string owner = quantity.substr(0, dot);
    for (Artefact& artefact : setup.artefacts)
        if (artefact.name == owner && component < 3)
            return &(artefact.kind == Artefact::Kind::target ? artefact.found_mm
                                                             : artefact.center_W_mm)(component);
    for (Instrument& instrument : setup.instruments)
        if (instrument.name == owner) return of_instrument(instrument, component);
    return of_device(setup, owner, component);
}

void read_sessions(const TomlFile& file, Setup& setup) {
    const TomlValue* list = file.root().find("session");
    if (!list) return;
    if (list->kind != TomlValue::Kind::array)
        file.fail(*list, "write [[session]], twice in brackets");
    for (const TomlValue& item : list->items) {
        const TomlValue* name = file.table(item).find("name");
        if (!name) file.fail(item, "this [[session]] has no name");
        SessionValues session{file.text(*name), {}};
        if (setup.find_session(session.name)) file.fail(*name, "two sessions have this name");
        for (const auto& [key, value] : item.entries) {
            if (key == "name") continue;
            value.used = true;
            Setup trial = setup;
            if (!set_up_number(trial, key))
                file.fail(value, "this setup has no place for '" + key + "'");
            session.values[key] = file.number(value);
        }
        setup.sessions.push_back(std::move(session));
    }
}

std::string session_text(const SessionValues& session) {
    std::string out = "\n[[session]]\nname = " + toml_quoted(session.name) + '\n';
    for (const auto& [quantity, value] : session.values)
        out += toml_quoted(quantity) + " = " + shortest(value) + '\n';
    return out;
}

const SessionValues* Setup::find_session(const std::string& wanted) const {
    const auto at = std::find_if(sessions.begin(), sessions.end(),
                                 [&](const SessionValues& s) { return s.name == wanted; });
    return at == sessions.end() ? nullptr : &*at;
}

Setup Setup::in_session(const std::string& wanted) const {
    Setup own = *this;
    if (const SessionValues* session = find_session(wanted))
        for (const auto& [quantity, value] : session->values)
            if (double* number = set_up_number(own, quantity)) *number = value;
    return own;
}

}  // namespace trunnion::setup
