#include "interpreter/block_reader.h"

#include <algorithm>

#include "interpreter/alarms.h"

namespace trunnion::interpreter {

std::uint16_t BlockReader::column() const {
    return static_cast<std::uint16_t>(std::min<std::ptrdiff_t>(p - begin + 1, 65535));
}

std::string BlockReader::blank_inside_number() const {
    const auto of_number = [](char c) { return is_digit(c) || c == '.'; };
    const char* before = p;
    while (before != begin && is_blank(before[-1])) --before;
    if (before == p) return {};
    const char *first = before, *past = p;
    while (first != begin && of_number(first[-1])) --first;
    while (past != end && of_number(*past)) ++past;
    const bool both = first != before && past != p;
    return both && std::count(first, past, '.') < 2 ? "a blank inside a number?" : "";
}

char BlockReader::peek_raw() {
    p = skip_blanks(p, end);
    if (p == end || is_line_end(*p) || *p == control_z) return at_end;
    if (*p == '\0') raise_language_alarm(9, column(), "NUL byte");
    return *p;
}

char BlockReader::peek() {
    char c = peek_raw();
    while (c == '(') {
        read_comment();
        c = peek_raw();
    }
    return upper(c);
}

void BlockReader::read_comment() {
    Comment comment;
    comment.column = column();
    comment.byte = static_cast<std::uint64_t>(p + 1 - text_);
    comment.leading = leading;
    int depth = 0;
    do {
        if (p == end || is_line_end(*p) || *p == control_z)
            raise_language_alarm(9, comment.column, "comment without ')'");
        if (*p == '(' && (depth == 0 || nested_comments_)) ++depth;
        if (*p == ')') --depth;
        ++p;
    } while (depth > 0);
    comment.size =
        static_cast<std::uint32_t>(static_cast<std::uint64_t>(p - 1 - text_) - comment.byte);
    if (out_.comments.size() - first_comment_ < most_comments) out_.comments.push_back(comment);
}

void BlockReader::expect(char c, int alarm) {
    if (peek() != c) raise_language_alarm(alarm, column(), blank_inside_number());
    ++p;
}

}  // namespace trunnion::interpreter
