#include "pivot/pivot_prints.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <deque>
#include <set>
#include <string_view>

#include "base/alarm.h"
#include "base/numbers.h"
#include "base/units.h"
#include "base/utf8_text.h"

namespace trunnion::pivot {

namespace {

constexpr double most_error_mm = 20.0;  ///< larger errors mean another unit or another machine
constexpr double most_printed = 1e9;    ///< as in a table of readings; DPRNT prints eight digits

/// One line with its position.
struct PrintedLine {
    const std::string* path = nullptr;
    int number = 0;
    std::string_view text;

    [[noreturn]] void refuse(const std::string& message, std::size_t column = 0) const {
        throw InputError(message, {*path, number, static_cast<int>(column) + 1}, std::string(text));
    }
    /// Number after `letter`. DPRNT prints the sign first and blanks for leading zeros: "B-
    /// 90.0000". The whole word is the number: a decimal comma or a digit lost on the way is told,
    /// not read as what stands before it.
    double value(char letter, std::size_t from) const {
        const std::size_t at = text.find(letter, from);
        if (at == std::string_view::npos)
            refuse(fmt::format("{} is missing in this line", letter), from);
        std::string_view left = text.substr(at + 1);
        const bool negative = left.starts_with('-');
        if (negative) left.remove_prefix(1);
        left.remove_prefix(std::min(left.find_first_not_of(" \t"), left.size()));
        left = left.substr(0, left.find_first_of(" \t"));
        const bool sign_again = left.starts_with('-') || left.starts_with('+');
        const auto value = sign_again ? std::nullopt : parse_number(left);
        if (!value) refuse(fmt::format("no number behind {}", letter), at);
        if (*value > most_printed) refuse(fmt::format("{} is beyond 1e9", left), at);
        return negative ? -*value : *value;
    }
    Vector3 xyz(std::size_t from) const {
        return {value('X', from), value('Y', from), value('Z', from)};
    }
};

/// Words separated by blanks.
std::vector<std::string_view> words_of(std::string_view text) {
    std::vector<std::string_view> words;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t from = text.find_first_not_of(" \t", at);
        if (from == std::string_view::npos) break;
        at = std::min(text.find_first_of(" \t", from), text.size());
        words.push_back(text.substr(from, at - from));
    }
    return words;
}

/// #3011 as a date. Empty for a clock that was never set (1970) and for an invalid date.
std::string date_of(double yyyymmdd) {
    if (!(yyyymmdd > 19800101.0 && yyyymmdd < 30000000.0)) return {};
    const int n = static_cast<int>(yyyymmdd), month = n / 100 % 100, day = n % 100;
    if (month < 1 || month > 12 || day < 1 || day > 31) return {};
    return fmt::format("{:04}-{:02}-{:02}", n / 10000, month, day);
}

std::string days(const std::set<std::string>& dates) {
    if (dates.empty()) return {};
    return dates.size() == 1 ? *dates.begin() : *dates.begin() + " to " + *dates.rbegin();
}

/// A run of one function while its lines are being read.
struct FunctionRun {
    PrintedLine head;
    int from_map = 0, to_map = 0;
    bool ended = false;
    std::map<int, std::vector<std::pair<PivotPoint, PrintedLine>>> points;
};

class PrintReader {
  public:
    PrintReader(Axis first, Axis second) : first_(first), second_(second) {}

    void read(const PrintedFile& file) {
        int number = 0;
        const std::string& all = texts_.emplace_back(utf8_of(file.text, file.path));
        const char line_end = all.find('\n') == std::string::npos ? '\r' : '\n';
        for (std::size_t at = 0; at < all.size();) {
            const std::size_t end = std::min(all.find(line_end, at), all.size());
            std::string_view text(all.data() + at, end - at);
            const auto idle = [](char c) { return c == '\r' || c == ' '; };
            while (!text.empty() && idle(text.back())) text.remove_suffix(1);
            while (!text.empty() && idle(text.front())) text.remove_prefix(1);
            line({&file.path, ++number, text});
            at = end + 1;
        }
    }
    PivotPrints take(const std::string& path);

  private:
    void line(const PrintedLine& line);
    void head(const PrintedLine& line, const std::vector<std::string_view>& words);
    void store(const PrintedLine& line, const std::vector<std::string_view>& words);
    void length(const PrintedLine& line);
    static void keep(const PrintedLine& line, int number, double value_mm,
                     std::map<int, double>& values_mm);
    void result(const PrintedLine& line, const std::string& function, std::string_view word);
    void point(const PrintedLine& line, FunctionRun& run, std::string_view word);
    void check(const std::string& function, const FunctionRun& run) const;

    std::deque<std::string> texts_;  ///< the lines are parts of them
    Axis first_, second_;
    double unit_mm_ = 1.0;
    std::set<std::string> dates_;
    std::map<std::string, FunctionRun> runs_;
    PivotPrints prints_;
};

void PrintReader::line(const PrintedLine& line) {
    const auto words = words_of(line.text);
    if (words.size() < 2) return;
    if (words[0] == "PIVOT") return head(line, words);
    if (words[0] == "STORE") return store(line, words);
    if (find_pivot_function(words[0])) result(line, std::string(words[0]), words[1]);
}

void PrintReader::head(const PrintedLine& line, const std::vector<std::string_view>& words) {
    if (words.size() != 9 || words[2] != "AXES" || words[5] != "MAPS" || words[7] != "TO" ||
        !find_pivot_function(words[1]))
        line.refuse("not the head of a pivot test (PIVOT RTCP AXES B C MAPS 1 TO 4)");
    const std::string letters{letter_of(first_), letter_of(second_)};
    if (words[3] != letters.substr(0, 1) || words[4] != letters.substr(1))
        line.refuse(
            fmt::format("prints of another machine: rotary axes {} and {}, the control has "
                        "{} and {}",
                        words[3], words[4], letters[0], letters[1]));
    const std::string function(words[1]);
    if (const auto old = runs_.find(function); old != runs_.end())
        line.refuse(
            fmt::format("{} stands twice: its run began at {}:{} already; give one run of "
                        "each function",
                        function, *old->second.head.path, old->second.head.number));
    FunctionRun& run = runs_[function];
    run.head = line;
    run.from_map = std::atoi(std::string(words[6]).c_str());
    run.to_map = std::atoi(std::string(words[8]).c_str());
    if (run.from_map < 1 || run.to_map < run.from_map || run.to_map > 99)
        line.refuse("the maps of this head are no numbers from 1");
}

void PrintReader::store(const PrintedLine& line, const std::vector<std::string_view>& words) {
    if (words[1] == "INCH") {
        const bool inch = words.size() > 2 && words[2] == "1";
        unit_mm_ = inch ? mm_from_inch(1.0) : 1.0;
        return;
    }
    if (words[1] == "G54") {
        const Vector3 g54 = line.xyz(6);
        if (prints_.g54_mm && (*prints_.g54_mm - g54).norm() > 1e-6)
            line.refuse("G54 changed between two programs: run all of them with the same stores");
        prints_.g54_mm = g54;
        return;
    }
    if (words[1] == "DATE") {
        if (const std::string date = date_of(line.value('V', 10)); !date.empty())
            dates_.insert(date);
        return;
    }
    if (words[1][0] == 'H') return length(line);
    const int number = std::atoi(std::string(words[1].substr(1)).c_str());
    if (words[1][0] != 'N' || number < 19700 || number > 19714)
        line.refuse("STORE wants G54, H, INCH, DATE or N19700 to N19714");
    keep(line, number, unit_mm_ * line.value('V', 6), prints_.parameters_mm);
}

/// "STORE H1 V..", with blanks for leading zeros: geometry plus wear of an offset, in mm (G21).
void PrintReader::length(const PrintedLine& line) {
    keep(line, static_cast<int>(line.value('H', 6)), line.value('V', 6), prints_.lengths_mm);
}

void PrintReader::keep(const PrintedLine& line, int number, double value_mm,
                       std::map<int, double>& values_mm) {
    const auto [old, fresh] = values_mm.try_emplace(number, value_mm);
    if (!fresh && std::abs(old->second - value_mm) > 1e-6)
        line.refuse(
            fmt::format("{} changed between two programs: run all of them with the same "
                        "stores",
                        number));
}

void PrintReader::result(const PrintedLine& line, const std::string& function,
                         std::string_view word) {
    const auto at = runs_.find(function);
    if (at == runs_.end())
        line.refuse(
            fmt::format("{} has no head before it (PIVOT {} ...): lines are missing, or "
                        "these are prints of another program",
                        function, function));
    FunctionRun& run = at->second;
    if (run.ended) line.refuse(fmt::format("{} goes on behind its END", function));
    if (word == "END") {
        run.ended = true;
    } else if (word.starts_with("ZERO")) {
        prints_.spheres_mm[function] = line.xyz(function.size() + 5);  // after "RTCP ZERO"
        ++prints_.zeroings;
    } else if (word.starts_with("MAP")) {
        point(line, run, word);
    }
}

void PrintReader::point(const PrintedLine& line, FunctionRun& run, std::string_view word) {
    // "MAP1" or, with blanks for leading zeros, "MAP 1".
    const std::size_t number = static_cast<std::size_t>(word.data() - line.text.data()) + 3;
    const int map = std::atoi(std::string(line.text.substr(number)).c_str());
    if (map < run.from_map || map > run.to_map)
        line.refuse(fmt::format("its head tells of maps {} to {}", run.from_map, run.to_map));
    const PivotPoint p{line.value(letter_of(first_), number),
                       line.value(letter_of(second_), number), line.xyz(number)};
    if (p.error_mm.norm() > most_error_mm)
        line.refuse(fmt::format("the sphere was found {:.1f} mm away: another unit or another "
                                "machine",
                                p.error_mm.norm()),
                    number);
    run.points[map].emplace_back(p, line);
}

void PrintReader::check(const std::string& function, const FunctionRun& run) const {
    if (!run.ended)
        run.head.refuse(fmt::format("{} has no END: the run stopped before its end", function));
    for (int map = run.from_map; map <= run.to_map; ++map) {
        const auto at = run.points.find(map);
        if (at == run.points.end() || at->second.size() < 3)
            run.head.refuse(fmt::format("map {} of {} is missing", map, function));
        const auto& points = at->second;
        const auto step = [&](std::size_t k) {
            return std::hypot(points[k].first.first_deg - points[k - 1].first.first_deg,
                              points[k].first.second_deg - points[k - 1].first.second_deg);
        };
        for (std::size_t k = 2; k < points.size(); ++k)
            if (std::abs(step(k) - step(1)) > 0.01)
                points[k].second.refuse(
                    fmt::format("an indexation of {} is missing before this line (steps of {:g} "
                                "degrees so far)",
                                function, step(1)));
    }
}

PivotPrints PrintReader::take(const std::string& path) {
    if (runs_.empty())
        throw InputError(
            "no prints of the pivot programs (lines that begin with PIVOT DPP, RTDFO, RTCP or TW)",
            {path});
    std::map<int, PivotMap> maps;
    for (const PivotFunction& f : pivot_functions()) {
        const auto run = runs_.find(f.name);
        if (run == runs_.end()) continue;
        check(f.name, run->second);
        for (const auto& [number, points] : run->second.points) {
            PivotMap& map = maps[number];
            map.number = number;
            map.arcs.push_back({f.name, f.group, {}, {}, {}, {}});
            for (const auto& [p, line] : points) map.arcs.back().points.push_back(p);
        }
    }
    for (auto& [number, map] : maps) {
        name_map(map, first_, second_);
        prints_.maps.push_back(std::move(map));
    }
    prints_.date = days(dates_);
    return std::move(prints_);
}

}  // namespace

Vector3 PivotPrints::sphere_mm() const {
    Vector3 sum = Vector3::Zero();
    for (const auto& [function, sphere] : spheres_mm) sum += sphere;
    return spheres_mm.empty() ? sum : Vector3(sum / static_cast<double>(spheres_mm.size()));
}

PivotPrints parse_pivot_prints(const std::vector<PrintedFile>& files, Axis first, Axis second) {
    PrintReader reader(first, second);
    for (const PrintedFile& file : files) reader.read(file);
    return reader.take(files.empty() ? std::string() : files.front().path);
}

setup::RotaryStores stores_in_force(const PivotPrints& prints, const setup::RotaryStores& declared,
                                    std::vector<std::string>& notes) {
    setup::RotaryStores stores = declared;
    for (const setup::StoreNumber& n : setup::store_numbers(declared)) {
        std::optional<double> printed_mm;
        if (n.parameter == 0 && prints.g54_mm) printed_mm = (*prints.g54_mm)[n.component];
        if (const auto at = prints.parameters_mm.find(n.parameter);
            at != prints.parameters_mm.end())
            printed_mm = at->second;
        if (!printed_mm) continue;
        setup::set_number(stores, n, *printed_mm);
        if (std::abs(*printed_mm - n.value_mm) > 1e-6)
            notes.push_back(
                fmt::format("{} was {:.4f} when the programs ran, the setup has {:.4f}: the "
                            "printed value is used",
                            n.name, *printed_mm, n.value_mm));
    }
    return stores;
}

void compare_lengths(const PivotPrints& prints, const offsets::ToolOffsets& declared,
                     std::vector<std::string>& notes) {
    for (const auto& [number, printed_mm] : prints.lengths_mm) {
        const auto n = static_cast<std::size_t>(number);
        const double declared_mm =
            number > 0 && n < declared.tool.size() ? declared.tool[n].length_mm() : 0.0;
        if (std::abs(printed_mm - declared_mm) > 1e-6)
            notes.push_back(fmt::format(
                "H{} was {:.4f} when the programs ran, the setup has {:.4f}: on a head the "
                "difference acts as an error of the pivot",
                number, printed_mm, declared_mm));
    }
}

}  // namespace trunnion::pivot
