// The SHA-256 of a text: says which file a result came from; the same digits as sha256sum prints.
#pragma once

#include <string>
#include <string_view>

namespace trunnion::inline base {

/// 64 digits, lower case (FIPS 180-4).
std::string sha256(std::string_view text);

}  // namespace trunnion::inline base
