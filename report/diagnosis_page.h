// The page of a diagnosis.
#pragma once

#include <string>

#include "diagnosis/diagnosis.h"
#include "report/page.h"

namespace trunnion::report {

/// Verdict in words, location of the gap, causes with their shares, and suggested measurements.
/// `readings`: their name.
Page diagnosis_page(const diagnosis::Diagnosis& diagnosis, const std::string& readings);

}  // namespace trunnion::report
