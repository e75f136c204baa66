#include "interpreter/line_scan.h"

#include <algorithm>

#include "interpreter/lexical.h"

namespace trunnion::interpreter {
namespace {

/// Skips blanks, whole comments and block skips.
const char* skip_lead(const char* p, const char* end) {
    for (;;) {
        p = skip_blanks(p, end);
        if (p == end) return p;
        if (*p == '(') {
            const char* q = p;
            while (q != end && *q != ')' && !is_line_end(*q)) ++q;
            if (q == end || *q != ')') return p;
            p = q + 1;
        } else if (*p == '/') {
            ++p;
            if (p != end && is_digit(*p)) ++p;
        } else {
            return p;
        }
    }
}

/// The number at `p` (blanks before it are allowed), -1 when there is none.
int read_count(const char*& p, const char* end) {
    p = skip_blanks(p, end);
    const char* const first = p;
    long long n = 0;
    while (p != end && is_digit(*p)) n = n < 1000000000 ? n * 10 + (*p - '0') : n, ++p;
    return p == first ? -1 : n < 1000000000 ? static_cast<int>(n) : -1;
}

}  // namespace

std::optional<LetterPlace> first_small_letter(std::string_view text) {
    LineScan scan(text, start_of_text(text));
    while (scan.next()) {
        const LineHead& head = scan.head();
        if (head.kind == LineKind::blank || head.kind == LineKind::over) continue;
        const char* const first = text.data() + head.place.byte;
        const char* const end = find_line_end(first, text.data() + text.size());
        const std::string_view line(first, static_cast<std::size_t>(end - first));
        if (line.find("PRNT") != line.npos || line.find("SETVN") != line.npos) continue;
        char closes = 0;  // of the comment or name around the letter
        for (std::size_t i = 0; i < line.size(); ++i) {
            const char c = line[i];
            if (closes != 0) {
                if (c == closes) closes = 0;
            } else if (c == '(' || c == '<') {
                closes = c == '(' ? ')' : '>';
            } else if (c != upper(c)) {
                return LetterPlace{head.place.line, static_cast<int>(i) + 1};
            }
        }
    }
    return std::nullopt;
}

std::optional<int> number_of_name(std::string_view name) {
    if (name.empty() || upper(name[0]) != 'O') return std::nullopt;
    const char* p = name.data() + 1;
    const char* const end = name.data() + name.size();
    if (p == end || !is_digit(*p)) return std::nullopt;
    const int number = read_count(p, end);
    return p == end && number > 0 ? std::optional(number) : std::nullopt;
}

TextPlace start_of_text(std::string_view text) {
    return {text.substr(0, 3) == "\xEF\xBB\xBF" ? 3u : 0u, 1};
}

bool LineScan::next() {
    if (next_.byte >= text_.size()) return false;
    const char* const end = text_.data() + text_.size();
    const char* const first = text_.data() + next_.byte;
    head_ = LineHead{};
    head_.place = next_;
    read_head(first, end);
    const char* p = find_line_end(head_.content, end);
    if (p != end) p = past_line_end(p, end);
    next_ = {static_cast<std::uint64_t>(p - text_.data()), next_.line + 1};
    return true;
}

void LineScan::read_head(const char* p, const char* end) {
    p = skip_lead(p, end);
    head_.content = p;
    if (p == end || is_line_end(*p)) return;
    head_.kind = LineKind::block;
    if (upper(*p) == 'N') {
        ++p;
        head_.sequence_number = read_count(p, end);
        p = skip_lead(p, end);
        head_.content = p;
        if (p == end) return;
    }
    const char c = upper(*p);
    if (c == '%' || c == '&' || c == control_z) head_.kind = LineKind::over;
    if (c == '<') {
        head_.kind = LineKind::program;
        const char* const stop = find_line_end(p, end);
        const std::string_view name(p + 1,
                                    static_cast<std::size_t>(std::find(p, stop, '>') - p - 1));
        head_.number = number_of_name(name).value_or(0);
    }
    if (c != 'O' && c != ':') return;
    ++p;
    const int number = read_count(p, end);
    if (number < 0) return;
    head_.kind = LineKind::program;
    head_.number = number;
}

}  // namespace trunnion::interpreter
