// A diagnosis as text for the terminal.
#pragma once

#include <string>

#include "diagnosis/diagnosis.h"

namespace trunnion::report {

/// Verdict first, then the gap, its location and causes, the remainder, and the next measurement.
std::string diagnosis_text(const diagnosis::Diagnosis& diagnosis);

}  // namespace trunnion::report
