// The layer `words`: the blocks of a program without everything that has no effect.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <optional>

#include "base/alarm.h"
#include "interpreter/block_parser.h"
#include "interpreter/lexical.h"
#include "regression/program_lines.h"
#include "regression/word_memory.h"

namespace trunnion::regression {

namespace {

/// Ignores case; `word` in upper case.
bool holds(std::string_view text, std::string_view word) {
    return std::search(text.begin(), text.end(), word.begin(), word.end(),
                       [](char a, char b) { return interpreter::upper(a) == b; }) != text.end();
}

/// The line without blanks and comments, in upper case: for blocks with computed values.
std::uint64_t key_of_text(std::string_view line, bool keep_number) {
    std::string bare;
    bool comment = false;
    const bool prints = holds(line, "PRNT");  // blanks and case are printed there
    for (const char c : line) {
        if (prints)
            bare += c;
        else if (c == '(' || c == ')')
            comment = c == '(';
        else if (!comment && !interpreter::is_blank(c))
            bare += interpreter::upper(c);
    }
    std::size_t start = 0;
    if (!keep_number && bare.size() > 1 && bare[0] == 'N' && interpreter::is_digit(bare[1]))
        while (++start < bare.size() && interpreter::is_digit(bare[start])) {
        }
    return start == bare.size() ? 0 : hash_of(std::string_view(bare).substr(start));
}

std::uint64_t with_number(std::uint64_t key, std::uint64_t number) {
    return (key ^ (number + 1)) * 0xBF58476D1CE4E5B9ULL;
}

bool is_plain(const interpreter::Block& block, const interpreter::Code& code) {
    if (block.kind != interpreter::BlockKind::words) return false;
    for (std::uint32_t k = 0; k < block.items.count; ++k) {
        const interpreter::Item& item = code.items[block.items.first + k];
        if (item.kind != interpreter::ItemKind::word || item.letter == '<') return false;
    }
    return true;
}

/// True for G10 with data lines that start with an N word (L3, L50, L52), also in doubt.
bool begins_table(const interpreter::Item* items, std::size_t count) {
    bool g10 = false, other = true;
    for (std::size_t k = 0; k < count; ++k) {
        if (items[k].letter == 'G' && items[k].value == 10.0) g10 = true;
        if (items[k].letter != 'L') continue;
        const double l = items[k].value;
        other = l != 2.0 && l != 20.0 && (l < 10.0 || l > 13.0);
    }
    return g10 && other;
}

class WordKeys : public LineKeys {
  public:
    WordKeys(std::string_view text, const interpreter::Dialect& dialect, bool codes_call)
        : text_(text),
          codes_call_(codes_call),
          jumps_(holds(text, "GO") || holds(text, "WH") || holds(text, "M99")) {
        options_.dialect = dialect;
        options_.keep_skips = true;
    }

    std::optional<KeyedLine> next() override {
        while (byte_ < text_.size()) {
            const char* const begin = text_.data() + byte_;
            const char* const end = text_.data() + text_.size();
            const char* const line_end = interpreter::find_line_end(begin, end);
            const char* const after =
                line_end == end ? end : interpreter::past_line_end(line_end, end);
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
            const interpreter::Block block =
                interpreter::parse_block(text_, byte_, number, options_, code_);
            if (is_plain(block, code_)) return key_of_words(block);
            forget_by(block);
        } catch (const Alarm&) {  // nothing of it may be passed over: it stops the program
            memory_.forget();
            return hash_of(line);
        }
        const std::uint64_t written = key_of_text(line, jumps_ || in_table_);
        return written != 0 ? std::optional(written) : std::nullopt;
    }

    /// A statement may write offsets; a computed or optional block may change anything.
    void forget_by(const interpreter::Block& block) {
        if (block.kind == interpreter::BlockKind::statements)
            memory_.forget_positions();
        else if (block.items.count > 0)
            memory_.forget();
    }

    std::optional<std::uint64_t> key_of_words(const interpreter::Block& block) {
        const interpreter::Item* const items = code_.items.data() + block.items.first;
        const bool numbered = (jumps_ || in_table_) && block.sequence_number >= 0;
        const auto number = static_cast<std::uint64_t>(numbered ? block.sequence_number : 0);
        if (block.items.count == 0)
            return numbered ? std::optional(with_number(3, number)) : std::nullopt;
        if (begins_table(items, block.items.count)) in_table_ = true;
        if (jumps_ || in_table_ || codes_call_) memory_.forget();
        for (std::size_t k = 0; k < block.items.count; ++k)
            if (items[k].letter == 'G' && items[k].value == 11.0) in_table_ = false;
        const auto key = memory_.key_of(items, block.items.count);
        return key && numbered ? std::optional(with_number(*key, number)) : key;
    }

    std::string_view text_;
    bool codes_call_;        ///< G, M or T codes call programs by parameter
    bool in_table_ = false;  ///< between G10 L50 and G11 N numbers are data
    /// In a program with jumps N numbers are targets, and the active state depends on the path
    /// taken.
    bool jumps_;
    interpreter::ParseOptions options_;
    interpreter::Code code_;
    WordMemory memory_;
    std::uint64_t byte_ = 0;
    int number_ = 0;
};

}  // namespace

std::unique_ptr<LineKeys> word_keys(std::string_view text, const interpreter::Dialect& dialect,
                                    bool codes_call) {
    return std::make_unique<WordKeys>(text, dialect, codes_call);
}

}  // namespace trunnion::regression
