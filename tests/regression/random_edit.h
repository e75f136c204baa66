// One random edit of a program's text: what a typing error or a changed post does to it.
#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/random.h"

namespace trunnion::testing {

/// What is inserted, and what codes and letters become.
struct EditChoices {
    std::span<const char*const> blocks, codes;
    std::string letters;
};

inline std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines(1);
    for (const char c : text)
        if (c == '\n')
            lines.emplace_back();
        else
            lines.back() += c;
    return lines;
}

inline std::size_t pick(SeededNoise& noise, std::size_t count) {
    return static_cast<std::size_t>(noise.bits() % count);
}

/// Start and length of a random word of a line.
struct EditedWord {
    std::size_t first = 0, size = 0;
};
inline std::optional<EditedWord> some_word(const std::string& line, SeededNoise& noise) {
    std::vector<EditedWord> words;
    for (std::size_t at = 0; at < line.size(); ++at)
        if (line[at] >= 'A' && line[at] <= 'Z') {
            const std::size_t end = std::min(line.find(' ', at), line.size());
            words.push_back({at, end - at});
        }
    if (words.empty()) return std::nullopt;
    return words[pick(noise, words.size())];
}

/// One edit of a word; false: this one does not fit it.
inline bool edit_word(std::string& text, EditedWord word, std::size_t kind,
                      const EditChoices& choices, SeededNoise& noise) {
    const char letter = text[word.first];
    const bool code = letter == 'G' || letter == 'M';
    if (kind == 4) return text.erase(word.first, word.size + 1), true;
    if (kind == 5 && code)
        return text.replace(word.first, word.size,
                            choices.codes[pick(noise, choices.codes.size())]),
               true;
    if (kind == 6 && !code)
        return text[word.first] = choices.letters[pick(noise, choices.letters.size())], true;
    if (kind == 7 && !code) {
        if (text[word.first + 1] == '-') return text.erase(word.first + 1, 1), true;
        return text.insert(word.first + 1, "-"), true;
    }
    const std::size_t digit = word.first + 1 + pick(noise, word.size);
    if (digit >= text.size() || text[digit] < '0' || text[digit] > '9') return false;
    text[digit] = static_cast<char>('0' + pick(noise, 10));
    return true;
}

/// One edit of line `at`; false: this one does not fit it.
inline bool edit_line(std::vector<std::string>& lines, std::size_t at, const EditChoices& choices,
                      SeededNoise& noise) {
    const auto word = some_word(lines[at], noise);
    const std::size_t kind = pick(noise, 10);
    const auto here = lines.begin() + static_cast<std::ptrdiff_t>(at);
    if (kind == 0)
        return lines.insert(here, choices.blocks[pick(noise, choices.blocks.size())]), true;
    if (kind == 1) return lines.erase(here), true;
    if (kind == 2) return std::swap(lines[at], lines[at + 1]), true;
    if (kind == 3) return lines.insert(here, std::string(lines[at])), true;
    return word && edit_word(lines[at], *word, kind, choices, noise);
}

/// The text with one edit behind its second line, and what was done.
inline std::string edited(const std::string& text, const EditChoices& choices, SeededNoise& noise,
                          std::string& what) {
    for (;;) {
        std::vector<std::string> lines = lines_of(text);
        const std::size_t at = 2 + pick(noise, lines.size() - 6);
        const std::string before = lines[at];
        if (!edit_line(lines, at, choices, noise)) continue;
        what = "line " + std::to_string(at + 1) + ": '" + lines[at] + "' was '" + before + "'";
        std::string out;
        for (std::size_t k = 0; k + 1 < lines.size(); ++k) out += lines[k] + "\n";
        return out;
    }
}

}  // namespace trunnion::testing
