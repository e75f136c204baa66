// A diagnosis as the terminal shows it.
#pragma once

#include <string>

#include "diagnosis/diagnosis.h"

namespace trunnion::report {

/// Verdict first, then the gap, where it lies, its causes, what remains and what to measure next.
std::string diagnosis_text(const diagnosis::Diagnosis& diagnosis);

}  // namespace trunnion::report
