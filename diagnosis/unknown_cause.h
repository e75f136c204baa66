// What stands in a report where no cause does: an unknown one, or readings that were set aside.
#pragma once

#include "diagnosis/diagnosis_report.h"

namespace trunnion::diagnosis {

/// The first readings that were set aside, by their index and the line of their file.
std::string set_aside_words(const Outcome& found);

/// What the causes leave, with the probability that it is more than noise and than what they leave
/// open.
Cause unknown_cause(const Outcome& found, const Diagnosis& diagnosis);

}  // namespace trunnion::diagnosis
