#include "regression/program_lines.h"

#include <algorithm>

#include "interpreter/lexical.h"

namespace trunnion::regression {

namespace {

constexpr int lines_a_mark = 256;

/// Calls `visit(line, number)` for each line of a text, without line ends.
template <typename Visit>
void each_line(std::string_view text, const Visit& visit) {
    const char* p = text.data();
    const char* const end = p + text.size();
    for (int number = 1; p != end; ++number) {
        const char* const line_end = interpreter::find_line_end(p, end);
        visit(std::string_view(p, static_cast<std::size_t>(line_end - p)), number);
        p = line_end == end ? end : interpreter::past_line_end(line_end, end);
    }
}

std::string_view without_trailing_blanks(std::string_view line) {
    while (!line.empty() && interpreter::is_blank(line.back())) line.remove_suffix(1);
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
        p = interpreter::past_line_end(interpreter::find_line_end(p, end), end);
    const char* const line_end = interpreter::find_line_end(p, end);
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

namespace {

class TextKeys : public LineKeys {
  public:
    explicit TextKeys(std::string_view text) : text_(text) {
        while (!text_.empty() &&
               (interpreter::is_blank(text_.back()) || interpreter::is_line_end(text_.back())))
            text_.remove_suffix(1);
    }
    std::optional<KeyedLine> next() override {
        if (at_ >= text_.size()) return std::nullopt;
        const char* const begin = text_.data() + at_;
        const char* const end = text_.data() + text_.size();
        const char* const line_end = interpreter::find_line_end(begin, end);
        const char* const after = line_end == end ? end : interpreter::past_line_end(line_end, end);
        at_ += static_cast<std::size_t>(after - begin);
        const std::string_view line(begin, static_cast<std::size_t>(line_end - begin));
        return KeyedLine{hash_of(without_trailing_blanks(line)), ++number_};
    }

  private:
    std::string_view text_;
    std::size_t at_ = 0;
    std::uint32_t number_ = 0;
};

}  // namespace

std::unique_ptr<LineKeys> text_keys(std::string_view text) {
    return std::make_unique<TextKeys>(text);
}

bool same_keys(LineKeys& a, LineKeys& b, std::uint64_t& compared) {
    for (compared = 0;; ++compared) {
        const auto p = a.next(), q = b.next();
        if (!p || !q) return !p && !q;
        if (p->key != q->key) return false;
    }
}

bool same_keys(const KeyedLines& a, const KeyedLines& b, std::uint64_t& compared) {
    SpilledWindow<KeyedLine> p(a), q(b);
    const std::uint64_t count = std::min(a.size(), b.size());
    for (compared = 0; compared < count; ++compared)
        if (p[compared].key != q[compared].key) return false;
    return a.size() == b.size();
}

KeyedLines all_keys(LineKeys& keys) {
    KeyedLines all;
    while (const auto key = keys.next()) all.append(*key);
    return all;
}

void key_gaps(const KeyedLines& a, const KeyedLines& b,
              const std::function<void(const KeyGap&)>& found) {
    SpilledWindow<KeyedLine> p(a), q(b);
    const auto keys_in = [](SpilledWindow<KeyedLine>& lines, const PassRanges& ranges, Keys& keys) {
        keys.clear();
        for (const PassRange& range : ranges)
            for (std::uint64_t k = range.first; k < range.last; ++k) keys.push_back(lines[k].key);
    };
    const AlignSource source{
        a.size(), b.size(), [&](std::uint64_t i, std::uint64_t j) { return p[i].key == q[j].key; },
        [&](const PassRanges& in_a, const PassRanges& in_b, Keys& keys_a, Keys& keys_b) {
            keys_in(p, in_a, keys_a);
            keys_in(q, in_b, keys_b);
        }};
    AlignLimits limits;
    limits.reordering = false;
    limits.most_window = 1U << 16U;  // for two unlike texts memory does not grow with their length
    align(source, limits, [&](const PassPair& pair) {
        if (pair.pairing != Pairing::same)
            found({pair.a.first, pair.a.last, pair.b.first, pair.b.last});
    });
}

}  // namespace trunnion::regression
