#include "backup/value_lines.h"

#include <fmt/format.h>

#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>

#include "base/alarm.h"
#include "base/numbers.h"
#include "base/units.h"

namespace trunnion::backup {

namespace {

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}
bool is_number_char(char c) {
    return is_digit(c) || c == '.' || c == '-' || c == '+';
}

bool is_hex(std::string_view text) {
    return text.find_first_not_of("0123456789ABCDEFabcdef") == std::string_view::npos;
}

double from_hex(std::string_view digits) {
    std::uint64_t bits = 0;
    std::from_chars(digits.data(), digits.data() + digits.size(), bits, 16);
    return std::bit_cast<double>(bits);
}

/// Scans one line from left to right; `fail` reports the position of an error.
struct LineScanner {
    std::string_view line;
    std::size_t offset;  ///< of the line in the file
    int number;
    const std::string& file;
    const std::string& path;
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
        throw InputError(message, {path, number, static_cast<int>(at) + 1}, std::string(line));
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
        v.file = file;
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
        const bool first_path = (kind == 'L' || kind == 'T') && index <= 1;
        BackupValue v = s.value(std::move(name), text, BackupValue::Kind::parameter, number,
                                first_path    ? 0
                                : kind == 'A' ? index
                                              : index * 100 + (kind != 0));
        v.inch = type == 'I';
        v.for_axis = kind == 'A';
        out.push_back(std::move(v));
    }
}

std::string offset_name(int l, int p) {
    if (l == 20) return fmt::format("G54.1 P{}", p);
    return p == 0 ? "EXT" : fmt::format("G{}", 53 + p);
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
            if (!is_hex(digits) || std::isinf(from_hex(digits)))
                s.fail("these are not sixteen hexadecimal digits of a finite number");
            out.push_back(
                s.value(fmt::format("#{}", p), digits, BackupValue::Kind::variable, p, 0));
            s.at = close + 1;
            continue;
        }
        ++s.at;
        if (letter == 'G' || letter == 'N') {
            s.number_text();
        } else if (letter == 'L') {
            l = s.integer();
        } else if (letter == 'P') {
            p = s.integer();
        } else if ((l == 2 || l == 20) && p >= 0 && axis_of(letter)) {
            out.push_back(s.value(fmt::format("{} {}", offset_name(l, p), letter), s.number_text(),
                                  BackupValue::Kind::work_offset, l == 20 ? 100 + p : p, letter));
        } else if (l == 85 && p >= 0 && letter == 'R') {
            out.push_back(
                s.value(fmt::format("#{}", p), s.number_text(), BackupValue::Kind::variable, p, 0));
        } else if (l < 0 && p >= 0 && letter == 'R') {
            out.push_back(s.value(fmt::format("H{}", p), s.number_text(),
                                  BackupValue::Kind::tool_offset, p, 10));
        } else if (l >= 10 && l <= 13 && p >= 0 && letter == 'R') {
            static const char* const kinds[] = {"H{} geometry", "H{} wear", "D{} geometry",
                                                "D{} wear"};
            out.push_back(s.value(fmt::format(fmt::runtime(kinds[l - 10]), p), s.number_text(),
                                  BackupValue::Kind::tool_offset, p, l));
        } else {
            --s.at;
            s.fail("this word does not belong into a backup's G10 block");
        }
    }
}

/// #500=1.5 of older controls
void scan_assignment(LineScanner& s, std::vector<BackupValue>& out) {
    ++s.at;
    const int n = s.integer();
    s.skip_blanks();
    if (s.peek() != '=') s.fail("= is expected");
    ++s.at;
    out.push_back(
        s.value(fmt::format("#{}", n), s.number_text(), BackupValue::Kind::variable, n, 0));
}

void scan_line(LineScanner& s, std::vector<BackupValue>& out) {
    if (s.done()) return;
    const std::string_view rest = s.line.substr(s.at);
    if (rest[0] == '%' || rest[0] == '(' || rest[0] == '/') return;
    if (rest[0] == 'N' && (s.file == "CNC-PARA.TXT" || s.file == "PITCH.TXT"))
        return scan_parameter(s, out);
    if (rest.substr(0, 3) == "G10") return scan_g10(s, out);
    if (rest[0] == '#') return scan_assignment(s, out);
    if (rest.substr(0, 5) == "SETVN" || rest.substr(0, 3) == "G90" || rest.substr(0, 2) == "M0" ||
        rest.substr(0, 3) == "G20" || rest.substr(0, 3) == "G21" || rest[0] == 'O')
        return;
    s.fail("this line is not of a form that a control writes");
}

bool is_bits(const std::string& text) {
    return text.size() == 8 && text.find_first_not_of("01") == std::string::npos;
}
bool is_hex_double(const BackupValue& v) {
    return v.kind == BackupValue::Kind::variable && v.text.size() == 16 && is_hex(v.text);
}

/// The offset vector of a BackupValue's number; const if the stores are.
template <class S>
auto work_offset(S& stores, int number) -> decltype(&stores.work.external) {
    if (number == 0) return &stores.work.external;
    if (number >= 1 && number <= 6)
        return &stores.work.standard[static_cast<std::size_t>(number - 1)];
    if (number > 100 && number <= 400)
        return &stores.work.additional[static_cast<std::size_t>(number - 101)];
    return nullptr;
}

double offsets::ToolOffset::*tool_field(int l) {
    switch (l) {
        case 10: return &offsets::ToolOffset::length_geometry_mm;
        case 11: return &offsets::ToolOffset::length_wear_mm;
        case 12: return &offsets::ToolOffset::radius_geometry_mm;
        default: return &offsets::ToolOffset::radius_wear_mm;
    }
}

}  // namespace

std::vector<BackupValue> scan_values(const std::string& file, std::string_view bytes,
                                     const std::string& path) {
    std::vector<BackupValue> out;
    int number = 1;
    for (std::size_t at = 0; at < bytes.size(); ++number) {
        std::size_t end = bytes.find('\n', at);
        if (end == std::string_view::npos) end = bytes.size();
        std::string_view line = bytes.substr(at, end - at);
        while (!line.empty() &&
               (line.back() == '\r' || line.back() == ' ' || line.back() == '\x1a'))
            line.remove_suffix(1);
        std::size_t lead = 0;  // LF CR CR: the two CR are at the start of the next line
        while (lead < line.size() && line[lead] == '\r') ++lead;
        LineScanner s{line.substr(lead), at + lead, number, file, path};
        scan_line(s, out);
        at = end + 1;
    }
    return out;
}

double stored_value(const BackupValue& v) {
    if (is_hex_double(v)) {
        const double number = from_hex(v.text);
        // All F is taken as vacant (assumed; docs/backup_files.md), and so is any other NaN.
        return std::isnan(number) ? std::numeric_limits<double>::quiet_NaN() : number;
    }
    if (v.kind == BackupValue::Kind::parameter && is_bits(v.text)) {
        unsigned byte = 0;
        std::from_chars(v.text.data(), v.text.data() + 8, byte, 2);
        return byte;
    }
    const char* begin = v.text.data() + (v.text[0] == '+' ? 1 : 0);
    double number = 0.0;
    std::from_chars(begin, v.text.data() + v.text.size(), number);
    return v.inch ? mm_from_inch(number) : number;
}

void store_value(const BackupValue& v, offsets::Stores& stores) {
    const double number = stored_value(v);
    switch (v.kind) {
        case BackupValue::Kind::parameter: {
            offsets::Parameter& p = stores.parameters.entry[v.number];
            if (v.sub == 0)
                p.value = number;
            else
                p.by_axis[v.sub] = number;
            if (v.sub == 1) p.value = number;
            break;
        }
        case BackupValue::Kind::work_offset:
            if (offsets::OffsetVector* offset = work_offset(stores, v.number))
                (*offset)[*axis_of(static_cast<char>(v.sub))] = number;
            break;
        case BackupValue::Kind::tool_offset:
            if (v.number > 0 && static_cast<std::size_t>(v.number) < stores.tools.tool.size())
                stores.tools.tool[static_cast<std::size_t>(v.number)].*tool_field(v.sub) = number;
            break;
        case BackupValue::Kind::variable:
            if (std::isnan(number))
                stores.variables.erase(v.number);
            else
                stores.variables[v.number] = number;
            break;
    }
}

double value_in(const BackupValue& v, const offsets::Stores& stores) {
    switch (v.kind) {
        case BackupValue::Kind::parameter: {
            const auto entry = stores.parameters.entry.find(v.number);
            if (entry == stores.parameters.entry.end()) return stored_value(v);
            if (v.sub == 0) return entry->second.value;
            const auto by_axis = entry->second.by_axis.find(v.sub);
            return by_axis == entry->second.by_axis.end() ? stored_value(v) : by_axis->second;
        }
        case BackupValue::Kind::work_offset: {
            const offsets::OffsetVector* offset = work_offset(stores, v.number);
            return offset ? (*offset)[*axis_of(static_cast<char>(v.sub))] : stored_value(v);
        }
        case BackupValue::Kind::tool_offset:
            if (v.number <= 0 || static_cast<std::size_t>(v.number) >= stores.tools.tool.size())
                return stored_value(v);
            return stores.tools.tool[static_cast<std::size_t>(v.number)].*tool_field(v.sub);
        case BackupValue::Kind::variable: {
            const auto it = stores.variables.find(v.number);
            return it == stores.variables.end() ? std::numeric_limits<double>::quiet_NaN()
                                                : it->second;
        }
    }
    return 0.0;
}

bool same_value(double a, double b) {
    return a == b || (std::isnan(a) && std::isnan(b));
}

std::string format_value(const BackupValue& like, double number) {
    if (is_hex_double(like))
        return std::isnan(number) ? std::string(16, 'F')
                                  : fmt::format("{:016X}", std::bit_cast<std::uint64_t>(number));
    const bool byte = number >= 0.0 && number <= 255.0 && number == std::floor(number);
    if (byte && like.kind == BackupValue::Kind::parameter && is_bits(like.text))
        return fmt::format("{:08b}", static_cast<unsigned>(number));
    const double in_file = like.inch ? inch_from_mm(number) : number;
    std::string text = fmt::format("{}", in_file);
    const std::size_t point = like.text.find('.');
    if (point == std::string::npos || text.find('e') != std::string::npos) return text;
    if (text.find('.') == std::string::npos) text += '.';
    const std::size_t decimals = like.text.size() - point - 1;
    const std::size_t written = text.size() - text.find('.') - 1;
    if (written < decimals) text.append(decimals - written, '0');
    return text;
}

}  // namespace trunnion::backup
