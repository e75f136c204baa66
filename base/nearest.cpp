#include "base/nearest.h"

#include <algorithm>
#include <cctype>

namespace trunnion::inline base {
namespace {

std::string lower(std::string_view text) {
    std::string out(text);
    for (char& c : out) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return out;
}

/// Edit distance between two words (optimal string alignment).
std::size_t slips(const std::string& a, const std::string& b) {
    std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), now(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        now[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t changed = a[i - 1] == b[j - 1] ? 0 : 1;
            now[j] = std::min({last[j] + 1, now[j - 1] + 1, last[j - 1] + changed});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                now[j] = std::min(now[j], before[j - 2] + 1);
        }
        std::swap(before, last);
        std::swap(last, now);
    }
    return last[b.size()];
}

}  // namespace

std::string nearest(std::string_view word, const std::vector<std::string>& candidates) {
    constexpr std::size_t longest = 60;  // longer words are not searched
    const std::string meant = lower(word);
    if (meant.empty() || meant.size() > longest) return {};
    std::string best;
    std::size_t fewest = std::max<std::size_t>(1, meant.size() / 3) + 1;
    for (const std::string& candidate : candidates) {
        const std::string there = lower(candidate);
        const bool begins = meant.size() > 1 && there.starts_with(meant);
        const std::size_t n = begins ? 1 : slips(meant, there);
        if (n >= fewest) continue;
        fewest = n;
        best = candidate;
    }
    return best;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates) {
    const std::string meant = nearest(word, candidates);
    return meant.empty() ? meant : ", did you mean '" + meant + "'?";
}

}  // namespace trunnion::inline base
