// Which rows belong together: sessions, and passes of a test (passes.cpp).
#pragma once

#include <span>
#include <vector>

#include "records/readings.h"

namespace trunnion::records {

using PassRows = std::vector<std::size_t>;  ///< indices of the rows of one pass, in order

/// End of the run of rows from `begin` in the same session.
std::size_t session_end(const std::vector<Reading>& rows, std::size_t begin);

/// The rows of each pass: of a test, or of each of its repetitions. Rows of one session.
std::vector<PassRows> passes_of(std::span<const Reading> rows);
/// The passes of all sessions.
std::vector<PassRows> passes_of(const ReadingTable& table);

}  // namespace trunnion::records
