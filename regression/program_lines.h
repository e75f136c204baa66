// The lines of a program: shown in reports, and the layers that compare what is written.
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

/// Finds lines of a text by number without keeping where each one starts.
class ProgramLines {
  public:
    explicit ProgramLines(std::string_view text);
    /// Line `number` (from 1) without its end and trailing blanks; control characters become '?'.
    /// Empty beyond the end.
    std::string line(int number) const;
    int count() const { return count_; }

  private:
    std::string_view text_;
    std::vector<std::size_t> starts_;  ///< of every 256th line
    int count_ = 0;
};

/// What a layer compares: one key for each line or move that counts, and the source line it is
/// from. On disk, as paths are.
struct KeyedLine {
    std::uint64_t key = 0;
    std::uint32_t line = 0;
};
using KeyedLines = SpilledArray<KeyedLine>;

/// Gives the keys of a text one by one.
class LineKeys {
  public:
    virtual ~LineKeys() = default;
    /// The next key, or nothing at the end.
    virtual std::optional<KeyedLine> next() = 0;
};

/// Layer `text`: lines without their ends and trailing blanks; empty lines at the end do not count.
std::unique_ptr<LineKeys> text_keys(std::string_view text);

/// Layer `words`: each block as the control reads it. N numbers (unless the program jumps), blanks,
/// comments, the way a number is written, the order of words and repeated modal words (G codes, F,
/// S, positions) do not count. A line that cannot be read counts as it is written.
/// With `codes_call` any G, M or T code may call a program, so nothing is a repetition.
std::unique_ptr<LineKeys> word_keys(std::string_view text, const interpreter::Dialect& dialect,
                                    bool codes_call = false);

/// Stops at the first that differs, and keeps none; `compared`: how many were looked at.
bool same_keys(LineKeys& a, LineKeys& b, std::uint64_t& compared);
bool same_keys(const KeyedLines& a, const KeyedLines& b, std::uint64_t& compared);
KeyedLines all_keys(LineKeys& keys);

/// A stretch of keys that differs.
struct KeyGap {
    std::uint64_t a_first = 0, a_last = 0, b_first = 0, b_last = 0;
};
/// Aligns both sides and calls `found` with what stands between the matches.
void key_gaps(const KeyedLines& a, const KeyedLines& b,
              const std::function<void(const KeyGap&)>& found);

/// FNV-1a, 64 bits, mixed at the end: the same on every machine.
std::uint64_t hash_of(std::string_view text, std::uint64_t seed = 0xCBF29CE484222325ULL);

}  // namespace trunnion::regression
