#include <pybind11/stl.h>

#include "effects/settings.h"
#include "inputs/open_setup.h"
#include "inputs/shipped.h"
#include "python/bindings.h"
#include "python/loaded_setup.h"

namespace trunnion::python {
namespace py = pybind11;
namespace {

LoadedSetup load(const std::string& path) {
    LoadedSetup out;
    out.setup = inputs::open_setup(path, out.notes);
    return out;
}

LoadedSetup parse(const std::string& text, const std::string& path) {
    LoadedSetup out;
    out.setup = setup::parse_setup(text, path, out.notes);
    return out;
}

/// Checks the effect at once: a wrong name or parameter is an error here.
LoadedSetup switched_on(const LoadedSetup& before, const std::string& name,
                        const std::map<std::string, std::vector<double>>& parameters) {
    LoadedSetup out = before;
    const effects::Catalogue catalogue = effects::make_catalogue(out.setup);
    const effects::Effect* effect = effects::find_effect(catalogue, name);
    if (!effect) effects::refuse_effect_name(out.setup, name);
    const setup::EffectSetting setting{name, parameters};
    effects::values_of(*effect, setting);
    out.setup.effects.push_back(setting);
    return out;
}

/// "C.backlash=60urad"
LoadedSetup injected(const LoadedSetup& before, const std::string& text) {
    LoadedSetup out = before;
    out.setup.effects.push_back(effects::parse_injection(text, effects::make_catalogue(out.setup)));
    return out;
}

py::list effects_of(const LoadedSetup& loaded) {
    py::list list;
    for (const setup::EffectSetting& e : loaded.setup.effects)
        list.append(py::make_tuple(e.name, e.parameters));
    return list;
}

std::vector<std::string> axes_of(const LoadedSetup& loaded) {
    std::vector<std::string> names;
    for (const kinematics::AxisGeometry& axis : loaded.setup.machine.chain.axes())
        names.push_back(axis.name);
    return names;
}

}  // namespace

void add_setups(py::module_& m) {
    py::class_<LoadedSetup>(m, "Setup")
        .def_property_readonly("name", [](const LoadedSetup& s) { return s.setup.name; })
        .def_property_readonly("path", [](const LoadedSetup& s) { return s.setup.path; })
        .def_property_readonly("chain", [](const LoadedSetup& s) { return s.setup.chain_text; })
        .def_property_readonly("axes", &axes_of)
        .def_property_readonly("effects", &effects_of)
        .def_readonly("notes", &LoadedSetup::notes)
        .def("toml", [](const LoadedSetup& s) { return setup::format_setup(s.setup); });
    m.def("load_setup", &load, WithoutLock());
    m.def("parse_setup", &parse, WithoutLock());
    m.def("switched_on", &switched_on, WithoutLock());
    m.def("injected", &injected, WithoutLock());
    m.def("shipped", &inputs::shipped);
}

}  // namespace trunnion::python
