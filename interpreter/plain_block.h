// The inner loop: reads a block of plain words (letters with numbers) from the text in one pass.
#pragma once

#include <array>

#include "interpreter/block_words.h"
#include "interpreter/lexical.h"

namespace trunnion::interpreter {

/// Codes that the language itself executes: calls, returns, G10 L85.
struct SpecialCodes {
    std::array<bool, 10000> g{};  ///< by G code * 10
    std::array<bool, 1000> m{};
    bool large_m = false;  ///< an M code above 999 calls a program
    bool t = false;

    bool has(char letter, double value) const {
        if (letter == 'G') {
            if (!(value >= 0.0 && value < 999.9)) return false;
            return g[static_cast<std::size_t>(value * 10.0 + 0.5)];
        }
        if (letter == 'M') {
            if (!(value >= 0.0 && value < 999.4)) return large_m;
            return m[static_cast<std::size_t>(value + 0.5)];
        }
        return letter == 'T' && t;
    }
};

/// Reads the block at `p` into `out` if it has only blanks, comments, N and words with numbers, and
/// no special code. Then moves `p` to the next block and returns true. Otherwise `p` is unchanged
/// and the full parser must be used.
inline bool read_plain_block(const char*& p, const char* end, const SpecialCodes& special,
                             BlockWords& out) {
    const char* const first = p;
    const char* at = p;
    std::size_t count = 0;
    out.sequence_number = -1;
    while (at != end) {
        const char c = *at;
        if (is_blank(c)) {
            ++at;
            continue;
        }
        if (is_letter(c)) {
            const char letter = upper(c);
            const auto column = static_cast<std::uint16_t>(at - first + 1);
            if (letter == 'O' || count == BlockWords::capacity || at - first > 60000) return false;
            at = skip_blanks(at + 1, end);
            if (at == end) return false;
            const bool negative = *at == '-';
            if (negative || *at == '+') at = skip_blanks(at + 1, end);
            const Number number = read_number(at, end);
            if (number.digits == 0 || number.digits > 15) return false;
            if (letter == 'N' && count == 0 && out.sequence_number < 0) {
                if (number.point || number.digits > 9 || negative) return false;
                out.sequence_number = static_cast<int>(number.value);
                continue;
            }
            if ((letter == 'G' || letter == 'M' || letter == 'T') &&
                special.has(letter, number.value))
                return false;
            WordValue& word = out.words[count++];
            word.value = negative ? -number.value : number.value;
            word.letter = letter;
            word.decimal_point = number.point;
            word.vacant = false;
            word.column = column;
            word.computed = false;
            continue;
        }
        if (is_line_end(c)) {
            at = past_line_end(at, end);
            break;
        }
        if (c != '(') return false;
        do {
            if (++at == end || is_line_end(*at) || *at == control_z || *at == '(') return false;
        } while (*at != ')');
        ++at;
    }
    if (at == first) return false;
    out.count = count;
    p = at;
    return true;
}

}  // namespace trunnion::interpreter
