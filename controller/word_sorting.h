// Sorts the words of a block by letter and looks up its G and M codes.
#pragma once

#include "controller/modal.h"
#include "interpreter/block_words.h"

namespace trunnion::controller {

/// Bit of a phase in SortedWords::phases.
constexpr std::uint32_t phase_bit(Phase phase) {
    return 1U << static_cast<unsigned>(phase);
}

/// Two codes of one group: the last one counts, or PS5074 by 3403#6. Throws PS0003 for a value with
/// too many digits, PS0009 for an address that the control does not have, PS0010 for an unknown G
/// code.
void sort_words(const interpreter::BlockWords& block, const Modal& modal, SortedWords& words);

}  // namespace trunnion::controller
