// Sanitises text of unknown origin for a screen or a report.
#pragma once

#include <string>
#include <string_view>

namespace trunnion::inline base {

/// Replaces bytes that are not UTF-8 (comments of old controls) by '?', because JSON and XML
/// require UTF-8.
std::string valid_utf8(std::string_view text);
/// The same, and also replaces control characters except tab, so that a terminal cannot interpret
/// them.
std::string printable(std::string_view text);
/// Number of screen columns of valid UTF-8.
std::size_t screen_width(std::string_view text);

}  // namespace trunnion::inline base
