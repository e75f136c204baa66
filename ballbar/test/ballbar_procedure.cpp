#include "ballbar/test/ballbar_procedure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>

#include "ballbar/test/ballbar_evaluation.h"
#include "ballbar/test/ballbar_proof.h"
#include "ballbar/test/ballbar_result.h"
#include "base/units.h"
#include "interpreter/program_folders.h"

namespace trunnion::ballbar::test {

namespace {

/// One run of `text`; what it notes joins `notes`.
BallbarRun run_once(const setup::Setup& setup, const std::string& text,
                    const emulator::RunOptions& run, std::vector<std::string>& notes) {
    const auto owner = std::make_shared<std::string>(text);
    const interpreter::ProgramText program{"O8200.nc", *owner, owner};
    interpreter::ProgramFolders folders({});
    folders.add_file(program);
    emulator::RunLog log = emulator::run_program(setup, folders, program, run);
    if (log.result.alarm) throw *log.result.alarm;
    for (const std::string& note : log.notes)
        if (std::find(notes.begin(), notes.end(), note) == notes.end()) notes.push_back(note);
    return {std::move(log.readings), log.result.time_s};
}

/// Checks that all seven tests are present in both directions and in range, or reports what is
/// missing.
void check_complete(const BallbarModel& model, const std::vector<std::string>& notes) {
    std::vector<std::string> left;
    for (const std::string& note : notes)
        if (note.find("out of its range") != std::string::npos) left.push_back(note);
    if (!left.empty())
        throw InputError(fmt::format(
            "{}{}. Where the pivot is clamped or an axis stands is further off than the bar can "
            "follow: set it up anew",
            left.front(),
            left.size() > 1 ? fmt::format("; so in {} more passes", left.size() - 1) : ""));
    if (model.passes().size() < 14)
        throw InputError(fmt::format("the ballbar read {} of 14 passes", model.passes().size()));
}

/// Differences of two lists with the same names: errors that remain at the intersection after
/// compensation.
std::vector<ErrorEstimate> left_over(std::vector<ErrorEstimate> now,
                                     const std::vector<ErrorEstimate>& known) {
    for (std::size_t i = 0; i < now.size(); ++i) now[i].value -= known[i].value;
    return now;
}

/// The machine with its own location errors and those added by effects.
kinematics::Machine true_machine(const setup::Setup& setup,
                                 const std::vector<NamedError>& injected) {
    kinematics::Machine machine = setup.machine;
    for (const NamedError& e : injected) machine.errors.location(e.name) += e.value;
    return machine;
}

/// Adds to both tables the true remaining errors, which the re-test cannot determine.
void add_what_is_left(BallbarResult& result, const kinematics::Machine& nominal,
                      const kinematics::Machine& truth) {
    for (BallbarErrorRow& row : result.errors)
        row.truly_left = truth.errors.location(row.name) - row.before;
    const std::vector<NamedError> lines = lines_at_intersection(nominal, truth);
    for (std::size_t i = 0; i < lines.size(); ++i)
        result.at_intersection[i].truly_left = lines[i].value - result.at_intersection[i].before;
}

/// Verifications independent of the bar's second run.
void add_proofs(BallbarResult& result, const setup::Setup& setup, const BallbarLayout& layout,
                const emulator::EffectModels& effects, const kinematics::Machine& known) {
    const kinematics::Machine nominal = nominal_of(setup);
    const auto compensation_of = [&](const Vector3& tip_S_mm) {
        return [&nominal, &known, tip_S_mm](const AxisPositions& q) {
            return compensated(q, nominal, known, tip_S_mm);
        };
    };
    result.true_tip = true_tip(setup, layout, effects, compensation_of(layout.cup_S_mm));
    // The stylus has its own length, so its own tip is compensated, not the cup.
    if (setup.probe)
        result.sphere_check =
            check_by_sphere(setup, layout, effects, compensation_of(setup.probe->tip_S_mm));
}

}  // namespace

double BallbarErrorRow::change_percent() const {
    return before == 0.0 ? 0.0 : 100.0 * (std::abs(after) / std::abs(before) - 1.0);
}

std::size_t BallbarResult::tests() const {
    std::set<std::string> names;
    for (const BallbarPass& pass : ballbar_passes(before.readings.rows))
        names.insert(to_string(pass.test));
    return names.size();
}

double BallbarResult::single_setup_s() const {
    return times.setup_s + before.time_s;
}

double BallbarResult::two_setups_s() const {
    const auto changes = static_cast<double>(std::max<std::size_t>(tests(), 2) - 2);
    return 2.0 * times.setup_s + changes * times.remount_s + before.time_s;
}

BarLength bar_length(const BallbarResult& result) {
    const int k = result.fit.find("ballbar.length");
    if (k < 0) return {};
    return {result.fit.value(k), result.reading_sigma_mm * std::sqrt(result.fit.cofactor(k, k))};
}

Vector3 pivot_found_mm(const BallbarResult& result) {
    Vector3 out = Vector3::Zero();
    for (int i = 0; i < 3; ++i)
        if (const int k = result.fit.find(std::string("ballbar.pivot.") + "xyz"[i]); k >= 0)
            out(i) = result.fit.value(k);
    return out;
}

BallbarLayout stated_layout(const setup::Setup& setup, int& tool_offset) {
    if (!setup.ballbar) throw InputError(setup.path + ": the setup has no [ballbar]");
    const auto pivot = std::find_if(
        setup.artefacts.begin(), setup.artefacts.end(),
        [](const setup::Artefact& a) { return a.kind == setup::Artefact::Kind::center_pivot; });
    if (pivot == setup.artefacts.end())
        throw InputError(setup.path + ": the setup has no [[artefact]] of kind center_pivot");
    const double wanted_mm = -setup.ballbar->cup_S_mm.z();
    const auto& tools = setup.stores.tools.tool;
    tool_offset = 0;
    double nearest_mm = 1.0;  // range of the bar
    for (std::size_t n = 1; n < tools.size(); ++n) {
        const double off_mm = std::abs(tools[n].length_mm() - wanted_mm);
        if (off_mm < nearest_mm) nearest_mm = off_mm, tool_offset = static_cast<int>(n);
    }
    if (tool_offset == 0)
        throw InputError(
            fmt::format("{}: no tool offset has about the length of the ballbar's cup ({:.3f} mm)",
                        setup.path, wanted_mm));
    BallbarLayout layout;
    layout.pivot_W_mm = pivot->center_W_mm;
    layout.cup_S_mm = {0, 0, -tools[static_cast<std::size_t>(tool_offset)].length_mm()};
    layout.length_mm = setup.ballbar->length_mm;
    return layout;
}

BallbarProgramData stated_program_data(const setup::Setup& setup, bool inside) {
    int tool_offset = 0;
    BallbarLayout layout = stated_layout(setup, tool_offset);
    layout.inside = inside;
    BallbarProgramData data = ballbar_program_data(nominal_of(setup), layout);
    data.tool_offset = tool_offset;
    data.language = setup::language_of(setup);
    return data;
}

BallbarResult run_ballbar(const setup::Setup& stated, const BallbarProcedureOptions& options) {
    setup::Setup setup = stated;
    BallbarResult result;
    result.machine = setup.name;
    result.setup_path = setup.path;
    result.dialect = setup.dialect.family;
    result.times = options.times;
    const kinematics::Machine nominal = nominal_of(setup);
    result.data = stated_program_data(setup, options.inside);
    // Programs use the nominal circle; readings refer to the bar at the temperature that was read.
    BallbarLayout layout = result.data.layout;
    for (setup::Artefact& artefact : setup.artefacts)
        if (artefact.kind == setup::Artefact::Kind::center_pivot)
            artefact.center_W_mm += options.pivot_offset_mm;
    layout.length_mm = setup.ballbar->length_at_mm(setup.ballbar->read_temperature_c);
    result.reference_mm = layout.length_mm;
    result.program = ballbar_program(nominal, result.data);

    emulator::RunOptions run;
    run.seed = options.seed;
    run.effects = options.effects;
    options.watch(0, "first run");
    result.before = run_once(setup, result.program, run, result.notes);
    check_complete(BallbarModel(nominal, layout, result.before.readings.rows, {}), result.notes);
    const double declared_mm = mm_from_um(setup.ballbar->noise_um);
    options.watch(1, "fit of the errors");
    fit_first_run(result, nominal, declared_mm);

    const kinematics::Machine known = machine_of(nominal, result.fit);
    ++run.seed;
    run.compensation = [&](const AxisPositions& q) {
        return compensated(q, nominal, known, layout.cup_S_mm);
    };
    options.watch(2, "run with compensation");
    result.after = run_once(setup, result.program, run, result.notes);
    const records::ReadingTable& second = result.after.readings;
    options.watch(3, "re-test and proof");
    const BallbarModel again(known, layout, second.rows, {});
    check_complete(again, result.notes);
    const BallbarFit rest = again.fit(readings_of(again, second));
    const double sigma_1 = result.reading_sigma_mm, sigma_2 = reading_sigma_mm(rest, declared_mm);
    result.errors = rows_of(chain_estimates(result.fit, sigma_1), chain_estimates(rest, sigma_2),
                            result.published.chain);
    // `rest` is relative to the known machine: its axis lines minus those of the known machine.
    const auto lines = intersection_estimates(nominal, result.fit, sigma_1);
    result.at_intersection =
        rows_of(lines, left_over(intersection_estimates(known, rest, sigma_2), lines),
                result.published.intersection);
    add_circles(result);
    result.stores = setup::stores_to_type(stated, known, layout.pivot_W_mm, layout.cup_S_mm);
    add_what_is_left(result, nominal, true_machine(setup, options.injected_errors));
    add_proofs(result, setup, layout, options.effects, known);
    return result;
}

}  // namespace trunnion::ballbar::test
