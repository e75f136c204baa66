// Text files as editors and spreadsheets save them.
#pragma once

#include <string>

namespace trunnion::inline base {

/// The text of a file without its byte order mark, converted from UTF-16 if the mark says so.
/// Throws InputError for UTF-16 that ends within a character.
std::string utf8_of(const std::string& bytes, const std::string& path);

}  // namespace trunnion::inline base
