// A diagnosis as JSON.
#pragma once

#include <string>

#include "diagnosis/diagnosis.h"

namespace trunnion::report {

/// trunnion.diagnosis/1 (docs/diagnosis.md), ends with one line break. Lengths in um if the name
/// says so, parameter values in their own units; null for a value that is not finite.
std::string diagnosis_json(const diagnosis::Diagnosis& diagnosis);

}  // namespace trunnion::report
