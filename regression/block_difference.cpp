#include "regression/block_difference.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string_view>
#include <vector>

#include "interpreter/lexical.h"

namespace trunnion::regression {

namespace {

struct WrittenWord {
    char letter = 0;
    std::string number;
    double value = 0.0;
    bool computed() const { return number.find_first_of("#[") != std::string::npos; }
    bool point() const { return number.find('.') != std::string::npos; }
    std::string text() const { return letter + number; }
};

/// The words without N; empty for macro statements.
std::vector<WrittenWord> words_of(const std::string& block) {
    std::vector<WrittenWord> words;
    bool comment = false;
    int depth = 0;
    for (const char raw : block) {
        const char c = interpreter::upper(raw);
        if (c == '(' || c == ')') comment = c == '(';
        if (comment || c == ')' || interpreter::is_blank(c) || (c == '/' && words.empty()))
            continue;
        depth += c == '[' ? 1 : c == ']' ? -1 : 0;
        const bool begins_word = interpreter::is_letter(c) && depth == 0;
        if (begins_word && !words.empty() && words.back().number.empty()) return {};  // IF, GOTO
        if (begins_word)
            words.push_back({c, "", 0.0});
        else if (!words.empty())
            words.back().number += c;
    }
    std::erase_if(words, [](const WrittenWord& w) { return w.letter == 'N' || w.letter == 'O'; });
    for (WrittenWord& w : words) w.value = std::strtod(w.number.c_str(), nullptr);
    return words;
}

/// `#1 = 5.` without blanks and N; empty for other blocks and for long ones.
std::string assignment_of(const std::string& block) {
    constexpr std::size_t longest = 40;
    std::string text;
    for (const char c : block)
        if (!interpreter::is_blank(c) && c != '\r') text += c;
    if (!text.empty() && (text[0] == 'N' || text[0] == 'n'))
        text.erase(0, std::min(text.size(), text.find_first_not_of("0123456789", 1)));
    return !text.empty() && text[0] == '#' && text.size() <= longest ? text : "";
}

/// Removes words with equal letter and value from both sides.
void cancel(std::vector<WrittenWord>& a, std::vector<WrittenWord>& b) {
    for (std::size_t i = 0; i < a.size();) {
        const auto same = std::find_if(b.begin(), b.end(), [&](const WrittenWord& q) {
            if (q.computed() || a[i].computed())
                return q.letter == a[i].letter && q.number == a[i].number;
            return q.letter == a[i].letter && q.value == a[i].value &&
                   (q.point() == a[i].point() || q.value == 0.0 || q.letter == 'F');
        });
        if (same == b.end()) {
            ++i;
            continue;
        }
        b.erase(same);
        a.erase(a.begin() + static_cast<std::ptrdiff_t>(i));
    }
}

std::string joined(const std::vector<WrittenWord>& words) {
    std::string out;
    for (const WrittenWord& w : words) out += (out.empty() ? "" : " ") + w.text();
    return out;
}

bool same_letters(const std::vector<WrittenWord>& a, const std::vector<WrittenWord>& b) {
    return a.size() == b.size() &&
           std::equal(a.begin(), a.end(), b.begin(),
                      [](const auto& p, const auto& q) { return p.letter == q.letter; });
}

/// The property that holds for every pair of words, if there is one.
template <typename Holds>
bool all_pairs(const std::vector<WrittenWord>& a, const std::vector<WrittenWord>& b,
               const Holds& holds) {
    return std::equal(a.begin(), a.end(), b.begin(), holds);
}

std::string letters(const std::vector<WrittenWord>& words) {
    std::string out;
    for (const WrittenWord& w : words) out += (out.empty() ? "" : " ") + std::string(1, w.letter);
    return out;
}

bool near(double a, double b) {
    return std::abs(a - b) <= 0.002 + 1e-6 * std::abs(a);
}

/// I J K relative to the start on one side, and to the program zero on the other.
std::string centre_cause(const std::vector<WrittenWord>& a, const std::vector<WrittenWord>& b,
                         const std::array<std::optional<double>, 3>& start) {
    const auto shifted = [&](double sign) {
        return all_pairs(a, b, [&](const WrittenWord& p, const WrittenWord& q) {
            if (p.letter < 'I' || p.letter > 'K') return false;
            const auto from = start[static_cast<std::size_t>(p.letter - 'I')];
            return from && near(q.value - p.value, sign * *from);
        });
    };
    if (shifted(1.0)) return letters(a) + " absolute instead of incremental";
    if (shifted(-1.0)) return letters(a) + " incremental instead of absolute";
    return {};
}

/// True of words whose value is an amount: codes and numbers (G43.4, T2, H1) have no other size.
bool is_amount(const WrittenWord& word) {
    constexpr std::string_view amounts = "ABCEFIJKQRUVWXYZ";
    return amounts.find(word.letter) != std::string_view::npos;
}

/// A name for the change of the values.
std::string value_cause(const std::vector<WrittenWord>& a, const std::vector<WrittenWord>& b) {
    const auto pairs = [&](const auto& holds) { return all_pairs(a, b, holds); };
    if (pairs([](const auto& p, const auto& q) { return p.point() && !q.point(); }))
        return "decimal point lost";
    if (pairs([](const auto& p, const auto& q) { return !p.point() && q.point(); }))
        return "decimal point added";
    if (pairs([](const auto& p, const auto& q) { return p.value == -q.value; }))
        return letters(a) + " of opposite sign";
    if (a.size() == 2 && a[0].value == b[1].value && a[1].value == b[0].value)
        return fmt::format("{} and {} exchanged", a[0].letter, a[1].letter);
    if (pairs([](const auto& p, const auto& q) { return near(p.value, 25.4 * q.value); }))
        return "inch instead of mm";
    if (pairs([](const auto& p, const auto& q) { return near(25.4 * p.value, q.value); }))
        return "mm instead of inch";
    return {};
}

}  // namespace

BlockDifference block_difference(const std::string& block_a, const std::string& block_b,
                                 const std::array<std::optional<double>, 3>& start) {
    const std::string set_a = assignment_of(block_a), set_b = assignment_of(block_b);
    if (!set_a.empty() && !set_b.empty())
        return set_a == set_b ? BlockDifference{}
                              : BlockDifference{"", set_b + " instead of " + set_a};
    std::vector<WrittenWord> a = words_of(block_a), b = words_of(block_b);
    if (a.empty() && b.empty()) return {};
    cancel(a, b);
    if (a.empty() && b.empty()) return {};
    if (b.empty()) return {"", joined(a) + " is missing in B"};
    if (a.empty()) return {"", joined(b) + " is only in B"};
    std::string name;
    const auto by_letter = [](const auto& p, const auto& q) { return p.letter < q.letter; };
    std::stable_sort(a.begin(), a.end(), by_letter);
    std::stable_sort(b.begin(), b.end(), by_letter);
    const auto computed = [](const WrittenWord& w) { return w.computed(); };
    const bool plain =
        std::none_of(a.begin(), a.end(), computed) && std::none_of(b.begin(), b.end(), computed);
    if (plain && same_letters(a, b) && std::all_of(a.begin(), a.end(), is_amount)) {
        name = value_cause(a, b);
        if (name.empty()) name = centre_cause(a, b, start);
    }
    if (name.empty() && std::max(a.size(), b.size()) > 3) return {};
    return {name, joined(b) + " instead of " + joined(a)};
}

std::string text_of(const BlockDifference& d) {
    return d.name.empty() ? d.words : d.name + ": " + d.words;
}

std::array<std::optional<double>, 3> position_words(const std::string& block) {
    std::array<std::optional<double>, 3> found;
    for (const WrittenWord& word : words_of(block))
        if (word.letter >= 'X' && word.letter <= 'Z' && !word.computed())
            found[static_cast<std::size_t>(word.letter - 'X')] = word.value;
    return found;
}

}  // namespace trunnion::regression
