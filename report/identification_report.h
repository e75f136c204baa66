// An identification as JSON and as a table; the part of a shard's repetitions, and back.
#pragma once

#include <string>
#include <vector>

#include "identification/monte_carlo.h"

namespace trunnion::report {

/// trunnion.identification/1.
std::string identification_json(const identification::Identification& result);
/// `repetitions`: with the column of their spread.
std::string identification_text(const identification::Identification& result, bool repetitions);

/// What one shard of `identify --monte-carlo` leaves for `merge`.
struct RepetitionPart {
    std::string inputs;  ///< SHA-256 over setup, readings and effects: parts of one call share it
    int runs = 0;        ///< of all shards together
    std::uint64_t seed = 1;
    /// Parameters, covariance and residuals; neither notes nor the setup.
    identification::Identification fitted;
    std::vector<identification::Repetition> repetitions;  ///< of this shard
};
/// trunnion.identification-part/1; values come back to the last bit.
std::string format_part(const RepetitionPart& part);
/// Whether the text is such a part, judged by its schema.
bool is_repetition_part(const std::string& text);
/// Throws InputError when the text is no such part.
RepetitionPart parse_repetition_part(const std::string& text, const std::string& path);
/// The identification with the spread of all repetitions, as one process would have it. Throws
/// InputError when one is missing, doubled or of another call.
identification::Identification merge_parts(const std::vector<RepetitionPart>& parts);

}  // namespace trunnion::report
