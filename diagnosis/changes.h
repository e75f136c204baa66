// Changes between sessions: every parameter of interest from one session to the next.
#pragma once

#include "diagnosis/diagnosis_report.h"
#include "diagnosis/search/solution.h"

namespace trunnion::diagnosis {

/// First the changes in the model; then, beside it, the estimated change of each location error,
/// each modelled effect and each cause from every session to the next. `probability` is that of
/// the cause that each member is, 0 of members that are none.
std::vector<SessionChange> changes_of(const Outcome& found, const Solution& solution,
                                      const std::vector<double>& probability);

/// The table with one session for each of its files, named after the file without folder and
/// extension; empty when a row has a session or there is only one file.
std::optional<records::ReadingTable> files_as_sessions(const records::ReadingTable& table);

/// Rms of the readings of each session, from `before_um` and `after_um` of all readings.
std::vector<SessionFit> sessions_of(const Outcome& found, const std::vector<double>& before_um,
                                    const std::vector<double>& after_um);

}  // namespace trunnion::diagnosis
