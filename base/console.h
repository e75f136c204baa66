// Standard output, where a failure is an error, and standard error, where a failure is ignored.
#pragma once

#include <fmt/format.h>

#include <string_view>

namespace trunnion::inline base {

/// Appends to standard output. Throws InputError when writing fails.
void write_out(std::string_view text);
/// Flushes standard output to the system. Throws InputError when this fails.
void finish_out();
/// Writes to standard error; failures are ignored.
void write_error(std::string_view text) noexcept;

template <typename... Values>
void print_out(fmt::format_string<Values...> format, Values&&... values) {
    write_out(fmt::format(format, std::forward<Values>(values)...));
}
template <typename... Values>
void print_error(fmt::format_string<Values...> format, Values&&... values) {
    write_error(fmt::format(format, std::forward<Values>(values)...));
}

/// Must be called first in main. Closed standard streams are replaced by streams that fail, so that
/// no user file gets their descriptor number. A closed pipe or a full quota becomes a write error
/// instead of ending the process.
void prepare_streams();

}  // namespace trunnion::inline base
