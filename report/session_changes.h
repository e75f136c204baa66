// Changes between sessions, as lines of text and as a section of the page.
#pragma once

#include <string>

#include "diagnosis/diagnosis.h"

namespace trunnion::report {

/// One line a session, then one line a parameter: before, after, change and its sigma, in workshop
/// units; causes first. Empty if changes were not requested.
std::string changes_text(const diagnosis::Diagnosis& diagnosis);

/// Sentence, picture (each change divided by its sigma) and table. Empty likewise.
std::string changes_section(const diagnosis::Diagnosis& diagnosis);

}  // namespace trunnion::report
