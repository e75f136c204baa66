#include "report/paragraph.h"

#include <utility>

namespace trunnion::report {

std::vector<std::string> wrapped(const std::string& text, std::size_t width) {
    std::vector<std::string> lines;
    std::string line;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find_first_of(" \n", at), text.size());
        const std::string word = text.substr(at, end - at);
        if (!line.empty() && line.size() + 1 + word.size() > width)
            lines.push_back(std::exchange(line, {}));
        if (!word.empty()) line += (line.empty() ? "" : " ") + word;
        if (end < text.size() && text[end] == '\n') lines.push_back(std::exchange(line, {}));
        at = end + 1;
    }
    if (!line.empty()) lines.push_back(line);
    return lines;
}

std::string paragraph(const std::string& text, std::size_t indent) {
    constexpr std::size_t columns = 90;
    std::string out;
    for (const std::string& line : wrapped(text, columns - indent - 2))
        out += std::string(out.empty() ? indent : indent + 2, ' ') + line + '\n';
    return out;
}

}  // namespace trunnion::report
