// What the evaluations of simulated and of real passes have in common.
#pragma once

#include "ballbar/test/ballbar_procedure.h"
#include "ballbar/test/ballbar_result.h"

namespace trunnion::ballbar::test {

/// Geometry without any error: what the operator knows before the test.
kinematics::Machine nominal_of(const setup::Setup& setup);
/// Layout with the length from which the readings are counted.
BallbarLayout evaluated_layout(const BallbarResult& result);
/// Values of the rows that the model uses, mm.
std::vector<double> readings_of(const BallbarModel& model, const records::ReadingTable& table);
std::vector<BallbarErrorRow> rows_of(const std::vector<ErrorEstimate>& before,
                                     const std::vector<ErrorEstimate>& after,
                                     const std::vector<NamedError>& published);

/// Circles of `result.before`: figures, traces, diagnosis.
void add_circles(BallbarResult& result);
/// The exact and the published evaluation of `result.before`. `declared_mm`: noise by the setup.
void fit_first_run(BallbarResult& result, const kinematics::Machine& nominal, double declared_mm);

}  // namespace trunnion::ballbar::test
