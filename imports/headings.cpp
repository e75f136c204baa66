#include "imports/headings.h"

#include <algorithm>
#include <map>

#include "imports/columns.h"

namespace trunnion::imports {
namespace {

using Line = TextTable::Line;

constexpr std::size_t longest_heading = 10;  ///< words; more are a sentence

std::size_t marks_of(std::string_view text) {
    return std::min(text.find_first_not_of('#'), text.size());
}

/// "Mean temperature 20.5" is a remark.
bool has_decimals(std::string_view text) {
    for (std::size_t k = 1; k + 1 < text.size(); ++k)
        if (text[k] == '.' && text[k - 1] >= '0' && text[k - 1] <= '9' && text[k + 1] >= '0' &&
            text[k + 1] <= '9')
            return true;
    return false;
}

/// "Results", not "Feed: 1000" or "1;2".
bool only_words(std::string_view text) {
    return text.find_first_of("=;|\t,") == std::string_view::npos &&
           text.find(':') >= text.size() - 1;
}

int strength_of(const std::string& word) {
    static const std::map<std::string, int> words{{"result", 1},
                                                  {"results", 1},
                                                  {"ergebnis", 1},
                                                  {"ergebnisse", 1},
                                                  {"mean", 2},
                                                  {"means", 2},
                                                  {"average", 2},
                                                  {"averages", 2},
                                                  {"avg", 2},
                                                  {"std", 2},
                                                  {"statistics", 2},
                                                  {"statistik", 2},
                                                  {"summary", 2},
                                                  {"zusammenfassung", 2},
                                                  {"calculation", 2},
                                                  {"calculations", 2},
                                                  {"calculated", 2},
                                                  {"evaluation", 2},
                                                  {"auswertung", 2},
                                                  {"mittelwert", 2},
                                                  {"mittelwerte", 2},
                                                  {"mittlere", 2},
                                                  {"standardabweichung", 2},
                                                  {"standardabweichungen", 2}};
    const auto it = words.find(word);
    return it == words.end() ? 0 : it->second;
}

}  // namespace

std::vector<Line> headings_above(const std::vector<Line>& lines, std::size_t begin,
                                 std::size_t at) {
    std::vector<Line> found;
    std::size_t marks = std::string_view::npos;
    for (std::size_t i = std::min(at, lines.size()); i-- > 0;) {
        const std::size_t own = marks_of(lines[i].text);
        if (own == 0 || own >= marks || !only_words(lines[i].text)) continue;
        if (found.empty() && i < begin) break;  // that of the table before
        found.push_back(lines[i]);
        marks = own;
    }
    for (std::size_t i = at; found.empty() && i-- > begin;)
        if (only_words(lines[i].text)) found.push_back(lines[i]);
    return found;
}

bool section_ends(const std::vector<Line>& lines, const Line& told, int before) {
    const std::size_t rank = marks_of(told.text);
    for (std::size_t i = 1; i < lines.size() && lines[i].number < before; ++i) {
        const std::size_t own = marks_of(lines[i].text);
        if (lines[i].number <= told.number || own == 0 || !only_words(lines[i].text)) continue;
        const Line& above = lines[i - 1];
        const bool same_block = above.number + 1 == lines[i].number && marks_of(above.text) == own;
        if (!same_block && own <= rank) return true;
    }
    return false;
}

std::string heading_words(std::string_view text) {
    const auto first = text.find_first_not_of("#*%! \t\"");
    if (first == std::string_view::npos) return "";
    text = records::without_blanks(text.substr(first));
    while (!text.empty() && (text.back() == ':' || text.back() == '"')) text.remove_suffix(1);
    return std::string(text);
}

int result_words(const std::vector<Line>& headings) {
    int strength = 0;
    for (const Line& line : headings) {
        if (&line != &headings.front() && marks_of(line.text) == 1) break;  // of the whole file
        const std::vector<std::string> words = words_of(heading_words(line.text));
        if (words.size() > longest_heading || has_decimals(line.text)) continue;
        for (std::size_t k = 0; k < words.size(); ++k) {
            const bool next = k + 1 < words.size() && words[k + 1].starts_with("deviation");
            strength =
                std::max({strength, strength_of(words[k]), words[k] == "standard" && next ? 2 : 0});
        }
    }
    return strength;
}

}  // namespace trunnion::imports
