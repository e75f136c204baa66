// Common parts of the evaluations of simulated and real passes.
#pragma once

#include "ballbar/test/ballbar_procedure.h"
#include "ballbar/test/ballbar_result.h"

namespace trunnion::ballbar::test {

/// Geometry without errors: the operator's knowledge before the test.
kinematics::Machine nominal_of(const setup::Setup& setup);
/// Layout with the length to which the readings refer.
BallbarLayout evaluated_layout(const BallbarResult& result);
/// Values of the rows used by the model, mm.
std::vector<double> readings_of(const BallbarModel& model, const records::ReadingTable& table);
std::vector<BallbarErrorRow> rows_of(const std::vector<ErrorEstimate>& before,
                                     const std::vector<ErrorEstimate>& after,
                                     const std::vector<NamedError>& published);

/// Circles of `result.before`: parameters, traces, diagnosis.
void add_circles(BallbarResult& result);
/// The exact and the published evaluation of `result.before`. `declared_mm`: noise according to the
/// setup.
void fit_first_run(BallbarResult& result, const kinematics::Machine& nominal, double declared_mm);

}  // namespace trunnion::ballbar::test
