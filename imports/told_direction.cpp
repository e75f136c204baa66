#include "imports/told_direction.h"

#include <set>
#include <utility>
#include <vector>

#include "geometry/axis_names.h"
#include "imports/run_names.h"

namespace trunnion::imports {
namespace {

std::vector<std::string> words_in(const std::string& text) {
    std::vector<std::string> words;
    std::string word;
    for (const char c : text + ' ') {
        if (std::string(" \t_.#()/:,;|").find(c) == std::string::npos)
            word += c;
        else if (!word.empty())
            words.push_back(std::exchange(word, {}));
    }
    return words;
}

bool both_ways(const std::string& word) {
    static const std::set<std::string> words{
        "both", "bi",       "bidirectional", "bi-directional", "beide", "+-",
        "-+",   "\xC2\xB1", "+/-",           "alternating"};
    return words.contains(word);
}

/// A word, or "X+" and "-Z".
int sign_of(const std::string& word) {
    if (const int direction = direction_of(word)) return direction;
    if (word.size() != 2) return 0;
    const bool ends = word[1] == '+' || word[1] == '-';
    return direction_of(std::string(1, ends ? word[1] : word[0]));
}

/// Words that may stand beside the direction.
bool beside(const std::string& word) {
    static const std::set<std::string> words{
        "data",  "direction", "richtung", "run",      "runs",    "pass",    "passes",
        "table", "the",       "in",       "of",       "towards", "to",      "travel",
        "axis",  "test",      "approach", "movement", "motion",  "messung", "measurement"};
    return words.contains(word);
}

}  // namespace

std::optional<int> direction_in(const std::string& text) {
    const std::string plain = lower_case(text);
    if (both_ways(plain)) return 0;
    bool up = false, down = false;
    for (const std::string& word : words_in(plain)) {
        if (both_ways(word)) return 0;
        const int sign = sign_of(word);
        if (sign == 0 && !beside(word) && word != "and" && word != "und") return std::nullopt;
        up |= sign > 0;
        down |= sign < 0;
    }
    if (!up && !down) return std::nullopt;
    return up && down ? 0 : up ? 1 : -1;
}

std::optional<std::string> direction_of_heading(const std::string& text) {
    // "Pass 1" is a number, "Direction: +" a line with a key.
    if (text.find_first_of("0123456789:=") != text.npos || direction_in(text).value_or(0) == 0)
        return std::nullopt;
    for (const std::string& word : words_in(lower_case(text)))
        if (word.size() > 1 && sign_of(word) != 0) return word;
    return std::nullopt;
}

}  // namespace trunnion::imports
