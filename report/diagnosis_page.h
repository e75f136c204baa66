// A diagnosis as one self-contained HTML page.
#pragma once

#include <string>

#include "diagnosis/diagnosis.h"

namespace trunnion::report {

/// Verdict in words, where the gap lives, the causes with their shares, and what to measure next.
/// `title` is the name of the readings.
std::string diagnosis_page(const diagnosis::Diagnosis& diagnosis, const std::string& title);

}  // namespace trunnion::report
