// The setup written by a diagnosis: the found causes that predict.
#pragma once

#include "diagnosis/diagnosis_report.h"

namespace trunnion::diagnosis {

/// The causes that predict left-out readings significantly better than the set-up alone in their
/// written form: without drivers and large zeros, without tables that fail between their positions
/// and, if there is a table among them, no worse on whole left-out paths. If there are none: the
/// re-identified setup without causes.
setup::Setup written_setup(const Outcome& found);

}  // namespace trunnion::diagnosis
