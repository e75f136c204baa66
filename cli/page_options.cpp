#include "cli/page_options.h"

#include <fmt/chrono.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <ctime>

#include "base/numbers.h"
#include "base/read_file.h"
#include "cli/options.h"

namespace trunnion::cli {
namespace {

/// Quotes a word with single quotes where a shell requires it.
std::string shell_word(const std::string& word) {
    constexpr const char* plain =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./,:@%";
    if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
    std::string out = "'";
    for (const char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return out + "'";
}

std::string date_of_build() {
    const char* epoch = std::getenv("SOURCE_DATE_EPOCH");
    const auto seconds = epoch ? parse_number(epoch) : std::nullopt;
    if (!seconds || *seconds < 0.0 || *seconds > 253402300799.0) return "";
    return fmt::format("{:%Y-%m-%d}", fmt::gmtime(static_cast<std::time_t>(*seconds)));
}

}  // namespace

void add_page_options(CLI::App& command, PageOptions& options) {
    writes_file(command.add_option("--html", options.html, "write the result as one HTML page"));
    command.add_option("--date", options.date, "date in the footer of the page (none)");
}

std::string command_text(const CLI::App& command) {
    std::string text = "trunnion " + command.get_name();
    for (const CLI::Option* option : command.get_options()) {
        if (option->count() == 0) continue;
        const std::string name = option->get_positional() ? "" : option->get_name();
        if (option->get_expected_max() == 0) {
            text += ' ' + name;
            continue;
        }
        for (const std::string& value : option->results())
            text += (name.empty() ? "" : ' ' + name) + ' ' + shell_word(value);
    }
    return text;
}

report::PageOrigin page_origin(const CLI::App& command, const PageOptions& options) {
    report::PageOrigin origin;
    origin.command = command_text(command);
    origin.version = TRUNNION_VERSION;
    origin.date = options.date.empty() ? date_of_build() : options.date;
    origin.inputs = ReadRecord::files();
    return origin;
}

std::string finished_page(report::Page page, const CLI::App& command, const PageOptions& options) {
    const std::optional<std::uint64_t> seed = page.origin.seed;
    page.origin = page_origin(command, options);
    page.origin.seed = seed;
    return report::page_html(page);
}

}  // namespace trunnion::cli
