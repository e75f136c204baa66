// An identification as JSON and as a table; the part of a shard's repetitions, and back.
#pragma once

#include <string>
#include <vector>

#include "base/read_file.h"
#include "identification/monte_carlo.h"

namespace trunnion::report {

/// "12.3 µm", or in µrad where all readings are angles.
std::string size_words(const identification::Identification& result, double size);

/// trunnion.identification/1.
std::string identification_json(const identification::Identification& result,
                                const std::vector<FileRead>& inputs = {});
/// `repetitions`: with the column of their spread.
std::string identification_text(const identification::Identification& result, bool repetitions);

/// Output of one shard of `identify --monte-carlo`, input of `merge`.
struct RepetitionPart {
    std::string inputs;  ///< SHA-256 of setup, readings and effects; equal for the parts of one
                         ///< call
    int runs = 0;        ///< total of all shards
    std::uint64_t seed = 1;
    /// Parameters, covariance and residuals, without notes and setup.
    identification::Identification fitted;
    std::vector<identification::Repetition> repetitions;  ///< of this shard
    std::vector<FileRead> files = {};  ///< that the shard was made from: the same in all
};
/// trunnion.identification-part/1; values read back bit by bit.
std::string format_part(const RepetitionPart& part);
/// True when the schema of the text is that of such a part.
bool is_repetition_part(const std::string& text);
/// Throws InputError when the text is not such a part.
RepetitionPart parse_repetition_part(const std::string& text, const std::string& path);
/// The identification with the standard deviation of all repetitions, equal to the result of a
/// single process. Throws InputError when a part is missing, duplicated or from another call.
identification::Identification merge_parts(const std::vector<RepetitionPart>& parts);

}  // namespace trunnion::report
