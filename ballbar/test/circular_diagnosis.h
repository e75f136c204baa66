// Contributing errors of two linear axes on a circle.
#pragma once

#include "ballbar/test/circular_evaluation.h"

namespace trunnion::ballbar::test {

/// Least squares of the traces of backlash, reversal spikes, lateral play, squareness,
/// straightness, scale mismatch, servo mismatch and ballscrew ripple.
CircularDiagnosis diagnose_circle(const CircularTest& test);

}  // namespace trunnion::ballbar::test
