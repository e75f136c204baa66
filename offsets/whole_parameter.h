// Parameters that are counts, numbers or bits.
#pragma once

namespace trunnion::offsets {

/// The value as a whole number; 0 for one beyond nine digits, which no control holds but a file may
/// (the conversion of such a number is undefined).
constexpr int whole_parameter(double value) {
    return value > -1e9 && value < 1e9 ? static_cast<int>(value) : 0;
}
/// The same as bits, of a negative value as the control's memory would hold it.
constexpr unsigned bits_of_parameter(double value) {
    return static_cast<unsigned>(whole_parameter(value));
}

}  // namespace trunnion::offsets
