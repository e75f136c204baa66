#include "choices/offset_words.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <functional>
#include <optional>
#include <string_view>

namespace trunnion::choices {

namespace {

/// A letter and the number behind it.
struct TextWord {
    char letter = ' ';
    double value = 0.0;
};

/// The word at `k`; nothing for a letter within a name (LENGTH), or before an expression.
std::optional<TextWord> text_word_at(std::string_view text, std::size_t k) {
    const auto is_letter = [&](std::size_t at) {
        return std::isalpha(static_cast<unsigned char>(text[at])) != 0;
    };
    if (!is_letter(k) || (k > 0 && is_letter(k - 1))) return std::nullopt;
    TextWord out{static_cast<char>(std::toupper(static_cast<unsigned char>(text[k]))), 0.0};
    const char* from = text.data() + k + 1;
    if (std::from_chars(from, text.data() + text.size(), out.value).ec != std::errc())
        return std::nullopt;
    return out;
}

/// Calls `take` with the words of each line.
void for_each_line(const std::vector<interpreter::ProgramText>& texts,
                   const std::function<void(const std::vector<TextWord>&)>& take) {
    for (const interpreter::ProgramText& program : texts) {
        const std::string_view text = program.text;
        bool comment = false;
        std::vector<TextWord> words;
        for (std::size_t k = 0; k < text.size(); ++k) {
            if (text[k] == '(') comment = true;
            if (text[k] == ')' || text[k] == '\n') comment = false;
            if (text[k] == '\n') {
                take(words);
                words.clear();
            } else if (!comment) {
                if (const auto word = text_word_at(text, k)) words.push_back(*word);
            }
        }
        take(words);
    }
}

void insert_number(double value, std::set<int>& out) {
    constexpr double most = 99999.0;
    if (value >= 1.0 && value <= most) out.insert(static_cast<int>(value));
}

/// P of the lines with one of these G codes, or with G10 and this L.
std::set<int> numbers_of_p(const std::vector<interpreter::ProgramText>& texts,
                           const std::vector<double>& codes, double data_l) {
    std::set<int> out;
    for_each_line(texts, [&](const std::vector<TextWord>& words) {
        const auto has = [&](char letter, double value) {
            return std::any_of(words.begin(), words.end(), [&](const TextWord& word) {
                return word.letter == letter && word.value == value;
            });
        };
        const bool selects =
            std::any_of(codes.begin(), codes.end(), [&](double code) { return has('G', code); });
        if (!selects && !(has('G', 10) && has('L', data_l))) return;
        for (const TextWord& word : words)
            if (word.letter == 'P') insert_number(word.value, out);
    });
    return out;
}

}  // namespace

std::set<int> offset_words(const std::vector<interpreter::ProgramText>& texts) {
    std::set<int> out;
    for_each_line(texts, [&](const std::vector<TextWord>& words) {
        for (const TextWord& word : words)
            if (word.letter == 'H' || word.letter == 'D' || word.letter == 'T')
                insert_number(word.value, out);
    });
    return out;
}

std::set<int> additional_offsets(const std::vector<interpreter::ProgramText>& texts) {
    return numbers_of_p(texts, {54.1, 54.0, 154.0}, 20.0);
}

std::set<int> fixture_offset_words(const std::vector<interpreter::ProgramText>& texts) {
    return numbers_of_p(texts, {54.2}, 21.0);
}

}  // namespace trunnion::choices
