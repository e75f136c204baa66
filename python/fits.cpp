#include <pybind11/stl.h>

#include "diagnosis/diagnosis.h"
#include "effects/settings.h"
#include "emulator/declared.h"
#include "emulator/replay.h"
#include "identification/identify.h"
#include "identification/sensitivity.h"
#include "identification/simulated.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/loaded_setup.h"
#include "python/signals.h"
#include "records/same_readings.h"
#include "report/diagnosis_json.h"
#include "report/identification_report.h"
#include "report/parameters_json.h"

namespace trunnion::python {
namespace py = pybind11;
namespace {

using identification::Identification;
using records::ReadingTable;

struct FoundIdentification {
    std::string json;
    Eigen::MatrixXd covariance;
    LoadedSetup setup;
};

struct FoundDiagnosis {
    std::string json;
    std::vector<double> before_um, after_um;
    LoadedSetup setup;
};

setup::Setup with_large(const LoadedSetup& loaded, bool allow_large) {
    setup::Setup setup = loaded.setup;
    setup.model.allow_large = allow_large;
    return setup;
}

/// Without a seed the noise-free predictions, with one the simulated readings.
ReadingTable predict(const LoadedSetup& loaded, const ReadingTable& table,
                     std::optional<std::uint64_t> seed) {
    if (seed) return identification::simulated(loaded.setup, table, *seed);
    return emulator::predicted(loaded.setup, table, effects::active_models(loaded.setup));
}

FoundIdentification identify(const LoadedSetup& loaded, const ReadingTable& table,
                             const std::vector<std::string>& effects, bool allow_large) {
    emulator::refuse_declared_otherwise(loaded.setup, table);
    Identification found =
        identification::identify(with_large(loaded, allow_large), table, effects);
    return {report::identification_json(found),
            found.covariance,
            {std::move(found.setup), std::move(found.notes)}};
}

FoundDiagnosis diagnose(const LoadedSetup& loaded, const ReadingTable& table,
                        const std::optional<ReadingTable>& holdout, bool allow_large) {
    emulator::refuse_declared_otherwise(loaded.setup, table);
    if (holdout) emulator::refuse_declared_otherwise(loaded.setup, *holdout);
    if (holdout) records::refuse_same_readings(table, *holdout);
    diagnosis::DiagnosisOptions how;
    how.holdout = holdout ? &*holdout : nullptr;
    how.watch = [](const char*) { stop_on_ctrl_c(); };
    diagnosis::Diagnosis found = diagnosis::diagnose(with_large(loaded, allow_large), table, how);
    std::string json = report::diagnosis_json(found);
    return {std::move(json),
            std::move(found.before_um),
            std::move(found.after_um),
            {std::move(found.setup), std::move(found.notes)}};
}

identification::Sensitivity sensitivity(const LoadedSetup& loaded, const ReadingTable& table,
                                        const std::vector<std::string>& effects) {
    return identification::sensitivity(loaded.setup, table, effects);
}

std::vector<std::string> names_of(const identification::Sensitivity& found) {
    std::vector<std::string> names;
    for (const identification::FitParameter& p : found.parameters)
        names.push_back(p.effect + '.' + report::with_component(p));
    return names;
}

std::vector<std::string> units_of(const identification::Sensitivity& found) {
    std::vector<std::string> units;
    for (const identification::FitParameter& p : found.parameters) units.push_back(p.unit);
    return units;
}

}  // namespace

void add_fits(py::module_& m) {
    py::class_<FoundIdentification>(m, "FoundIdentification")
        .def_readonly("json", &FoundIdentification::json)
        .def_property_readonly("covariance",
                               [](const FoundIdentification& f) { return array_of(f.covariance); })
        .def_readonly("setup", &FoundIdentification::setup);
    py::class_<FoundDiagnosis>(m, "FoundDiagnosis")
        .def_readonly("json", &FoundDiagnosis::json)
        .def_property_readonly("before_um",
                               [](const FoundDiagnosis& f) { return array_of(f.before_um); })
        .def_property_readonly("after_um",
                               [](const FoundDiagnosis& f) { return array_of(f.after_um); })
        .def_readonly("setup", &FoundDiagnosis::setup);
    py::class_<identification::Sensitivity>(m, "Sensitivity")
        .def_readonly("index", &identification::Sensitivity::index)
        .def_property_readonly("names", &names_of)
        .def_property_readonly("units", &units_of)
        .def_property_readonly(
            "jacobian", [](const identification::Sensitivity& s) { return array_of(s.jacobian); });
    m.def("predict", &predict, WithoutLock());
    m.def("sensitivity", &sensitivity, WithoutLock());
    m.def("identify", &identify, WithoutLock());
    m.def("diagnose", &diagnose, WithoutLock());
}

}  // namespace trunnion::python
