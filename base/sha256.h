// SHA-256 of a text, to identify the input file of a result; same digits as sha256sum.
#pragma once

#include <string>
#include <string_view>

namespace trunnion::inline base {

/// 64 digits, lower case (FIPS 180-4).
std::string sha256(std::string_view text);

}  // namespace trunnion::inline base
