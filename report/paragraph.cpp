#include "report/paragraph.h"

#include <algorithm>
#include <cctype>
#include <utility>

namespace trunnion::report {

namespace {

/// Bytes of a UTF-8 text that begin a character.
std::size_t columns_of(const std::string& text) {
    return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
        return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
    }));
}

/// Where the word from `at` ends. A number and its unit are one word.
std::size_t end_of_word(const std::string& text, std::size_t at) {
    const auto end_from = [&](std::size_t from) {
        return std::min(text.find_first_of(" \n", from), text.size());
    };
    const std::size_t end = end_from(at);
    if (end == at || end >= text.size() || text[end] != ' ' ||
        !std::isdigit(static_cast<unsigned char>(text[end - 1])))
        return end;
    const std::string next = text.substr(end + 1, end_from(end + 1) - end - 1);
    for (const std::string unit : {"µm", "µrad", "mm", "%", "deg", "ppm", "s"})
        if (next.starts_with(unit) &&
            next.find_first_not_of(".,;:)", unit.size()) == std::string::npos)
            return end + 1 + next.size();
    return end;
}

}  // namespace

std::vector<std::string> wrapped(const std::string& text, std::size_t width) {
    std::vector<std::string> lines;
    std::string line;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = end_of_word(text, at);
        const std::string word = text.substr(at, end - at);
        if (!line.empty() && columns_of(line) + 1 + columns_of(word) > width)
            lines.push_back(std::exchange(line, {}));
        if (!word.empty()) line += (line.empty() ? "" : " ") + word;
        if (end < text.size() && text[end] == '\n') lines.push_back(std::exchange(line, {}));
        at = end + 1;
    }
    if (!line.empty()) lines.push_back(line);
    return lines;
}

std::string paragraph(const std::string& text, std::size_t indent) {
    constexpr std::size_t columns = 80;
    std::string out;
    for (const std::string& line : wrapped(text, columns - indent - 2))
        out += std::string(out.empty() ? indent : indent + 2, ' ') + line + '\n';
    return out;
}

}  // namespace trunnion::report
