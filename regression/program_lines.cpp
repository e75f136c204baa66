#include "regression/program_lines.h"

#include <algorithm>

#include "interpreter/lexical.h"

namespace trunnion {

namespace {

constexpr int lines_a_mark = 256;

/// Calls `visit(line, number)` for each line of a text, without line ends.
template <typename Visit>
void each_line(std::string_view text, const Visit& visit) {
    const char* p = text.data();
    const char* const end = p + text.size();
    for (int number = 1; p != end; ++number) {
        const char* const line_end = find_line_end(p, end);
        visit(std::string_view(p, static_cast<std::size_t>(line_end - p)), number);
        p = line_end == end ? end : past_line_end(line_end, end);
    }
}

std::string_view without_trailing_blanks(std::string_view line) {
    while (!line.empty() && is_blank(line.back())) line.remove_suffix(1);
    return line;
}

}  // namespace

ProgramLines::ProgramLines(std::string_view text) : text_(text) {
    each_line(text, [&](std::string_view line, int number) {
        if ((number - 1) % lines_a_mark == 0)
            starts_.push_back(static_cast<std::size_t>(line.data() - text.data()));
        count_ = number;
    });
}

std::string ProgramLines::line(int number) const {
    if (number < 1 || number > count_) return {};
    const char* p = text_.data() + starts_[static_cast<std::size_t>((number - 1) / lines_a_mark)];
    const char* const end = text_.data() + text_.size();
    for (int skip = (number - 1) % lines_a_mark; skip > 0; --skip)
        p = past_line_end(find_line_end(p, end), end);
    const char* const line_end = find_line_end(p, end);
    std::string line(without_trailing_blanks({p, static_cast<std::size_t>(line_end - p)}));
    for (char& c : line)
        if (static_cast<unsigned char>(c) < 0x20 && c != '\t') c = '?';
    return line;
}

std::uint64_t hash_of(std::string_view text, std::uint64_t seed) {
    std::uint64_t h = seed;
    for (const char c : text) h = (h ^ static_cast<unsigned char>(c)) * 0x100000001B3ULL;
    h ^= h >> 32;
    return h * 0x9E3779B97F4A7C15ULL;
}

KeyedLines text_keys(std::string_view text) {
    KeyedLines result;
    std::size_t last = 0;
    each_line(text, [&](std::string_view line, int number) {
        const std::string_view trimmed = without_trailing_blanks(line);
        result.add(hash_of(trimmed), number);
        if (!trimmed.empty()) last = result.keys.size();
    });
    result.keys.resize(last);
    result.lines.resize(last);
    return result;
}

std::vector<KeyGap> key_gaps(const KeyedLines& a, const KeyedLines& b) {
    std::vector<KeyGap> gaps;
    std::vector<IndexPair> pairs = match_sequences(a.keys, b.keys);
    pairs.push_back({a.keys.size(), b.keys.size()});
    IndexPair next;
    for (const IndexPair& pair : pairs) {
        if (pair.a > next.a || pair.b > next.b) gaps.push_back({next.a, pair.a, next.b, pair.b});
        next = {pair.a + 1, pair.b + 1};
    }
    return gaps;
}

}  // namespace trunnion
