#include "inputs/backup_part.h"

#include <algorithm>
#include <array>
#include <filesystem>

#include "interpreter/lexical.h"
#include "interpreter/line_scan.h"

namespace trunnion::inputs {
namespace {

using interpreter::is_digit;
using interpreter::upper;

/// Calls `take` with each line that is neither blank, a comment nor `%`, until it returns false.
template <typename Take>
void each_line(std::string_view text, Take take) {
    const char* const end = text.data() + text.size();
    for (interpreter::LineScan scan(text, interpreter::start_of_text(text)); scan.next();) {
        const interpreter::LineHead& head = scan.head();
        if (head.kind == interpreter::LineKind::blank || head.kind == interpreter::LineKind::over)
            continue;
        const char* const first = text.data() + head.place.byte;
        if (!take(std::string_view(
                first, static_cast<std::size_t>(interpreter::find_line_end(first, end) - first))))
            return;
    }
}

/// A record of parameters: `N01320Q1A1P88`, `N01825 A1 P 3000`, `N10000Q0P-1`.
class Record {
  public:
    explicit Record(std::string_view line) : rest_(line) {
        const bool number = take("N") && digits() >= 4;
        owned_ = take("Q") && digits() > 0;
        const bool kind = take("ALST");
        whole_ =
            number && (!kind || digits() > 0) && take("PMI") && (take("-+."), true) && digits() > 0;
        owned_ = owned_ || kind;
    }
    bool is_whole() const { return whole_; }
    /// It has a Q or an axis, path or spindle, as no block of a program has behind N.
    bool is_owned() const { return owned_; }

  private:
    bool take(std::string_view letters) {
        while (!rest_.empty() && interpreter::is_blank(rest_[0])) rest_.remove_prefix(1);
        if (rest_.empty() || letters.find(upper(rest_[0])) == letters.npos) return false;
        rest_.remove_prefix(1);
        return true;
    }
    std::size_t digits() {
        while (!rest_.empty() && interpreter::is_blank(rest_[0])) rest_.remove_prefix(1);
        std::size_t count = 0;
        while (count < rest_.size() && is_digit(rest_[count])) ++count;
        rest_.remove_prefix(count);
        return count;
    }

    std::string_view rest_;
    bool whole_ = false, owned_ = false;
};

bool holds_parameters(std::string_view text) {
    int records = 0;
    bool all = true, owned = false;
    each_line(text, [&](std::string_view line) {
        const Record record(line);
        all = record.is_whole();
        owned = owned || record.is_owned();
        return all && ++records < 50;
    });
    return all && owned && records > 0;
}

/// Only G10, SETVN and assignments, as a control writes its offsets and variables.
bool holds_values(std::string_view text) {
    bool all = true;
    each_line(text, [&](std::string_view line) {
        constexpr std::array<std::string_view, 6> heads{"G10", "G90", "G11", "SETVN", "#", "M02"};
        all = std::any_of(heads.begin(), heads.end(),
                          [&](std::string_view head) { return line.starts_with(head); });
        return all;
    });
    return all;
}

bool holds_programs(std::string_view text) {
    for (interpreter::LineScan scan(text, interpreter::start_of_text(text)); scan.next();)
        if (scan.head().kind == interpreter::LineKind::program) return true;
    return false;
}

struct Row {
    std::string_view name, part;
    bool values;  ///< lines of G10, so that only the name tells it from a program
};
constexpr Row rows[] = {
    {"EXT_WKZ.TXT", "work offset file", true}, {"TOOLOFST.TXT", "tool offset file", true},
    {"MACRO.TXT", "variable file", true},      {"TOOLLIFE.TXT", "tool life file", true},
    {"TOOLSIZE.TXT", "tool size file", true},  {"SYS-CONF.TXT", "list of the system", false},
    {"OPRT_HIS.TXT", "history", false},
};

}  // namespace

std::string backup_part(const interpreter::ProgramText& file) {
    if (holds_parameters(file.text)) return "parameter file";
    std::string name = std::filesystem::path(file.name).filename().string();
    for (char& c : name) c = upper(c);
    for (const Row& row : rows)
        if (name == row.name && (row.values ? holds_values(file.text) : !holds_programs(file.text)))
            return std::string(row.part);
    return {};
}

}  // namespace trunnion::inputs
