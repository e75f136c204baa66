#include "ballbar/test/ballbar_evaluation.h"

#include <algorithm>
#include <cmath>

#include "ballbar/test/circular_diagnosis.h"

namespace trunnion::ballbar::test {

kinematics::Machine nominal_of(const setup::Setup& setup) {
    kinematics::Machine machine = setup.machine;
    machine.errors = {};
    return machine;
}

std::vector<double> readings_of(const BallbarModel& model, const records::ReadingTable& table) {
    std::vector<double> values;
    for (const std::size_t row : model.rows_used()) values.push_back(*table.rows[row].value_mm);
    return values;
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
                            std::nullopt,
                            std::nullopt};
        for (const NamedError& p : published)
            if (p.name == row.name) row.published_before = p.value;
        rows.push_back(row);
    }
    return rows;
}

namespace {

/// Planar passes reduced to means of neighbouring readings, because range parameters must not grow
/// with the sampling rate. Values are relative to the nominal length of the bar.
records::ReadingTable thinned(const records::ReadingTable& table, double warm_mm) {
    records::ReadingTable out = table;
    out.rows.clear();
    for (const BallbarPass& pass : ballbar_passes(table.rows)) {
        const std::size_t count = pass.end - pass.begin, blocks = std::min(count, points_per_pass);
        for (std::size_t b = 0; b < blocks; ++b) {
            const std::size_t begin = pass.begin + count * b / blocks;
            const std::size_t end = pass.begin + count * (b + 1) / blocks;
            // Position and time of the mean: between the middle two rows of an even number.
            records::Reading row = table.rows[(begin + end - 1) / 2];
            const records::Reading& other = table.rows[(begin + end) / 2];
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

/// Parameters and plots use means; the diagnosis uses every reading, because a mean across a
/// reversal belongs to neither side.
void add_circles(BallbarResult& result) {
    const records::ReadingTable& first = result.before.readings;
    const double radius_mm = result.data.layout.length_mm;
    const auto every = circular_tests(first, radius_mm);
    const auto means = circular_tests(thinned(first, result.reference_mm - radius_mm), radius_mm);
    for (std::size_t i = 0; i < means.size(); ++i)
        result.planar.push_back({means[i], circular_figures(means[i]), diagnose_circle(every[i])});
}

BallbarLayout evaluated_layout(const BallbarResult& result) {
    BallbarLayout layout = result.data.layout;
    layout.length_mm = result.reference_mm;
    return layout;
}

/// The exact and the published evaluation of the first run.
void fit_first_run(BallbarResult& result, const kinematics::Machine& nominal, double declared_mm) {
    const BallbarLayout layout = evaluated_layout(result);
    const records::ReadingTable& first = result.before.readings;
    const BallbarModel model(nominal, layout, first.rows, {});
    const std::vector<double> values = readings_of(model, first);
    result.fit = model.fit(values);
    result.open_fit =
        BallbarModel(nominal, layout, first.rows, {true, PivotPlace::unknown, BarConstant::length})
            .fit(values);
    result.verdict = judge_residuals(model, result.fit);
    result.published = evaluate_as_published(nominal, layout, first.rows);
    result.reading_sigma_mm = reading_sigma_mm(result.fit, declared_mm);
}

}  // namespace trunnion::ballbar::test
