// Standard output, whose failure is an error, and standard error, whose failure nobody can be told.
#pragma once

#include <fmt/format.h>

#include <string_view>

namespace trunnion::inline base {

/// Appends to standard output. Throws InputError when it cannot be written.
void write_out(std::string_view text);
/// What was written so far has reached the system. Throws InputError when it has not.
void finish_out();
/// Writes to standard error; a failure is passed over.
void write_error(std::string_view text) noexcept;

template <typename... Values>
void print_out(fmt::format_string<Values...> format, Values&&... values) {
    write_out(fmt::format(format, std::forward<Values>(values)...));
}
template <typename... Values>
void print_error(fmt::format_string<Values...> format, Values&&... values) {
    write_error(fmt::format(format, std::forward<Values>(values)...));
}

/// To be called first in main: closed standard streams are taken by streams that fail, so that no
/// file of the user gets their number, and a closed pipe or a full quota is an error of the write
/// instead of the end of the process.
void prepare_streams();

}  // namespace trunnion::inline base
