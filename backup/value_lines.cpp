#include "backup/value_lines.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "backup/value_text.h"
#include "base/alarm.h"
#include "base/numbers.h"

namespace trunnion::backup {

namespace {

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}
bool is_number_char(char c) {
    return is_digit(c) || c == '.' || c == '-' || c == '+';
}

/// Scans one line from left to right; `fail` reports the position of an error.
struct LineScanner {
    std::string_view line;
    std::size_t offset;  ///< of the line in the file
    int number;
    ValueFile& file;
    std::size_t at = 0;

    void skip_blanks() {
        while (at < line.size() && (line[at] == ' ' || line[at] == '\t')) ++at;
    }
    bool done() {
        skip_blanks();
        return at >= line.size();
    }
    char peek() const { return at < line.size() ? line[at] : '\0'; }
    [[noreturn]] void fail(const std::string& message) const {
        throw InputError(message, {file.path, number, static_cast<int>(at) + 1}, std::string(line));
    }
    std::string_view number_text() {
        skip_blanks();
        const std::size_t start = at;
        while (at < line.size() && is_number_char(line[at])) ++at;
        if (at == start) fail("a number is missing");
        const std::string_view text = line.substr(start, at - start);
        if (parse_number(text)) return text;
        at = start;
        fail("'" + std::string(text) + "' is not a finite number");
    }
    /// No number of a backup (parameter, offset, variable, axis) has more than eight digits.
    int integer(int most = 99'999'999) {
        const std::string_view t = number_text();
        int n = 0;
        const auto [end, error] = std::from_chars(t.data(), t.data() + t.size(), n);
        if (error != std::errc() || end != t.data() + t.size()) fail("an integer is expected");
        if (n < -most || n > most) fail(fmt::format("the number {} is larger than {}", n, most));
        return n;
    }
    BackupValue value(std::string name, std::string_view text, BackupValue::Kind kind, int n,
                      int sub) const {
        BackupValue v;
        v.file = file.name;
        v.name = std::move(name);
        v.text = std::string(text);
        v.line = number;
        v.begin = offset + static_cast<std::size_t>(text.data() - line.data());
        v.size = text.size();
        v.kind = kind;
        v.number = n;
        v.sub = sub;
        return v;
    }
};

constexpr int most_index = 999;  ///< of an axis, spindle, path or group

/// N19700Q1L1P0.0L2P0.0 | N01825 A1 P 3000 A2 P 3000 | N00020Q1P17
void scan_parameter(LineScanner& s, std::vector<BackupValue>& out) {
    ++s.at;
    const int number = s.integer();
    s.skip_blanks();
    if (s.peek() == 'Q') {
        ++s.at;
        s.integer();
    }
    while (!s.done()) {
        int index = 0;
        char kind = s.peek();
        if (kind == 'A' || kind == 'L' || kind == 'S' || kind == 'T') {
            ++s.at;
            index = s.integer(most_index);
            s.skip_blanks();
        } else {
            kind = 0;
        }
        const char type = s.peek();
        if (type != 'P' && type != 'M' && type != 'I') s.fail("P, M or I is expected");
        ++s.at;
        const std::string_view text = s.number_text();
        std::string name = std::to_string(number);
        if (kind == 'A') name += fmt::format(" axis {}", index);
        if (kind == 'S') name += fmt::format(" spindle {}", index);
        if (kind == 'L' && index > 1) name += fmt::format(" path {}", index);
        if (kind == 'T' && index > 1) name += fmt::format(" group {}", index);
        const int others = index > 1 && kind != 'A' ? other_path : 0;
        BackupValue v = s.value(std::move(name), text, BackupValue::Kind::parameter, number,
                                kind == 'A' ? index : others * index);
        v.inch = type == 'I';
        v.for_axis = kind == 'A';
        out.push_back(std::move(v));
    }
}

struct G10Target {
    int number = 0, sub = 0;  ///< as in BackupValue
};

bool is_rotary_letter(int sub) {
    const auto axis = sub >= 'A' ? axis_of(static_cast<char>(sub)) : std::nullopt;
    return axis && is_rotary(*axis);
}

std::string offset_name(int l, int p) {
    if (l == 20) return fmt::format("G54.1 P{}", p);
    return p == 0 ? "EXT" : fmt::format("G{}", 53 + p);
}

/// A length or an angle of G10, as the control would read it in a program.
void add_offset(LineScanner& s, BackupValue::Kind kind, const std::string& name, G10Target to,
                std::vector<BackupValue>& out) {
    const std::string_view text = s.number_text();
    if (text.find('.') == std::string_view::npos && parse_number(text) != 0.0)
        s.fail(fmt::format("{} has no decimal point: its unit would depend on 3401#0", text));
    out.push_back(s.value(name, text, kind, to.number, to.sub));
    out.back().inch = s.file.inch && !is_rotary_letter(to.sub);
}

void scan_g(LineScanner& s) {
    const std::string_view code = s.number_text();
    if (code == "20" || code == "21") s.file.inch = code == "20";
    if (code == "91") s.fail("offsets added by G91 have no value of their own");
}

/// G10L2P1X..Y.. | G10L20P1X.. | G10G90L10P1R.. | G10P1R.. (memory A) | G10L85P500(hex) or R1.5
void scan_g10(LineScanner& s, std::vector<BackupValue>& out) {
    int l = -1, p = -1;
    while (!s.done()) {
        const char letter = s.peek();
        if (letter == '(' && l == 85) {
            const std::size_t close = s.line.find(')', s.at);
            if (close == std::string_view::npos || close - s.at != 17)
                s.fail("sixteen hexadecimal digits in brackets are expected");
            const std::string_view digits = s.line.substr(s.at + 1, 16);
            if (!is_hex(digits) || std::isinf(number_from_hex(digits)))
                s.fail("these are not sixteen hexadecimal digits of a finite number");
            out.push_back(
                s.value(fmt::format("#{}", p), digits, BackupValue::Kind::variable, p, 0));
            s.at = close + 1;
            continue;
        }
        ++s.at;
        if (letter == 'G') {
            scan_g(s);
        } else if (letter == 'N') {
            s.number_text();
        } else if (letter == 'L') {
            l = s.integer();
        } else if (letter == 'P') {
            p = s.integer();
        } else if ((l == 2 || l == 20) && p >= 0 && axis_of(letter)) {
            add_offset(s, BackupValue::Kind::work_offset,
                       fmt::format("{} {}", offset_name(l, p), letter),
                       {l == 20 ? 100 + p : p, letter}, out);
        } else if (l == 85 && p >= 0 && letter == 'R') {
            out.push_back(
                s.value(fmt::format("#{}", p), s.number_text(), BackupValue::Kind::variable, p, 0));
        } else if (l < 0 && p >= 0 && letter == 'R') {
            add_offset(s, BackupValue::Kind::tool_offset, fmt::format("H{}", p), {p, 10}, out);
        } else if (l >= 10 && l <= 13 && p >= 0 && letter == 'R') {
            static const char* const kinds[] = {"H{} geometry", "H{} wear", "D{} geometry",
                                                "D{} wear"};
            add_offset(s, BackupValue::Kind::tool_offset,
                       fmt::format(fmt::runtime(kinds[l - 10]), p), {p, l}, out);
        } else {
            --s.at;
            s.fail("this word does not belong into a backup's G10 block");
        }
    }
}

/// #500=1.5 of older controls, #500=#0 vacant
void scan_assignment(LineScanner& s, std::vector<BackupValue>& out) {
    ++s.at;
    const int n = s.integer();
    s.skip_blanks();
    if (s.peek() != '=') s.fail("= is expected");
    ++s.at;
    const std::string name = fmt::format("#{}", n);
    s.skip_blanks();
    if (s.line.substr(s.at) == vacant_text) {
        out.push_back(s.value(name, s.line.substr(s.at), BackupValue::Kind::variable, n, 0));
    } else {
        out.push_back(s.value(name, s.number_text(), BackupValue::Kind::variable, n, 0));
    }
    out.back().assigned = true;
}

void scan_line(LineScanner& s, std::vector<BackupValue>& out) {
    while (!s.done() && s.peek() == '(')
        s.at = std::min(s.line.find(')', s.at), s.line.size() - 1) + 1;
    if (s.done()) return;
    const std::string_view rest = s.line.substr(s.at);
    if (rest[0] == '%' || rest[0] == '/') return;
    if (rest[0] == 'N' && (s.file.name == "CNC-PARA.TXT" || s.file.name == "PITCH.TXT"))
        return scan_parameter(s, out);
    for (const char* const code : {"G10", "G20", "G21", "G90"})
        if (rest.starts_with(code)) return scan_g10(s, out);
    if (rest[0] == '#') return scan_assignment(s, out);
    if (rest.starts_with("SETVN") || rest.starts_with("M0") || rest[0] == 'O') return;
    s.fail("this line is not of a form that a control writes");
}

}  // namespace

std::vector<BackupValue> scan_values(const ValueFile& whole, std::string_view bytes) {
    ValueFile file = whole;
    std::vector<BackupValue> out;
    const char line_end = bytes.find('\n') == std::string_view::npos ? '\r' : '\n';
    int number = 1;
    for (std::size_t at = 0; at < bytes.size(); ++number) {
        std::size_t end = bytes.find(line_end, at);
        if (end == std::string_view::npos) end = bytes.size();
        std::string_view line = bytes.substr(at, end - at);
        while (!line.empty() &&
               (line.back() == '\r' || line.back() == ' ' || line.back() == '\x1a'))
            line.remove_suffix(1);
        std::size_t lead = 0;  // LF CR CR: the two CR are at the start of the next line
        while (lead < line.size() && line[lead] == '\r') ++lead;
        LineScanner s{line.substr(lead), at + lead, number, file};
        scan_line(s, out);
        at = end + 1;
    }
    return out;
}

}  // namespace trunnion::backup
