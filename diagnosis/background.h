// Small errors of all axes beside the causes: each of them is lost in the noise, together they
// predict (ISO 230-1: every axis has six errors).
#pragma once

#include <string>
#include <vector>

#include "diagnosis/diagnosis_report.h"

namespace trunnion::diagnosis {

/// A model with what it lacks of the errors of the axes: for each the textbook form and the
/// smoothest free form, of the size that the readings give it. No cause is claimed of them. Left
/// out: what has no size, what has an enormous one, and free forms of an axis whose left-out
/// positions they do not predict.
Model with_background(const Outcome& f, const Model& model);

/// Names of the errors that one model has and the other has not, each once: "X.scale".
std::vector<std::string> names_beside(const Design& design, const Model& whole, const Model& part);

}  // namespace trunnion::diagnosis
