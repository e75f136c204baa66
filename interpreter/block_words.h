// The interface from the language to the control: the words of one block with their values.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace trunnion::interpreter {

/// A word with its evaluated expression.
struct WordValue {
    double value = 0.0;
    char letter = 0;            ///< upper case
    bool decimal_point = true;  ///< false: written as an integer without point, so that parameter
                                ///< 3401#0 and the increment system define its unit; variables
                                ///< count as true
    bool vacant = false;        ///< `X#1` with #1 vacant: the control ignores the word
    std::uint16_t column = 0;   ///< of the letter, from 1
    bool computed = false;      ///< `X#1`, `X[..]`: of a variable or an expression
};

/// The words of one block in written order, without N, O, macro statements and comments. A comma
/// word (`,R2.` `,C1.`) has the lower-case letter 'r' or 'c'.
struct BlockWords {
    static constexpr std::size_t capacity = 48;  ///< more words raise an alarm

    std::array<WordValue, capacity> words;
    std::size_t count = 0;
    int sequence_number = -1;  ///< N, or -1
    int line = 0;              ///< from 1, in the program's file
    std::uint64_t byte = 0;    ///< where the block starts in the file

    const WordValue* begin() const { return words.data(); }
    const WordValue* end() const { return words.data() + count; }
};

}  // namespace trunnion::interpreter
