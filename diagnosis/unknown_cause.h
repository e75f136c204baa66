// What stands in a report where no cause does: an unknown one, or readings that were set aside.
#pragma once

#include "diagnosis/diagnosis_report.h"

namespace trunnion::diagnosis {

/// The first readings that were set aside, by their index and the line of their file.
std::string set_aside_words(const Outcome& found);

/// True where an unknown cause stands in the report: the gap is not explained, or more readings
/// were set aside than a few spoiled ones (are_spoiled()), whatever the causes explain of
/// the others.
bool leaves_something(const Outcome& found, const Diagnosis& diagnosis);

/// Adds what the causes leave, with the probability that it is more than noise and than what they
/// leave open: by its share among the causes; what is rather not there stands last, like any other
/// cause.
void add_unknown(const Outcome& found, Diagnosis& diagnosis);

}  // namespace trunnion::diagnosis
