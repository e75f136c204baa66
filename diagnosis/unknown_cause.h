// What stands in a report where no cause does: an unknown one, or readings that were set aside.
#pragma once

#include "diagnosis/diagnosis_report.h"

namespace trunnion::diagnosis {

/// The first readings that were set aside, by their index and the line of their file.
std::string set_aside_words(const Outcome& found);

/// True where more readings were set aside than a few spoiled ones (rules::most_outliers): whatever
/// the causes explain of the others, that is a gap.
bool has_many_set_aside(const Outcome& found);

/// Adds what the causes leave, with the probability that it is more than noise and than what they
/// leave open: by its share among the causes; what is rather not there stands last, like any other
/// cause.
void add_unknown(const Outcome& found, Diagnosis& diagnosis);

}  // namespace trunnion::diagnosis
