#include "imports/run_names.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "geometry/axis_names.h"
#include "imports/columns.h"

namespace trunnion::imports {
namespace {

/// Umlauts, also those that are two characters, and arrows as plain letters and signs.
constexpr std::pair<std::string_view, std::string_view> spellings[] = {
    {"\xC3\xA4", "ae"},
    {"\xC3\x84", "ae"},
    {"\xC3\xB6", "oe"},
    {"\xC3\x96", "oe"},
    {"\xC3\xBC", "ue"},
    {"\xC3\x9C", "ue"},
    {"\xC3\x9F", "ss"},
    {"a\xCC\x88", "ae"},
    {"o\xCC\x88", "oe"},
    {"u\xCC\x88", "ue"},
    {"-->", " + "},
    {"<--", " - "},
    {"->", " + "},
    {"<-", " - "},
    {"\xE2\x86\x91", " + "},
    {"\xE2\x86\x93", " - "},
    {"\xE2\x86\x92", " + "},
    {"\xE2\x86\x90", " - "},
    {"\xE2\x87\x91", " + "},
    {"\xE2\x87\x93", " - "},
    {"\xE2\x87\x92", " + "},
    {"\xE2\x87\x90", " - "},
    {"\xE2\x96\xB2", " + "},
    {"\xE2\x96\xBC", " - "},
    {"\xE2\x96\xB6", " + "},
    {"\xE2\x97\x80", " - "},
    {">", " + "},
    {"<", " - "},
};

std::string folded(const std::string& name) {
    const std::string lower = lower_case(name);
    std::string out;
    for (std::size_t k = 0; k < lower.size();) {
        const std::string_view left = std::string_view(lower).substr(k);
        const auto* const it = std::find_if(std::begin(spellings), std::end(spellings),
                                            [&](auto& s) { return left.starts_with(s.first); });
        const bool known = it != std::end(spellings);
        out += known ? std::string(it->second) : std::string(1, lower[k]);
        k += known ? it->first.size() : 1;
    }
    return out;
}

constexpr std::pair<const char*, int> direction_words[] = {
    {"+", 1},
    {"-", -1},
    {"up", 1},
    {"down", -1},
    {"dn", -1},
    {"dwn", -1},
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
    {"reversed", -1},
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
    {"asc", 1},
    {"desc", -1},
    {"increasing", 1},
    {"decreasing", -1},
    {"incr", 1},
    {"decr", -1},
    {"rising", 1},
    {"falling", -1},
    {"steigend", 1},
    {"fallend", -1},
    {"aufsteigend", 1},
    {"absteigend", -1},
    {"f", 1},
    {"r", -1},
    {"fw", 1},
    {"bw", -1},
    {"fwd", 1},
    {"rev", -1},
    {"bwd", -1},
    {"bkwd", -1},
    {"vor", 1},
    {"vorw", 1},
    {"vorwaerts", 1},
    {"rueckwaerts", -1},
    {"rueckw", -1},
    {"rueck", -1},
    {"ruck", -1},
    {"zurueck", -1},
    {"zuruck", -1},
    {"hin", 1},
    {"her", -1},
    {"vorlauf", 1},
    {"ruecklauf", -1},
    {"hinlauf", 1},
    {"hinweg", 1},
    {"rueckweg", -1},
    {"hinfahrt", 1},
    {"rueckfahrt", -1},
    {"vorwaertsfahrt", 1},
    {"rueckwaertsfahrt", -1},
    {"auf", 1},
    {"ab", -1},
    {"aufwaerts", 1},
    {"abwaerts", -1},
    {"hoch", 1},
    {"runter", -1},
    {"1", 1},
    {"-1", -1},
    {"+1", 1},
    {"cw", -1},
    {"ccw", 1},
};

/// Letters that are a direction behind the number of a run only: "1b", "2 d".
int direction_of_letter(const std::string& word) {
    return word == "u" ? 1 : word == "b" || word == "d" ? -1 : 0;
}

const std::map<std::string, int>& directions() {
    static const std::map<std::string, int> words(std::begin(direction_words),
                                                  std::end(direction_words));
    return words;
}

bool filler(const std::string& word) {
    static const std::set<std::string> words{
        "run",         "lauf",      "cycle",    "zyklus",     "pass",          "deviation",
        "error",       "dev",       "err",      "abweichung", "direction",     "richtung",
        "no",          "nr",        "approach", "bi",         "bidirectional", "measurement",
        "messung",     "repeat",    "fehler",   "trial",      "series",        "serie",
        "reihe",       "messreihe", "scan",     "durchgang",  "durchlauf",     "fahrt",
        "sequence",    "messfahrt", "wert",     "messwert",   "reading",       "value",
        "directional", "dir",       "test",     "sweep",      "axis",          "achse"};
    return word.empty() || words.contains(word);
}

bool is_axis(const std::string& word) {
    return word.size() == 1 && std::string_view("xyzabcuvw").find(word) != std::string_view::npos;
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

/// "I" to "IX", which number the runs of some tables; 0 for other words, also for the axis X.
int roman_number(const std::string& word) {
    constexpr std::array<const char*, 9> numerals{"i",  "ii",  "iii",  "iv", "v",
                                                  "vi", "vii", "viii", "ix"};
    const auto* const it = std::find(numerals.begin(), numerals.end(), word);
    return it == numerals.end() ? 0 : static_cast<int>(it - numerals.begin()) + 1;
}

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}
bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c & 0x80) != 0;
}
bool is_word(char c) {
    return is_digit(c) || is_letter(c);
}

/// A hyphen, as in "Run-1", "bi-directional" and "Run 1 - up".
bool is_hyphen(const std::string& text, std::size_t k) {
    if (text[k] != '-' || k == 0 || k + 1 == text.size()) return false;
    const char before = text[k - 1], after = text[k + 1];
    if (is_word(before) && is_word(after)) return true;
    const bool apart = before == ' ' && after == ' ';
    const auto word = [](char c) { return is_word(c); };
    return apart && std::any_of(text.begin() + static_cast<std::ptrdiff_t>(k), text.end(), word) &&
           std::any_of(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(k), word);
}

/// Reads a name from its front.
class NameReader {
  public:
    explicit NameReader(const std::string& name) : text_(folded(name)) {
        const std::vector<std::string> words = words_of(name);
        // "ref_pos(i,1)" is a position, not "towards positive".
        reading_ = std::any_of(words.begin(), words.end(), is_reading);
    }

    RunName read() {
        for (std::size_t k = 0; k < text_.size(); ++k) take(k);
        finish();
        const bool both = up_ && down_;
        // "I+" is a run; without a direction "I" is an index.
        const bool roman = roman_ > 0 && up_ != down_ && result_.run == 0;
        if (roman) result_.run = roman_;
        result_.other |= unknown_ && !roman;
        result_.other |= both || (axis_ && !up_ && !down_);
        result_.direction = both ? 0 : up_ ? 1 : down_ ? -1 : 0;
        return result_;
    }

  private:
    void take(std::size_t k) {
        const char c = text_[k];
        const bool between = std::string_view(" _.#()[]/:,;").find(c) != std::string_view::npos;
        if (is_digit(c) || between || is_hyphen(text_, k)) {
            finish();
            if (is_digit(c)) result_.run = std::min(10 * result_.run + (c - '0'), 100000);
        } else if (c == '+' || c == '-') {
            finish();
            word_ = std::string(1, c);
            finish();
        } else {
            word_ += c;
        }
    }

    void finish() {
        const bool beside = reading_ && is_beside_reading(word_);
        const int letter = result_.run > 0 ? direction_of_letter(word_) : 0;
        const int direction = beside ? 0 : letter != 0 ? letter : direction_of(word_);
        up_ |= direction > 0;
        down_ |= direction < 0;
        result_.lone_r |= word_ == "r";
        axis_ |= is_axis(word_) && direction == 0;
        // An index stands behind: "X_fwd(i)".
        const bool first = !up_ && !down_ && !axis_ && !beside;
        const int roman = direction == 0 && first ? roman_number(word_) : 0;
        if (roman > 0) roman_ = roman;
        const bool known = direction != 0 || beside || filler(word_) || is_axis(word_);
        unknown_ |= !known && roman > 0;
        result_.other |= !known && roman == 0;
        word_.clear();
    }

    std::string text_, word_;
    bool reading_ = false, up_ = false, down_ = false, axis_ = false;
    bool unknown_ = false;  ///< a word that is none but a Roman number
    int roman_ = 0;
    RunName result_;
};

}  // namespace

int direction_of(const std::string& word) {
    std::string plain = folded(word);
    std::erase(plain, ' ');
    const auto it = directions().find(plain);
    return it == directions().end() ? 0 : it->second;
}

RunName run_name(const std::string& name) {
    return NameReader(name).read();
}

}  // namespace trunnion::imports
