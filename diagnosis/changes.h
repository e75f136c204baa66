// What changed between sessions: every parameter of interest from one to the next.
#pragma once

#include "diagnosis/diagnosis_report.h"
#include "diagnosis/solution.h"

namespace trunnion::diagnosis {

/// Changes in the model first; then, beside it, what a change of each location error, of each
/// modelled effect and of each cause would be, from every session to the next. `claimed` marks
/// members that are causes.
std::vector<SessionChange> changes_of(const Outcome& found, const Solution& solution,
                                      const std::vector<bool>& claimed);

/// The same table with a session for each of its files, named by it without folder and ending;
/// nothing where a row says its session or there is one file.
std::optional<records::ReadingTable> files_as_sessions(const records::ReadingTable& table);

/// Rms of each session's readings, from `before_um` and `after_um` of all of them.
std::vector<SessionFit> sessions_of(const Outcome& found, const std::vector<double>& before_um,
                                    const std::vector<double>& after_um);

}  // namespace trunnion::diagnosis
