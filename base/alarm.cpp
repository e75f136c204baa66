#include "base/alarm.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/text.h"

namespace trunnion::inline base {

namespace {

constexpr std::size_t widest = 200;    ///< a longer line is cut around its column
constexpr std::size_t longest = 1000;  ///< maximum length of a message, which may quote a binary
                                       ///< file

/// The line, with the caret under its column; tabs are kept so that both align.
std::string marked_line(std::string_view line, int column) {
    std::string out;
    std::size_t at = column > 0 ? static_cast<std::size_t>(column - 1) : 0;
    if (line.size() > widest) {
        const std::size_t start = at > widest / 2 ? std::min(at - widest / 2, line.size()) : 0;
        at -= start;
        line = line.substr(start, widest);
    }
    out += "\n    " + printable(line);
    if (column <= 0) return out;
    const std::string before = printable(line.substr(0, std::min(at, line.size())));
    out += "\n    ";
    for (const char c : before)
        if (screen_width({&c, 1}) == 1) out += c == '\t' ? '\t' : ' ';
    return out + "^";
}

}  // namespace

std::string format_diagnostic(const SourceRef& where, const std::string& message,
                              const std::string& line_text) {
    std::string out;
    if (!where.program.empty()) out += printable(where.program) + ":";
    if (where.line > 0) out += fmt::format("{}:", where.line);
    if (where.line > 0 && where.column > 0) out += fmt::format("{}:", where.column);
    if (!out.empty()) out += " ";
    out += "error: " + printable(std::string_view(message).substr(0, longest));
    return line_text.empty() ? out : out + marked_line(line_text, where.column);
}

}  // namespace trunnion::inline base
