// The DPRNT output of a measuring program, line by line.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "geometry/pose.h"

namespace trunnion::imports {

/// One line with its position.
struct PrintedLine {
    std::string_view text;  ///< trimmed
    int number = 0;
    std::string_view path;

    [[noreturn]] void fail(const std::string& message, std::size_t column = 0) const;
    /// The text up to the first blank.
    std::string_view word() const;
    /// Number after a letter that follows a blank. DPRNT prints the sign first and blanks for
    /// leading zeros: "B-  90.0000". Throws InputError when it is missing or not finite.
    double number_behind(char letter) const;
    Vector3 vector_behind(std::string_view three_letters) const;
};

/// Removes and returns the next line of `text`; empty at its end. Skips empty lines, `%` and the
/// control characters of a serial line. `number` counts all lines.
std::optional<PrintedLine> next_line(std::string_view& text, int& number, std::string_view path);

}  // namespace trunnion::imports
