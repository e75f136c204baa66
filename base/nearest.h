// The word that a mistyped one was meant to be.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace trunnion::inline base {

/// The candidate that the fewest slips (a letter left out, added, changed, two swapped; case counts
/// not) lead to `word`: at most one for every three letters, at least one. A candidate that begins
/// with `word` (two letters and more) is meant too. Empty: none is near. Of equals the first.
std::string nearest(std::string_view word, const std::vector<std::string>& candidates);

/// ", did you mean 'run'?", or nothing.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace trunnion::inline base
