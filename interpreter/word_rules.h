// What a word may hold, by the code of its block: one table for the language, the control and
// check.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "interpreter/block_words.h"
#include "interpreter/dialect.h"

namespace trunnion::interpreter {

/// A value that breaks the rule is PS0007 (no whole number), PS0006 (a minus sign), `out_of_range`,
/// or `missing` when the word is absent.
struct WordRule {
    char code_letter;     ///< G or M; 0: in every block that passes no arguments
    int code10;           ///< of that code, times 10
    char letter;          ///< the word
    bool whole = true;    ///< else a decimal fraction may stand
    bool no_sign = true;  ///< not below 0
    double most = 99999999.0;
    double least = 0.0;
    int out_of_range = 3;  ///< alarm
    int missing = 0;       ///< alarm; 0: the word may be absent
};
std::span<const WordRule> word_rules();

struct WordFault {
    int alarm = 0;
    int column = 0;      ///< from 1; 0: the word is missing
    std::string detail;  ///< "(G54.1: P is 1 to 300)", or nothing
};

/// The first word of a block, as written, that breaks a rule. Blocks with G65, G66 or G66.1 pass
/// arguments: only P and L of the call have rules. Vacant words count as absent; the `<` of a
/// called name stands for P. `all_known`: false when some words of the block are not in `block`, so
/// that none counts as missing.
/// `family`: a Hurco counts P of G4 and of cycles in seconds, and its G68.2 knows no P and Q.
std::optional<WordFault> find_word_fault(const BlockWords& block, DialectFamily family,
                                         bool all_known = true);

/// A code number: whole and not below 0, or PS0007, PS0006.
std::optional<WordFault> find_m_fault(const WordValue& m_word);

}  // namespace trunnion::interpreter
