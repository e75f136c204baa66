#include "imports/run_names.h"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include "imports/columns.h"

namespace trunnion::imports {
namespace {

std::string lower(std::string word) {
    for (char& c : word) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return word;
}

constexpr std::pair<const char*, int> direction_words[] = {
    {"+", 1},
    {"-", -1},
    {"up", 1},
    {"down", -1},
    {"pos", 1},
    {"neg", -1},
    {"positive", 1},
    {"negative", -1},
    {"positiv", 1},
    {"negativ", -1},
    {"plus", 1},
    {"minus", -1},
    {"forward", 1},
    {"forwards", 1},
    {"reverse", -1},
    {"backward", -1},
    {"backwards", -1},
    {"back", -1},
    {"return", -1},
    {"upward", 1},
    {"upwards", 1},
    {"downward", -1},
    {"downwards", -1},
    {"ascending", 1},
    {"descending", -1},
    {"increasing", 1},
    {"decreasing", -1},
    {"rising", 1},
    {"falling", -1},
    {"steigend", 1},
    {"fallend", -1},
    {"aufsteigend", 1},
    {"absteigend", -1},
    {"f", 1},
    {"r", -1},
    {"fwd", 1},
    {"rev", -1},
    {"bwd", -1},
    {"vor", 1},
    {"vorw\xC3\xA4rts", 1},
    {"vorwaerts", 1},
    {"r\xC3\xBC"
     "ckw\xC3\xA4rts",
     -1},
    {"rueckwaerts", -1},
    {"rueck", -1},
    {"r\xC3\xBC"
     "ck",
     -1},
    {"zurueck", -1},
    {"hin", 1},
    {"her", -1},
    {"1", 1},
    {"-1", -1},
    {"+1", 1},
    {"\xE2\x86\x91", 1},
    {"\xE2\x86\x93", -1},
    {"\xE2\x86\x92", 1},
    {"\xE2\x86\x90", -1},
    {"cw", -1},
    {"ccw", 1},
};

const std::map<std::string, int>& directions() {
    static const std::map<std::string, int> words(std::begin(direction_words),
                                                  std::end(direction_words));
    return words;
}

bool filler(const std::string& word) {
    static const std::set<std::string> words{
        "run",      "lauf", "cycle",         "zyklus",      "pass",     "deviation", "error",
        "dev",      "err",  "abweichung",    "direction",   "richtung", "no",        "nr",
        "approach", "bi",   "bidirectional", "measurement", "messung",  "repeat",    "fehler"};
    return word.empty() || words.contains(word);
}

/// "ref_pos", "act pos": the position that was read.
bool is_reading(const std::string& word) {
    static const std::set<std::string> words{"ref",    "reference", "act",
                                             "actual", "meas",      "measured"};
    return words.contains(word);
}

/// A word beside the former: "ref_pos(i,1)".
bool is_beside_reading(const std::string& word) {
    static const std::set<std::string> words{"pos", "position", "i", "j"};
    return is_reading(word) || words.contains(word);
}

}  // namespace

int direction_of(std::string word) {
    const auto it = directions().find(lower(std::move(word)));
    return it == directions().end() ? 0 : it->second;
}

RunName run_name(const std::string& name) {
    RunName result;
    std::string word;
    const std::vector<std::string> words = words_of(name);
    // "ref_pos(i,1)" is a position, not "towards positive".
    const bool reading = std::any_of(words.begin(), words.end(), is_reading);
    const auto finish = [&] {
        const bool beside = reading && is_beside_reading(lower(word));
        const int direction = beside ? 0 : direction_of(word);
        if (direction != 0) result.direction = direction;
        result.other |= direction == 0 && !beside && !filler(lower(word));
        word.clear();
    };
    for (const char c : name + ' ') {
        const bool digit = c >= '0' && c <= '9';
        if (digit) result.run = std::min(10 * result.run + (c - '0'), 100000);
        if (digit || std::string(" _.#()/:,").find(c) != std::string::npos) {
            finish();
        } else if (c == '+' || c == '-') {
            finish();
            word = std::string(1, c);
            finish();
        } else {
            word += c;
        }
    }
    return result;
}

}  // namespace trunnion::imports
