#include "geometry/alarm.h"

#include <fmt/format.h>

namespace trunnion {

std::string format_diagnostic(const SourceRef& where, const std::string& message,
                              const std::string& line_text) {
    std::string out;
    if (!where.program.empty()) out += where.program + ":";
    if (where.line > 0) out += fmt::format("{}:", where.line);
    if (where.line > 0 && where.column > 0) out += fmt::format("{}:", where.column);
    if (!out.empty()) out += " ";
    out += "error: " + message;
    if (line_text.empty()) return out;
    out += "\n    " + line_text;
    if (where.column > 0) {
        out += "\n    ";
        for (int i = 1; i < where.column; ++i) {
            const auto at = static_cast<std::size_t>(i - 1);
            out += at < line_text.size() && line_text[at] == '\t' ? '\t' : ' ';
        }
        out += "^";
    }
    return out;
}

}  // namespace trunnion
