#include "interpreter/program_likeness.h"

#include <algorithm>

#include "base/alarm.h"
#include "interpreter/keywords.h"
#include "interpreter/lexical.h"

namespace trunnion::interpreter {

namespace {

constexpr std::size_t most_lines = 1000;  ///< looked at

std::string_view without_blanks(std::string_view line) {
    const std::size_t first = line.find_first_not_of(" \t\r/");
    if (first == std::string_view::npos) return {};
    return line.substr(first, line.find_last_not_of(" \t\r") - first + 1);
}

/// A word begins with one letter, a macro statement with its name.
bool begins_block(std::string_view line) {
    const char *p = line.data(), *const end = p + line.size();
    if (!is_letter(*p)) return false;
    return line.size() == 1 || !is_letter(line[1]) || read_keyword(p, end) != Keyword::none;
}

/// A comma between values: in a block one stands in brackets, or before the letter of a chamfer.
bool has_list(std::string_view line) {
    int depth = 0;
    for (std::size_t k = 0; k < line.size(); ++k) {
        if (line[k] == '(' || line[k] == '[') ++depth;
        if (line[k] == ')' || line[k] == ']') --depth;
        if (line[k] == ',' && depth <= 0 && (k + 1 == line.size() || !is_letter(line[k + 1])))
            return true;
    }
    return false;
}

}  // namespace

bool may_be_block(std::string_view line) {
    constexpr std::string_view heads = "#(%:<;&$)";
    line = without_blanks(line);
    if (line.empty() || heads.find(line.front()) != std::string_view::npos) return true;
    return begins_block(line) && !has_list(line);
}

void refuse_other_files(const ProgramText& program) {
    constexpr char end_of_file = '\x1a';  // Ctrl-Z: what stands behind it is not read
    std::string_view text = program.text.substr(0, program.text.find(end_of_file));
    if (text.find('\0') != std::string_view::npos)
        throw InputError("is no NC program: its bytes are no text", {program.name, 0, 0});
    std::size_t all = 0, others = 0;
    int first = 0, number = 0;
    while (!text.empty() && all < most_lines) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string_view line = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        ++number;
        if (without_blanks(line).empty()) continue;
        ++all;
        if (may_be_block(line)) continue;
        ++others;
        if (first == 0) first = number;
    }
    if (2 * others > all)
        throw InputError("is no NC program: most of its lines, from this one on, are no blocks",
                         {program.name, first, 1});
}

}  // namespace trunnion::interpreter
