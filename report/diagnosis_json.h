// A diagnosis as JSON.
#pragma once

#include <string>

#include "diagnosis/diagnosis.h"

namespace trunnion::report {

/// trunnion.diagnosis/1, one object.
std::string diagnosis_json(const diagnosis::Diagnosis& diagnosis);

}  // namespace trunnion::report
