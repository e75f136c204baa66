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
        "data",     "direction", "richtung",    "run",         "runs",     "pass",
        "passes",   "table",     "the",         "in",          "of",       "towards",
        "to",       "travel",    "axis",        "test",        "approach", "movement",
        "motion",   "messung",   "measurement", "tests",       "sequence", "measurements",
        "cycle",    "cycles",    "scan",        "sweep",       "series",   "sequences",
        "readings", "order",     "messreihe",   "reihenfolge", "folge",    "lauf",
        "fahrt"};
    return words.contains(word);
}

/// Words that mean a direction of travel also beside others; "up" and "back" need not.
bool is_clear(const std::string& word) {
    static const std::set<std::string> words{"forward",
                                             "forwards",
                                             "backward",
                                             "backwards",
                                             "reverse",
                                             "positive",
                                             "negative",
                                             "positiv",
                                             "negativ",
                                             "ascending",
                                             "descending",
                                             "fwd",
                                             "bwd",
                                             "vorwaerts",
                                             "rueckwaerts",
                                             "vorw\xC3\xA4rts",
                                             "r\xC3\xBC"
                                             "ckw\xC3\xA4rts"};
    return words.contains(word);
}

bool is_direction(const std::string& word) {
    return word == "direction" || word == "richtung";
}
bool is_travel(const std::string& word) {
    static const std::set<std::string> words{"pass",     "run",   "travel", "approach", "movement",
                                             "motion",   "sweep", "stroke", "lauf",     "fahrt",
                                             "sequence", "scan",  "series", "messreihe"};
    return words.contains(word);
}

/// "Positive direction is away from the motor": a sentence, which states something else.
bool is_verb(const std::string& word) {
    static const std::set<std::string> words{"is",    "are", "was",  "were", "has",  "have",
                                             "means", "ist", "sind", "war",  "wurde"};
    return words.contains(word);
}

/// +1 or -1 for a word of a direction that its neighbours, or the end of the heading, make clear.
int sign_at(const std::vector<std::string>& words, std::size_t k) {
    const std::string& word = words[k];
    if (word.size() < 2 || word.find_first_of("0123456789") != word.npos) return 0;
    const bool last = k + 1 == words.size();
    const std::string before = k > 0 ? words[k - 1] : "", after = last ? "" : words[k + 1];
    if (is_direction(before) || is_direction(after)) return sign_of(word);
    if (!is_clear(word)) return 0;
    const bool ends = last && !word.starts_with("positiv") && !word.starts_with("negativ");
    return ends || is_travel(before) || is_travel(after) ? sign_of(word) : 0;
}

/// "Sensor AB12 Negative Direction", "Stage 4, backward travel": the word, or "both".
std::optional<std::string> direction_among(const std::vector<std::string>& words) {
    std::optional<std::string> found;
    bool up = false, down = false;
    for (std::size_t k = 0; k < words.size(); ++k) {
        if (is_verb(words[k])) return std::nullopt;
        const int told = sign_at(words, k), sign = is_clear(words[k]) ? sign_of(words[k]) : told;
        if (told != 0) found = words[k];
        up |= sign > 0;
        down |= sign < 0;
    }
    return found && up && down ? "both" : found;
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
    // "Direction: +" is a line with a key.
    if (text.find_first_of(":=") != text.npos) return std::nullopt;
    const std::vector<std::string> words = words_in(lower_case(text));
    const bool cells = text.find_first_of(";|\t") != text.npos;
    const bool number = text.find_first_of("0123456789") != text.npos;  // "Pass 1"
    if (number || direction_in(text).value_or(0) == 0)
        return cells ? std::nullopt : direction_among(words);
    for (const std::string& word : words)
        if (word.size() > 1 && sign_of(word) != 0) return word;
    return std::nullopt;
}

}  // namespace trunnion::imports
