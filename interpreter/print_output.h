// Output of DPRNT and BPRNT for one value.
#pragma once

#include <string>

namespace trunnion::interpreter {

/// DPRNT #v[ab]: sign (blank for +), `integers` digits padded with leading blanks, point, and
/// `decimals` digits; higher digits are cut off. With `suppress_zeros` (parameter 6001#1 PRT = 1)
/// no blanks are printed. Vacant prints as 0.
std::string decimal_print(double value, int integers, int decimals, bool suppress_zeros);

/// BPRNT #v[d]: value * 10^d as four bytes, most significant first. Alarm 110 beyond 32 bits.
std::string binary_print(double value, int decimals);

}  // namespace trunnion::interpreter
