#include "ballbar/test/ballbar_procedure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>

#include "ballbar/test/ballbar_result.h"
#include "base/units.h"
#include "interpreter/program_folders.h"

namespace trunnion {

namespace {

constexpr std::size_t points_per_pass = 720;  ///< of circular figures: half a degree of a circle

/// Geometry without any error: what the operator knows before the test.
Machine nominal_of(const Setup& setup) {
    Machine machine = setup.machine;
    machine.errors = {};
    return machine;
}

BallbarRun run_once(const Setup& setup, const BallbarResult& result,
                    const BallbarProcedureOptions& options, std::uint64_t seed,
                    Compensation compensation, std::vector<std::string>& notes) {
    const auto owner = std::make_shared<std::string>(result.program);
    const ProgramText program{"O8200.nc", *owner, owner};
    ProgramFolders folders({});
    folders.add_file(program);
    RunOptions run;
    run.seed = seed;
    run.effects = options.effects;
    run.compensation = std::move(compensation);
    RunLog log = run_program(setup, folders, program, run);
    if (log.result.alarm) throw *log.result.alarm;
    for (const std::string& note : log.notes)
        if (std::find(notes.begin(), notes.end(), note) == notes.end()) notes.push_back(note);
    return {std::move(log.readings), log.result.time_s};
}

std::vector<double> readings_of(const BallbarModel& model, const ReadingTable& table) {
    std::vector<double> values;
    for (const std::size_t row : model.rows_used()) values.push_back(*table.rows[row].value_mm);
    return values;
}

/// All seven tests both ways and in range all the way, or a message that names what is missing.
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

std::vector<BallbarErrorRow> rows_of(const std::vector<ErrorEstimate>& before,
                                     const std::vector<ErrorEstimate>& after,
                                     const std::vector<NamedError>& published) {
    std::vector<BallbarErrorRow> rows;
    for (std::size_t i = 0; i < before.size(); ++i) {
        BallbarErrorRow row{before[i].name,
                            before[i].value,
                            after[i].value,
                            before[i].sigma,
                            std::hypot(before[i].sigma, after[i].sigma),
                            std::nullopt};
        for (const NamedError& p : published)
            if (p.name == row.name) row.published_before = p.value;
        rows.push_back(row);
    }
    return rows;
}

/// Differences of two lists of the same names: what the compensated control leaves at the
/// intersection.
std::vector<ErrorEstimate> left_over(std::vector<ErrorEstimate> now,
                                     const std::vector<ErrorEstimate>& known) {
    for (std::size_t i = 0; i < now.size(); ++i) now[i].value -= known[i].value;
    return now;
}

/// Planar passes as means of neighbouring readings: figures of a range must not grow with the
/// sampling rate. Values count from the nominal length of the bar.
ReadingTable thinned(const ReadingTable& table, double warm_mm) {
    ReadingTable out = table;
    out.rows.clear();
    for (const BallbarPass& pass : ballbar_passes(table.rows)) {
        const std::size_t count = pass.end - pass.begin, blocks = std::min(count, points_per_pass);
        for (std::size_t b = 0; b < blocks; ++b) {
            const std::size_t begin = pass.begin + count * b / blocks;
            const std::size_t end = pass.begin + count * (b + 1) / blocks;
            // Place and time of the mean: halfway between the middle two of an even number.
            Reading row = table.rows[(begin + end - 1) / 2];
            const Reading& other = table.rows[(begin + end) / 2];
            row.time_s = 0.5 * (row.time_s + other.time_s);
            for (const Axis axis : all_axes)
                row.commanded[axis] = 0.5 * (row.commanded[axis] + other.commanded[axis]);
            double sum = 0.0;
            for (std::size_t i = begin; i < end; ++i) sum += *table.rows[i].value_mm;
            row.value_mm = sum / static_cast<double>(end - begin) + warm_mm;
            out.rows.push_back(std::move(row));
        }
    }
    return out;
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

BallbarLayout stated_layout(const Setup& setup, int& tool_offset) {
    if (!setup.ballbar) throw InputError(setup.path + ": the setup has no [ballbar]");
    const auto pivot =
        std::find_if(setup.artefacts.begin(), setup.artefacts.end(),
                     [](const Artefact& a) { return a.kind == Artefact::Kind::center_pivot; });
    if (pivot == setup.artefacts.end())
        throw InputError(setup.path + ": the setup has no [[artefact]] of kind center_pivot");
    const double wanted_mm = -setup.ballbar->cup_S_mm.z();
    const auto& tools = setup.stores.tools.tool;
    tool_offset = 0;
    double nearest_mm = 1.0;  // the range of the bar
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

BallbarProgramData stated_program_data(const Setup& setup, bool inside) {
    int tool_offset = 0;
    BallbarLayout layout = stated_layout(setup, tool_offset);
    layout.inside = inside;
    BallbarProgramData data = ballbar_program_data(nominal_of(setup), layout);
    data.tool_offset = tool_offset;
    data.hurco = setup.dialect.family == DialectFamily::hurco;
    return data;
}

BallbarResult run_ballbar(const Setup& stated, const BallbarProcedureOptions& options) {
    Setup setup = stated;
    BallbarResult result;
    result.machine = setup.name;
    result.setup_path = setup.path;
    result.dialect = setup.dialect.family;
    result.times = options.times;
    const Machine nominal = nominal_of(setup);
    result.data = stated_program_data(setup, options.inside);
    // Programs go on the nominal circle, readings count from the bar as warm as it was read.
    BallbarLayout layout = result.data.layout;
    for (Artefact& artefact : setup.artefacts)
        if (artefact.kind == Artefact::Kind::center_pivot)
            artefact.center_W_mm += options.pivot_offset_mm;
    layout.length_mm = setup.ballbar->length_at_mm(setup.ballbar->read_temperature_c);
    result.reference_mm = layout.length_mm;
    result.program = ballbar_program(nominal, result.data);

    result.before = run_once(setup, result, options, options.seed, {}, result.notes);
    const ReadingTable& first = result.before.readings;
    const BallbarModel model(nominal, layout, first.rows, {});
    check_complete(model, result.notes);
    const std::vector<double> values = readings_of(model, first);
    result.fit = model.fit(values);
    result.open_fit =
        BallbarModel(nominal, layout, first.rows, {true, PivotPlace::unknown, BarConstant::length})
            .fit(values);
    result.verdict = judge_residuals(model, result.fit);
    result.published = evaluate_as_published(nominal, layout, first.rows);

    const Machine known = machine_of(nominal, result.fit);
    result.after = run_once(
        setup, result, options, options.seed + 1,
        [&](const AxisPositions& q) { return compensated(q, nominal, known, layout.cup_S_mm); },
        result.notes);
    const ReadingTable& second = result.after.readings;
    const BallbarModel again(known, layout, second.rows, {});
    check_complete(again, result.notes);
    const BallbarFit rest = again.fit(readings_of(again, second));

    const double declared_mm = mm_from_um(setup.ballbar->noise_um);
    const double sigma_1 = reading_sigma_mm(result.fit, declared_mm);
    result.reading_sigma_mm = sigma_1;
    const double sigma_2 = reading_sigma_mm(rest, declared_mm);
    result.errors = rows_of(chain_estimates(result.fit, sigma_1), chain_estimates(rest, sigma_2),
                            result.published.chain);
    // `rest` counts from the known machine: lines of that, minus lines of the known one.
    const auto lines = intersection_estimates(nominal, result.fit, sigma_1);
    result.at_intersection =
        rows_of(lines, left_over(intersection_estimates(known, rest, sigma_2), lines),
                result.published.intersection);
    const double radius_mm = result.data.layout.length_mm;
    // Figures and plots of means, the diagnosis of every reading: a mean across a reversal is
    // neither side's.
    const auto every = circular_tests(first, radius_mm);
    const auto means = circular_tests(thinned(first, result.reference_mm - radius_mm), radius_mm);
    for (std::size_t i = 0; i < means.size(); ++i)
        result.planar.push_back({means[i], circular_figures(means[i]), diagnose_circle(every[i])});
    result.stores = stores_to_type(stated, known, layout.pivot_W_mm, layout.cup_S_mm);
    return result;
}

}  // namespace trunnion
