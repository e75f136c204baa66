#include <pybind11/stl.h>

#include <algorithm>
#include <filesystem>
#include <thread>

#include "base/units.h"
#include "inputs/open_setup.h"
#include "interpreter/program_folders.h"
#include "python/bindings.h"
#include "regression/suite.h"
#include "report/comparison_report.h"

namespace trunnion::python {
namespace py = pybind11;
namespace {

using regression::CompareReport;

setup::Setup load(const std::string& path) {
    std::vector<std::string> notes;
    return inputs::open_setup(path, notes);
}

void choose_layer(regression::SuiteCase& like, const std::string& name) {
    const auto& names = regression::layer_names;
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end())
        throw InputError("by = '" + name +
                         "': one of text, words, blocks, path, functions, axes, effects");
    like.options.by = static_cast<regression::Layer>(found - names.begin());
}

CompareReport compare(const std::string& a, const std::string& b,
                      const regression::SuiteCase& like) {
    if (std::filesystem::is_directory(a) || std::filesystem::is_directory(b))
        return regression::run_suite(regression::suite_of_folders(a, b, like), {}, load,
                                     std::max(1U, std::thread::hardware_concurrency()))
            .report;
    const interpreter::ProgramText older = interpreter::read_main_program(a),
                                   newer = interpreter::read_main_program(b);
    const setup::Setup setup = load(like.setup);
    CompareReport report;
    if (like.setup_b == like.setup)
        report.cases.push_back(
            regression::compare_programs(older, setup, newer, setup, like.options));
    else
        report.cases.push_back(
            regression::compare_programs(older, setup, newer, load(like.setup_b), like.options));
    return report;
}

}  // namespace

void add_comparisons(py::module_& m) {
    py::class_<regression::SuiteCase>(m, "CompareRequest")
        .def(py::init([] {
            regression::SuiteCase like;
            like.options.max_blocks = 100'000'000;  // limit for an endless loop
            return like;
        }))
        .def_readwrite("setup", &regression::SuiteCase::setup)
        .def_readwrite("setup_b", &regression::SuiteCase::setup_b)
        .def("programs",
             [](regression::SuiteCase& c, std::vector<std::string> f) {
                 c.options.program_folders = std::move(f);
             })
        .def("devices", [](regression::SuiteCase& c, bool on) { c.options.devices = on; })
        .def("tol_lin_mm",
             [](regression::SuiteCase& c, double mm) { c.options.tolerances.position_mm = mm; })
        .def("tol_ang_deg",
             [](regression::SuiteCase& c, double deg) {
                 c.options.tolerances.direction_rad = rad_from_deg(deg);
             })
        .def("by", &choose_layer);
    py::class_<CompareReport>(m, "CompareReport")
        .def_property_readonly("equal",
                               [](const CompareReport& r) { return regression::exit_code(r) == 0; })
        .def("json", &report::comparison_json)
        .def("text", &report::comparison_text)
        .def("markdown", &report::comparison_markdown);
    m.def("compare", &compare, WithoutLock());
}

}  // namespace trunnion::python
