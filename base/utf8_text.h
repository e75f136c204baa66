// Text files as editors and spreadsheets save them.
#pragma once

#include <string>
#include <string_view>

namespace trunnion::inline base {

/// True if a byte order mark says so.
bool is_utf16(std::string_view bytes);

/// The text of a file without its byte order mark, converted from UTF-16 if the mark says so.
/// Throws InputError for UTF-16 that ends within a character.
std::string utf8_of(const std::string& bytes, const std::string& path);

}  // namespace trunnion::inline base
