// What a terminal can show: characters beyond ASCII, colour.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace trunnion::inline base {

struct Screen {
    bool utf8 = true;     ///< by LC_ALL, LC_CTYPE, LANG
    bool colour = false;  ///< never with NO_COLOR or on a terminal that is "dumb"
};

/// The terminal behind a descriptor. Nothing for a file or a pipe: these get the bytes as they are,
/// UTF-8 and without colour.
std::optional<Screen> screen_of(int descriptor);

/// The text as this terminal shows it: "um" and "+-" where it has no UTF-8; the words "error:",
/// "warning:" and "verdict:" marked where it has colour.
std::string for_screen(std::string_view text, Screen screen);

}  // namespace trunnion::inline base
