#include "interpreter/arguments.h"

#include <cstring>

#include "interpreter/alarms.h"

namespace trunnion::interpreter {
namespace {

/// Local variable number of A to Z; 0: passes no argument (I, J, K are counted, see below).
constexpr std::array<signed char, 26> variable_of{1, 2, 3, 7,  8,  9,  0,  11, 4,  5,  6,  0,  13,
                                                  0, 0, 0, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26};
/// Additional arguments of G66.1.
constexpr int extra_variable(char letter) {
    return letter == 'G' ? 10 : letter == 'L' ? 12 : letter == 'N' ? 14 : letter == 'P' ? 16 : 0;
}

bool holds_position(char letter) {
    return std::strchr("ABCIJKQRUVWXYZ", letter) != nullptr;
}

double argument_value(const WordValue& word, const ArgumentRules& rules) {
    const bool scaled =
        !word.decimal_point && !rules.whole_numbers_as_written && holds_position(word.letter);
    if (word.vacant) return vacant;
    return scaled ? word.value / rules.increments_per_unit : word.value;
}

}  // namespace

void pass_arguments(const WordValue* first, const WordValue* last, const ArgumentRules& rules,
                    Locals& locals) {
    locals.fill(vacant);
    int set = 0;        // of I J K, from 0
    char previous = 0;  // previous letter of this set
    for (const WordValue* word = first; word != last; ++word) {
        const char letter = word->letter;
        if (letter < 'A' || letter > 'Z') raise_language_alarm(129, word->column);
        int number = variable_of[static_cast<std::size_t>(letter - 'A')];
        if (number == 0 && rules.pass_all) number = extra_variable(letter);
        if (number == 0) raise_language_alarm(129, word->column, std::string(1, letter));
        if (letter >= 'I' && letter <= 'K') {
            if (previous != 0 && letter <= previous) ++set;
            previous = letter;
            if (set == 10) raise_language_alarm(1095, word->column);
            number += 3 * set;
        }
        locals[static_cast<std::size_t>(number)] = argument_value(*word, rules);
    }
}

SubprogramCall unpack_subprogram(int p, int l, bool packed) {
    if (l >= 0 || !packed || p < 10000) return {p, l >= 0 ? l : 1};
    return {p % 10000, p / 10000};
}

}  // namespace trunnion::interpreter
