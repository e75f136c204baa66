// The lines of a program: for reports, and for the layers that compare text (word_keys.cpp).
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "interpreter/dialect.h"
#include "regression/align.h"
#include "regression/comparison.h"
#include "regression/spilled_array.h"

namespace trunnion::regression {

/// Finds lines of a text by number without storing the start of each one.
class ProgramLines {
  public:
    explicit ProgramLines(std::string_view text);
    /// Line `number` (from 1) without its end and trailing blanks; control characters become '?'.
    /// Empty after the last line.
    std::string line(int number) const;
    int count() const { return count_; }

  private:
    std::string_view text_;
    std::vector<std::size_t> starts_;  ///< of every 256th line
    int count_ = 0;
};

/// Unit of comparison of a layer: a key for each relevant line or move, with its source line.
/// Stored on disk like paths.
struct KeyedLine {
    std::uint64_t key = 0;
    std::uint32_t line = 0;
};
using KeyedLines = SpilledArray<KeyedLine>;

/// Produces the keys of a text one by one.
class LineKeys {
  public:
    virtual ~LineKeys() = default;
    /// The next key; empty at the end.
    virtual std::optional<KeyedLine> next() = 0;
};

/// Layer `text`: lines without line ends and trailing blanks; empty lines at the end are ignored.
std::unique_ptr<LineKeys> text_keys(std::string_view text);

/// Layer `words`: each block as the control reads it. Ignored are N numbers (unless the program
/// jumps), blanks, comments, number formats, the order of words, and repeated modal words (G codes,
/// F, S, positions). A line that cannot be parsed is compared as written. With `codes_call` any G,
/// M or T code may call a program, so no word counts as repeated.
std::unique_ptr<LineKeys> word_keys(std::string_view text, const interpreter::Dialect& dialect,
                                    bool codes_call = false);

/// Stops at the first difference and stores none; `compared`: number of keys compared.
bool same_keys(LineKeys& a, LineKeys& b, std::uint64_t& compared);
bool same_keys(const KeyedLines& a, const KeyedLines& b, std::uint64_t& compared);
KeyedLines all_keys(LineKeys& keys);

/// A range of keys that differ.
struct KeyGap {
    std::uint64_t a_first = 0, a_last = 0, b_first = 0, b_last = 0;
};
/// Aligns both sides and calls `found` with the ranges between matches.
void key_gaps(const KeyedLines& a, const KeyedLines& b,
              const std::function<void(const KeyGap&)>& found);

/// FNV-1a, 64 bits, with final mixing: the same on every machine.
std::uint64_t hash_of(std::string_view text, std::uint64_t seed = 0xCBF29CE484222325ULL);

}  // namespace trunnion::regression
