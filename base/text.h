// Text of unknown origin made fit for a screen or a report.
#pragma once

#include <string>
#include <string_view>

namespace trunnion::inline base {

/// Bytes that are not UTF-8 (comments of old controls) become '?': JSON and XML take nothing else.
std::string valid_utf8(std::string_view text);
/// The same, and control characters but the tab: nothing that a terminal would obey.
std::string printable(std::string_view text);
/// Places that valid UTF-8 takes on a screen.
std::size_t screen_width(std::string_view text);

}  // namespace trunnion::inline base
