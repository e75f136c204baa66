// Suggestion for a mistyped word.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace trunnion::inline base {

/// The candidate with the smallest edit distance to `word` (a letter missing, added, changed, or
/// two swapped; case ignored): at most one edit for every three letters, at least one allowed. A
/// candidate that starts with `word` (two letters or more) also counts. Of equals the first. Empty:
/// no candidate is near.
std::string nearest(std::string_view word, const std::vector<std::string>& candidates);

/// ", did you mean 'run'?", or an empty text.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace trunnion::inline base
