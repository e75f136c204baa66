// What a measuring program printed by DPRNT, line by line.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "geometry/pose.h"

namespace trunnion::imports {

/// One line with its place.
struct PrintedLine {
    std::string_view text;  ///< without blanks around it
    int number = 0;
    std::string_view path;

    [[noreturn]] void fail(const std::string& message, std::size_t column = 0) const;
    /// Up to the first blank.
    std::string_view word() const;
    /// Number behind a letter that follows a blank. DPRNT writes the sign first and blanks for
    /// leading zeros: "B-  90.0000". Throws InputError when it is missing or no finite number.
    double number_behind(char letter) const;
    Vector3 vector_behind(std::string_view three_letters) const;
};

/// Takes the next line off `text`; nullopt at its end. Empty lines, `%` and the control characters
/// of a serial line are passed over. `number` counts all lines.
std::optional<PrintedLine> next_line(std::string_view& text, int& number, std::string_view path);

}  // namespace trunnion::imports
