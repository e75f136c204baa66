// The layer `words`: a program's blocks with everything taken out that changes nothing.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <optional>

#include "base/alarm.h"
#include "interpreter/block_parser.h"
#include "interpreter/lexical.h"
#include "regression/program_lines.h"

namespace trunnion {

namespace {

/// Modal groups whose repetition changes nothing (the group of motion is 1). Codes are G * 10.
struct ModalCode {
    int code, group;
};
constexpr std::array<ModalCode, 19> modal_codes{{{0, 1},
                                                 {10, 1},
                                                 {20, 1},
                                                 {30, 1},
                                                 {170, 2},
                                                 {180, 2},
                                                 {190, 2},
                                                 {900, 3},
                                                 {910, 3},
                                                 {930, 5},
                                                 {940, 5},
                                                 {950, 5},
                                                 {200, 6},
                                                 {210, 6},
                                                 {400, 7},
                                                 {980, 10},
                                                 {990, 10},
                                                 {640, 15},
                                                 {610, 15}}};

int group_of(int code) {
    for (const ModalCode& m : modal_codes)
        if (m.code == code) return m.group;
    return 0;
}

std::uint64_t bits_of(double value) {
    const double plain = value + 0.0;  // -0 is 0
    std::uint64_t bits = 0;
    std::memcpy(&bits, &plain, sizeof bits);
    return bits;
}

std::uint64_t mix(std::uint64_t h, std::uint64_t n) {
    h = (h ^ n) * 0xBF58476D1CE4E5B9ULL;
    return h ^ (h >> 29);
}

/// Without a point these mean something else (parameter 3401#0).
bool point_counts(char letter) {
    return std::strchr("XYZABCUVWIJKRQ", letter) != nullptr;
}
bool is_position(char letter) {
    return std::strchr("XYZABC", letter) != nullptr;
}

/// The modal state as far as words tell it.
class WordMemory {
  public:
    void forget() { *this = WordMemory{}; }

    /// The block's key, or nothing when all its words repeat what is in force.
    std::optional<std::uint64_t> key_of(const Item* items, std::size_t count) {
        words_.clear();
        bool keeps_positions = true;
        for (std::size_t k = 0; k < count; ++k)
            if (items[k].letter == 'G' && !plain(g_code(items[k]))) keeps_positions = false;
        if (!keeps_positions) position_.fill(std::nullopt);
        for (std::size_t k = 0; k < count; ++k) take(items[k], keeps_positions);
        if (words_.empty()) return std::nullopt;
        std::sort(words_.begin(), words_.end());
        std::uint64_t h = 7;
        for (const auto& [letter, value] : words_)
            h = mix(mix(h, static_cast<std::uint64_t>(letter)), value);
        return h;
    }

  private:
    static int g_code(const Item& item) { return static_cast<int>(std::lround(item.value * 10.0)); }
    /// Blocks with these codes only leave a repeated position a repetition.
    static bool plain(int code) {
        return code == 0 || code == 10 || group_of(code) > 3 || code == 900;
    }

    void take(const Item& item, bool keeps_positions) {
        if (item.letter == 'G') {
            const int group = group_of(g_code(item));
            if (group == 0) group_[1].reset();  // a cycle takes the motion group's place
            if (group > 0 && group_[static_cast<std::size_t>(group)] == g_code(item)) return;
            if (group > 0) group_[static_cast<std::size_t>(group)] = g_code(item);
        }
        const std::uint64_t value = key_of_value(item);
        if (item.letter == 'F' && feed_ == value) return;
        if (item.letter == 'S' && speed_ == value) return;
        if (item.letter == 'F') feed_ = value;
        if (item.letter == 'S') speed_ = value;
        if (is_position(item.letter) && keeps_positions && absolute_straight()) {
            auto& known = position_[static_cast<std::size_t>(item.letter - 'A')];
            if (known == value) return;
            known = value;
        }
        words_.emplace_back(item.letter, value);
    }

    bool absolute_straight() const {
        return group_[3] == 900 && (group_[1] == 0 || group_[1] == 10);
    }

    static std::uint64_t key_of_value(const Item& item) {
        const bool no_point = !item.decimal_point && point_counts(item.letter);
        return mix(bits_of(item.value), no_point ? 1 : 0);
    }

    std::array<std::optional<int>, 16> group_{};
    std::array<std::optional<std::uint64_t>, 26> position_{};
    std::optional<std::uint64_t> feed_, speed_;
    std::vector<std::pair<char, std::uint64_t>> words_;
};

/// The line without blanks and comments, upper case: for blocks that compute.
std::uint64_t key_of_text(std::string_view line, bool keep_number) {
    std::string bare;
    int comment = 0;
    for (const char c : line) {
        if (c == '(')
            ++comment;
        else if (c == ')')
            comment = 0;
        else if (comment == 0 && !is_blank(c) && !is_line_end(c))
            bare += upper(c);
    }
    std::size_t start = 0;
    if (!keep_number && bare.size() > 1 && bare[0] == 'N' && is_digit(bare[1]))
        while (++start < bare.size() && is_digit(bare[start])) {
        }
    return start == bare.size() ? 0 : hash_of(std::string_view(bare).substr(start));
}

bool is_plain(const Block& block, const Code& code) {
    if (block.kind != BlockKind::words) return false;
    for (std::uint32_t k = 0; k < block.items.count; ++k)
        if (code.items[block.items.first + k].kind != ItemKind::word) return false;
    return true;
}

/// Case aside; `word` in upper case.
bool holds(std::string_view text, std::string_view word) {
    return std::search(text.begin(), text.end(), word.begin(), word.end(),
                       [](char a, char b) { return upper(a) == b; }) != text.end();
}

class WordKeys : public LineKeys {
  public:
    WordKeys(std::string_view text, const Dialect& dialect)
        : text_(text), jumps_(holds(text, "GO") || holds(text, "WH") || holds(text, "M99")) {
        options_.dialect = dialect;
        options_.keep_skips = true;
    }

    std::optional<KeyedLine> next() override {
        while (byte_ < text_.size()) {
            const char* const begin = text_.data() + byte_;
            const char* const end = text_.data() + text_.size();
            const char* const line_end = find_line_end(begin, end);
            const char* const after = line_end == end ? end : past_line_end(line_end, end);
            const auto key = key_of({begin, static_cast<std::size_t>(line_end - begin)}, ++number_);
            byte_ += static_cast<std::uint64_t>(after - begin);
            if (key) return KeyedLine{*key, static_cast<std::uint32_t>(number_)};
        }
        return std::nullopt;
    }

  private:
    std::optional<std::uint64_t> key_of(std::string_view line, int number) {
        code_.clear();
        try {
            const Block block = parse_block(text_, byte_, number, options_, code_);
            if (is_plain(block, code_)) return key_of_words(block);
        } catch (const Alarm&) {  // counts as it is written
        }
        memory_.forget();
        const std::uint64_t written = key_of_text(line, jumps_);
        return written != 0 ? std::optional(written) : std::nullopt;
    }

    std::optional<std::uint64_t> key_of_words(const Block& block) {
        const bool numbered = jumps_ && block.sequence_number >= 0;
        const auto number = static_cast<std::uint64_t>(numbered ? block.sequence_number : 0);
        if (block.items.count == 0) return numbered ? std::optional(mix(3, number)) : std::nullopt;
        if (jumps_) memory_.forget();
        const auto key = memory_.key_of(code_.items.data() + block.items.first, block.items.count);
        return key && numbered ? std::optional(mix(*key, number)) : key;
    }

    std::string_view text_;
    /// Where a program jumps, N numbers are targets and what is in force depends on the way taken.
    bool jumps_;
    ParseOptions options_;
    Code code_;
    WordMemory memory_;
    std::uint64_t byte_ = 0;
    int number_ = 0;
};

}  // namespace

std::unique_ptr<LineKeys> word_keys(std::string_view text, const Dialect& dialect) {
    return std::make_unique<WordKeys>(text, dialect);
}

}  // namespace trunnion
