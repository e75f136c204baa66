// Passes of a real machine: the same evaluations, without data known to a simulator only.
#include "ballbar/test/ballbar_measured.h"

#include <algorithm>

#include "ballbar/test/ballbar_evaluation.h"
#include "base/alarm.h"
#include "base/units.h"

namespace trunnion::ballbar::test {

namespace {

bool has_rotary_passes(const records::ReadingTable& table) {
    const auto passes = ballbar_passes(table.rows);
    return std::any_of(passes.begin(), passes.end(),
                       [](const BallbarPass& pass) { return pass.test.rotary.has_value(); });
}

/// Location errors determined by the passes of a real machine.
std::vector<ErrorEstimate> measured_errors(const BallbarFit& fit, double sigma_mm) {
    std::vector<ErrorEstimate> out;
    for (const ErrorEstimate& e : chain_estimates(fit, sigma_mm))
        if (const int k = fit.find(to_string(e.name)); k >= 0 && fit.determined(k))
            out.push_back(e);
    return out;
}

void add_after(BallbarResult& result, const kinematics::Machine& nominal,
               const records::ReadingTable& after, double declared_mm) {
    const BallbarModel model(nominal, evaluated_layout(result), after.rows, {});
    const BallbarFit fit = model.fit(readings_of(model, after));
    const auto estimates = chain_estimates(fit, reading_sigma_mm(fit, declared_mm));
    for (BallbarErrorRow& row : result.errors)
        for (const ErrorEstimate& e : estimates)
            if (e.name == row.name) {
                row.after = e.value;
                row.sigma = e.sigma;
            }
}

}  // namespace

BallbarResult evaluate_ballbar(const setup::Setup& stated, const records::ReadingTable& before,
                               const std::optional<records::ReadingTable>& after) {
    if (ballbar_passes(before.rows).empty())
        throw InputError(
            "no passes of a ballbar test (tests named xy_.., yz_.., zx_.., radial_A_.., "
            "axial_C_..)",
            {before.path});
    BallbarResult result;
    result.machine = stated.name;
    result.setup_path = stated.path;
    result.dialect = stated.dialect.family;
    result.simulated = false;
    result.has_after = after.has_value();
    result.before.readings = before;
    if (after) result.after.readings = *after;
    result.data.layout = stated_layout(stated, result.data.tool_offset);
    result.reference_mm = stated.ballbar->length_at_mm(stated.ballbar->read_temperature_c);
    add_circles(result);
    if (!has_rotary_passes(before)) return result;
    const kinematics::Machine nominal = nominal_of(stated);
    const double declared_mm = mm_from_um(stated.ballbar->noise_um);
    fit_first_run(result, nominal, declared_mm);
    const auto found = measured_errors(result.fit, result.reading_sigma_mm);
    result.errors = rows_of(found, found, result.published.chain);
    if (after) add_after(result, nominal, *after, declared_mm);
    const kinematics::Machine known = machine_of(nominal, result.fit);
    result.stores = setup::stores_to_type(stated, known, result.data.layout.pivot_W_mm,
                                          result.data.layout.cup_S_mm);
    return result;
}

}  // namespace trunnion::ballbar::test
