// Allowed values of words by the codes of their block: one table for language, control and check.
#pragma once

#include <optional>
#include <string>

#include "interpreter/block_words.h"
#include "interpreter/dialect.h"

namespace trunnion::interpreter {

struct WordFault {
    int alarm = 0;
    int column = 0;      ///< from 1; 0: the word is missing
    std::string detail;  ///< "(G54.1: P is 1 to 300)", or empty
};

/// The first word of a block, in written order, that violates a rule. In blocks with G65, G66 or
/// G66.1 only P and L of the call have rules, because the other words are arguments; G65 of custom
/// macro A is refused. Vacant words count as absent; `<` of a called name replaces P. `all_known`:
/// false when `block` lacks some words of the written block, or has them vacant because their value
/// is unknown, so that none counts as missing. `family`: on a Hurco P of G4 and of cycles is in
/// seconds, and G68.2 has no P and Q.
std::optional<WordFault> find_word_fault(const BlockWords& block, DialectFamily family,
                                         bool all_known = true);

/// G65, G66 or G66.1: the words behind it are arguments.
bool is_macro_call(const WordValue& word);

/// True for what the rules take as an integer: P2.0000001 is 2.
bool is_whole(double value);

/// A code number must be an integer >= 0: else PS0007, PS0006.
std::optional<WordFault> find_m_fault(const WordValue& m_word);

}  // namespace trunnion::interpreter
