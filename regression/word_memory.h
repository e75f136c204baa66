// The active state as far as the words of a program determine it, to detect repeated words.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "interpreter/code.h"

namespace trunnion::regression {

/// Where the words do not determine the state, nothing counts as repeated.
class WordMemory {
  public:
    /// At power-on: G40, G94, G97 (independent of parameters).
    WordMemory();

    /// Forgets everything, including whether a macro is called with each move.
    void forget();
    void forget_positions() { position_.fill(std::nullopt); }

    /// The key of a block of plain words; empty when all of them repeat the active state.
    std::optional<std::uint64_t> key_of(const interpreter::Item* items, std::size_t count);

    struct BlockLook;

  private:
    struct Word {
        char letter;
        std::uint64_t value;
    };
    void forget_values();
    void take_g(const interpreter::Item& item, const BlockLook& look);
    void take(const interpreter::Item& item, const BlockLook& look);
    bool repeats(char letter, std::uint64_t value, const BlockLook& look);
    bool per_minute() const;
    bool absolute_straight() const;
    std::uint64_t hash(const BlockLook& look, const interpreter::Item* items, std::size_t count);

    std::array<std::optional<int>, 16> group_{};  ///< code * 10 by modal group
    std::array<std::optional<std::uint64_t>, 26> position_{};
    std::optional<std::uint64_t> feed_, speed_;
    bool modal_call_ = false;  ///< G66, G16, or unknown: a move of zero length has an effect
    std::vector<Word> words_;
};

}  // namespace trunnion::regression
