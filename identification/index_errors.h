// The index of the axis that carries the line of sight of a telescope.
#pragma once

#include <string>
#include <vector>

#include "emulator/replay.h"

namespace trunnion::identification {

/// Name of the effect `R.zero` of the first axis of a chain of two rotary axes alone, which carry a
/// line of sight; empty for any other machine.
std::string index_effect(const setup::Setup& setup);

/// The setup with `R.zero` of the first axis as part of what is modelled, where a chain of two
/// rotary axes alone is read by angles: what its encoder counts from is set-up, as that of the
/// second axis is (the zero of its test), but is read times the cosine of the second angle.
setup::Setup with_index_errors(setup::Setup setup, const records::ReadingTable& table);

/// A sentence for such a zero in a fitted setup, if it is not 0: the value of the effect, its sign
/// that of `offset_rad`.
std::vector<std::string> index_words(const setup::Setup& fitted);

}  // namespace trunnion::identification
