// The page of a diagnosis.
#pragma once

#include <string>

#include "diagnosis/diagnosis.h"
#include "report/page.h"

namespace trunnion::report {

/// Verdict in words, where the gap lives, the causes with their shares, and what to measure next.
/// `readings` is their name.
Page diagnosis_page(const diagnosis::Diagnosis& diagnosis, const std::string& readings);

}  // namespace trunnion::report
