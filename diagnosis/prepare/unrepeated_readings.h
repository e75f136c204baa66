// Readings of a laser test that the other readings at their places refute
// (unrepeated_readings.cpp).
#pragma once

#include "diagnosis/prepare/prepare.h"

namespace trunnion::diagnosis {

/// Readings far from the median of those at the same target from the same side, beside the zeros
/// of the cycles; device rows, ascending. Of two readings nothing tells which is spoiled: both are
/// listed, and the good one fits the model that is found without them. Empty where they are more
/// than a fifth or follow one another: that is the machine.
std::vector<std::size_t> unrepeated_readings(const Prepared& prepared,
                                             const std::vector<bool>& used);

}  // namespace trunnion::diagnosis
