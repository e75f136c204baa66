// The setup that a diagnosis writes: of what was found, what predicts.
#pragma once

#include "diagnosis/diagnosis_report.h"

namespace trunnion::diagnosis {

/// Causes that predict readings left out surely better than the set-up alone, as they are written:
/// without drivers and large zeros, without tables that fail between their places, and, where a
/// table is among them, no worse on whole paths left out. Where nothing does: the re-identified
/// setup without causes.
setup::Setup written_setup(const Outcome& found);

}  // namespace trunnion::diagnosis
