#include <fmt/format.h>
#include <pybind11/stl.h>

#include "effects/settings.h"
#include "emulator/run.h"
#include "inputs/program_choice.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/loaded_setup.h"
#include "python/signals.h"
#include "report/run_report.h"
#include "setup/control_axes.h"

namespace trunnion::python {
namespace py = pybind11;
namespace {

/// A run requested by a script; the limits are those of the command line.
struct RunRequest {
    std::string program;              ///< path or O number; with `text` its name in messages
    std::optional<std::string> text;  ///< the program itself
    std::vector<std::string> folders, measure;
    std::uint64_t seed = 1, max_blocks = 100'000'000, max_print = 100'000'000,
                  max_readings = 10'000'000;
    double max_seconds = 0.0, trace_step_mm = 0.0, trace_chord_mm = 0.0;
    bool trace = false, truth = false, ballbar = false;
    std::map<int, double> variables;
    std::vector<int> wanted;
};

struct FinishedRun {
    std::string json, printed, alarm_text;
    records::ReadingTable readings;
    CsvColumns trace{{"program", "motion"}};
    std::vector<std::string> notes;
};

inputs::ProgramAndFolders program_of(const RunRequest& request) {
    if (!request.text) return inputs::open_program(request.program, request.folders);
    const auto owner = std::make_shared<const std::string>(*request.text);
    const interpreter::ProgramText text{request.program, *owner, owner};
    return {text, inputs::folders_of_file(text, request.folders)};
}

emulator::RunOptions options_of(const RunRequest& request, const setup::Setup& setup) {
    emulator::RunOptions options;
    options.seed = request.seed;
    options.trace = request.trace;
    options.trace_step_mm = request.trace_step_mm;
    options.trace_chord_mm = request.trace_chord_mm;
    options.truth = request.truth;
    options.automatic_ballbar = request.ballbar;
    options.measure = request.measure;
    options.variables = request.variables;
    options.wanted_variables = request.wanted;
    options.effects = effects::active_models(setup);
    options.budget = {request.max_blocks,
                      request.max_print,
                      request.max_readings,
                      request.max_seconds,
                      {},
                      [](std::uint64_t) { stop_on_ctrl_c(); }};
    return options;
}

FinishedRun run(const LoadedSetup& loaded, const RunRequest& request) {
    inputs::ProgramAndFolders program = program_of(request);
    emulator::RunOptions options = options_of(request, loaded.setup);
    FinishedRun out;
    options.trace_chunk = [&out](std::string_view text) { out.trace.add(text); };
    emulator::RunLog log =
        emulator::run_program(loaded.setup, program.folders, program.program, options);
    out.json = report::run_json(log, setup::all_machine_axes(loaded.setup), program.folders.used());
    if (const auto& alarm = log.result.alarm)
        out.alarm_text = format_diagnostic(alarm->where, emulator::title_of(*alarm), alarm->block);
    out.notes = log.notes;
    for (const std::string& note : program.folders.announcements()) out.notes.push_back(note);
    out.printed = std::move(log.printed);
    out.readings = std::move(log.readings);
    return out;
}

}  // namespace

void add_runs(py::module_& m) {
    py::class_<RunRequest>(m, "RunRequest")
        .def(py::init<>())
        .def_readwrite("program", &RunRequest::program)
        .def_readwrite("text", &RunRequest::text)
        .def_readwrite("programs", &RunRequest::folders)
        .def_readwrite("measure", &RunRequest::measure)
        .def_readwrite("seed", &RunRequest::seed)
        .def_readwrite("max_blocks", &RunRequest::max_blocks)
        .def_readwrite("max_print", &RunRequest::max_print)
        .def_readwrite("max_readings", &RunRequest::max_readings)
        .def_readwrite("max_seconds", &RunRequest::max_seconds)
        .def_readwrite("trace_step_mm", &RunRequest::trace_step_mm)
        .def_readwrite("trace_chord_mm", &RunRequest::trace_chord_mm)
        .def_readwrite("trace", &RunRequest::trace)
        .def_readwrite("truth", &RunRequest::truth)
        .def_readwrite("ballbar", &RunRequest::ballbar)
        .def_readwrite("variables", &RunRequest::variables)
        .def_readwrite("wanted", &RunRequest::wanted);
    py::class_<FinishedRun>(m, "FinishedRun")
        .def_readonly("json", &FinishedRun::json)
        .def_readonly("printed", &FinishedRun::printed)
        .def_readonly("alarm_text", &FinishedRun::alarm_text)
        .def_readonly("readings", &FinishedRun::readings)
        .def_readonly("notes", &FinishedRun::notes)
        .def("trace", [](const FinishedRun& r) { return dict_of(r.trace); });
    m.def("run", &run, WithoutLock());
}

}  // namespace trunnion::python
