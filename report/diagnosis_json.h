// A diagnosis as JSON.
#pragma once

#include <string>
#include <vector>

#include "base/read_file.h"
#include "diagnosis/diagnosis.h"

namespace trunnion::report {

/// trunnion.diagnosis/1 (docs/diagnosis.md), one line break at its end. Lengths in um where the
/// name says so, values of parameters in their own units; null for what is not finite.
std::string diagnosis_json(const diagnosis::Diagnosis& diagnosis,
                           const std::vector<FileRead>& inputs = {});

}  // namespace trunnion::report
