// G10: work offsets, tool offsets, fixture offsets and parameters set by the program.
#pragma once

#include <cstdint>

#include "controller/mover.h"
#include "interpreter/block_words.h"

namespace trunnion::controller {

/// Meaning of the blocks between G10 L3, L50, L52 and G11.
enum class DataEntry : std::uint8_t { none, parameters, tool_life };

/// G10. Work and fixture offsets act immediately. Returns the kind of data blocks that follow.
/// PS0010 for an unknown L, PS0031 for an invalid P, PS0032 for an invalid R.
DataEntry set_data(const SortedWords& words, const Modal& modal, Frames& frames, Mover& mover);
/// One data block of parameters: N is the number, P the axis, R the value (a byte for bit
/// parameters). The caller must decode the parameters again. PS0231 when N or R is missing.
void enter_parameter(const SortedWords& words, int sequence_number,
                     offsets::Parameters& parameters);

}  // namespace trunnion::controller
