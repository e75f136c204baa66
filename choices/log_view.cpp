#include "choices/log_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>

#include "base/alarm.h"
#include "base/units.h"
#include "choices/logged_arcs.h"
#include "choices/missing_rows.h"
#include "choices/rows_at_ends.h"

namespace trunnion::choices {

namespace {

constexpr std::size_t rows_for_noise = 50;
constexpr double dense_rows_a_block = 8.0;  ///< with more rows a block, neighbours belong to one
                                            ///< smooth motion

/// Active N number at each line of a text, [0] for the lines before the first.
std::vector<int> numbers_in(std::string_view text) {
    std::vector<int> out{0};
    int number = 0;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        std::string_view line = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        while (!line.empty() && (line[0] == ' ' || line[0] == '/' || line[0] == '\t'))
            line.remove_prefix(1);
        if (line.size() > 1 && (line[0] == 'N' || line[0] == 'n') &&
            std::isdigit(static_cast<unsigned char>(line[1])))
            number = std::atoi(std::string(line.substr(1, 9)).c_str());
        out.push_back(number);
    }
    return out;
}

std::string file_of(const std::string& path) {
    return std::filesystem::path(path).filename().string();
}

/// Block numbers in the numbering of the log.
class BlockKeys {
  public:
    BlockKeys(const records::PositionLog& log, const std::vector<interpreter::ProgramText>& texts)
        : main_(file_of(texts.front().name)) {
        for (const interpreter::ProgramText& text : texts)
            numbers_[file_of(text.name)] = numbers_in(text.text);
        by_number_ = log.blocks == records::BlockColumn::number && most_are_numbers(log);
        knows_program_ = std::any_of(log.rows.begin(), log.rows.end(), [&](const auto& row) {
            return numbers_.contains(file_of(row.program)) && file_of(row.program) != main_;
        });
    }
    bool by_number() const { return by_number_; }
    const std::string& main() const { return main_; }

    int of_row(const records::PositionLog& log, const records::LoggedPosition& row) {
        if (row.block == 0) return -1;
        const std::string program = program_of(row.program);
        if (!by_number_ && !knows_program_ && !any_has_line(row.block)) refuse(log, row);
        return keys_.try_emplace({program, row.block}, static_cast<int>(keys_.size()))
            .first->second;
    }
    /// The row is one of a block that no program has.
    bool is_foreign(const records::LoggedPosition& row) const {
        return by_number_ && row.block != 0 && !known_.contains(row.block);
    }
    void refuse_mostly_foreign(const records::PositionLog& log) const {
        std::size_t count = 0;
        const records::LoggedPosition* first = nullptr;
        for (const records::LoggedPosition& row : log.rows) {
            if (!is_foreign(row)) continue;
            if (first == nullptr) first = &row;
            ++count;
        }
        if (2 * count > log.rows.size()) refuse(log, *first);
    }
    int of_block(const PathBlock& block) const {
        const std::string file = block.program.empty() ? main_ : file_of(block.program);
        int told = block.line;
        if (by_number_) {
            const auto lines = numbers_.find(file);
            if (lines == numbers_.end()) return -1;
            told = lines->second[std::min<std::size_t>(static_cast<std::size_t>(block.line),
                                                       lines->second.size() - 1)];
        }
        const auto key = keys_.find({program_of(file), told});
        return key == keys_.end() ? -1 : key->second;
    }
    int count() const { return static_cast<int>(keys_.size()); }

  private:
    /// Programs are distinguished if the log names a called one; otherwise blocks of all programs
    /// count alike.
    std::string program_of(const std::string& name) const {
        const std::string file = file_of(name);
        return knows_program_ && numbers_.contains(file) && file != main_ ? file : std::string();
    }
    bool any_has_line(int line) const {
        return std::any_of(numbers_.begin(), numbers_.end(), [line](const auto& program) {
            return line < static_cast<int>(program.second.size());
        });
    }
    /// A log of lines may name a few N numbers by chance, and one of N numbers may name one that
    /// this program lacks: most of them decide.
    bool most_are_numbers(const records::PositionLog& log) {
        for (const auto& [file, lines] : numbers_) known_.insert(lines.begin(), lines.end());
        std::set<int> told;
        for (const records::LoggedPosition& row : log.rows)
            if (row.block != 0) told.insert(row.block);
        const auto are_known = std::count_if(told.begin(), told.end(),
                                             [&](int block) { return known_.contains(block); });
        return 2 * static_cast<std::size_t>(are_known) > told.size();
    }
    [[noreturn]] void refuse(const records::PositionLog& log,
                             const records::LoggedPosition& row) const {
        constexpr const char* asked = "is this the program that was logged?";
        const auto lines = numbers_.at(main_).size() - 1;
        throw InputError(
            by_number_
                ? fmt::format("block N{}: {} has most N numbers of this column, but not this one; "
                              "{} (a column of lines is named 'line')",
                              row.block, main_, asked)
                : fmt::format("block {}: {} has {} lines and no such N number; {}", row.block,
                              main_, lines, asked),
            {log.path, row.line, 0});
    }

    std::string main_;
    std::map<std::string, std::vector<int>> numbers_;  ///< by file
    std::set<int> known_;                              ///< N numbers of all programs
    std::map<std::pair<std::string, int>, int> keys_;
    bool by_number_ = false, knows_program_ = false;
};

/// Scatter of one axis about a smooth motion: third differences.
double scatter(const LogView& view, Axis axis) {
    std::vector<double> size;
    for (std::size_t i = 3; i < view.rows.size(); ++i) {
        const auto at = [&](std::size_t k) { return view.rows[i - k].at[axis]; };
        size.push_back(std::abs(at(0) - 3 * at(1) + 3 * at(2) - at(3)));
    }
    const auto middle = size.begin() + static_cast<std::ptrdiff_t>(size.size() / 2);
    std::nth_element(size.begin(), middle, size.end());
    return 1.4826 * *middle / std::sqrt(20.0);
}

double measured_sigma(const LogView& view) {
    double most = 0.0;
    for (const Axis axis : view.axes) most = std::max(most, scatter(view, axis));
    return most;
}

/// Noise beyond this ratio to that of the printed increment makes its rounding random.
constexpr double hides_rounding = 2.0;

double rounding_of(const LogOfProgram& log) {
    return log.sigma < hides_rounding * log.least_sigma ? log.half_step : 0.0;
}

double chord_of(double sigma) {
    return std::max(least_sample_sigma, 0.3 * sigma);
}

void set_noise(const records::PositionLog& log, LogOfProgram& out) {
    const double printed = log.step / std::sqrt(12.0);
    const bool given = std::any_of(log.rows.begin(), log.rows.end(),
                                   [](const auto& row) { return row.sigma_mm > 0.0; });
    const double blocks = std::max(1, out.view.keys);
    const bool dense = !log.ends && log.rows.size() >= rows_for_noise &&
                       static_cast<double>(log.rows.size()) > dense_rows_a_block * blocks;
    double sigma = std::max(printed, log.ends ? least_sigma : least_sample_sigma);
    out.dense = !given && dense;
    if (out.dense) {
        const double found = measured_sigma(out.view);
        if (found > sigma) out.noise = LogNoise::repeats;
        sigma = std::max(sigma, found);
    }
    if (given) out.noise = LogNoise::given;
    double sum = 0.0;
    for (LogView::Row& row : out.view.rows) {  // `weight` contains the log's sigma so far
        const double own = std::max(row.weight, sigma);
        row.weight = 1.0 / own;
        sum += own;
    }
    out.sigma = sum / static_cast<double>(out.view.rows.size());
    out.least_sigma = std::max(printed, log.ends ? least_sigma : least_sample_sigma);
    out.half_step = 0.5 * log.step;
    out.view.rounding = rounding_of(out);
}

std::string foreign_note(const records::PositionLog& log, const LogOfProgram& of,
                         const std::string& program) {
    constexpr std::size_t told = 3;
    std::string names;
    std::size_t count = 0;
    for (const int number : of.foreign)
        if (count++ < told) names += fmt::format("{}N{}", names.empty() ? "" : ", ", number);
    if (count > told) names += fmt::format(" and {} more", count - told);
    return fmt::format(
        "{}: {} has no {}: the rows of {} are set aside, and what the control does there is not "
        "judged; is this the program that was logged? (a column of lines is named 'line')",
        log.path, program, names, count > 1 ? "these blocks" : "this block");
}

/// Where an axis stood before the program: the mean of the rows in which it stands first, of the
/// earlier half of them, because the last ones may have begun to move. One row has its noise, and
/// what the program does not set absolutely keeps it as a shift. Machines stand at round positions:
/// the mean is one of these where its noise would hardly meet it by chance.
double first_position(const records::PositionLog& log, Axis axis, double log_sigma) {
    constexpr double stands = 6.0, agrees = 2.0, by_chance = 0.05;
    const double unit = is_rotary(axis) ? rad_from_deg(1.0) : 1.0, sigma = log_sigma * unit;
    const double first = log.rows.front().at[axis];
    std::size_t count = 0;
    while (count < log.rows.size() && std::abs(log.rows[count].at[axis] - first) <= stands * sigma)
        ++count;
    count = std::max<std::size_t>(1, count / 2);
    double sum = 0.0;
    for (std::size_t k = 0; k < count; ++k) sum += log.rows[k].at[axis] - first;
    const double mean = first + sum / static_cast<double>(count);
    const double window = agrees * sigma / std::sqrt(static_cast<double>(count));
    for (const double step : {unit, 0.1 * unit, 0.01 * unit, 1e-3 * unit}) {
        const double round = step * std::round(mean / step);
        if (std::abs(mean - round) <= window && 2.0 * window <= by_chance * step) return round;
    }
    return mean;
}

/// Rows that the times of a log miss; empty: none.
std::string lost_note(const records::PositionLog& log) {
    std::size_t count = 0;
    int first = 0;
    for (const records::LoggedPosition& row : log.rows) {
        if (!row.cut) continue;
        if (count++ == 0) first = row.line;
    }
    if (count == 0) return "";
    return fmt::format(
        "{}: by their times rows are missing at {} place{}, first after line {}: "
        "what the control does there is not judged",
        log.path, count, count > 1 ? "s" : "", first);
}

}  // namespace

const char* to_string(LogNoise noise) {
    constexpr const char* names[] = {"given", "repeats", "assumed"};
    return names[static_cast<std::size_t>(noise)];
}

void set_sigma(LogOfProgram& log, double sigma) {
    log.sigma = std::max(sigma, log.least_sigma);
    for (LogView::Row& row : log.view.rows) row.weight = 1.0 / log.sigma;
    log.path.chord_mm = chord_of(log.sigma);
    log.view.rounding = rounding_of(log);
}

void set_start(const records::PositionLog& log, LogOfProgram& out) {
    if (log.ends) return;
    for (const Axis axis : log.axes) out.path.start[axis] = first_position(log, axis, out.sigma);
}

LogOfProgram log_of_program(const records::PositionLog& log,
                            const std::vector<interpreter::ProgramText>& texts,
                            std::uint64_t max_blocks) {
    LogOfProgram out;
    out.path.max_blocks = max_blocks;
    const auto keys = std::make_shared<BlockKeys>(log, texts);
    out.view.axes = log.axes;
    out.view.ends = log.ends;
    const LoggedArcs arcs(log);
    const records::LoggedPosition* before = nullptr;
    keys->refuse_mostly_foreign(log);
    for (const records::LoggedPosition& row : log.rows) {
        if (keys->is_foreign(row)) {
            out.foreign.insert(row.block);
            if (!out.view.rows.empty()) out.view.rows.back().cut = true;
            before = &row;
            continue;
        }
        const int key = log.blocks == records::BlockColumn::none ? -1 : keys->of_row(log, row);
        const double sigma = row.sigma_mm;
        if (log.ends && row.arc) {
            out.path.arc_points = true;
            for (const AxisPositions& at : arcs.quarters(before, row))
                out.view.rows.push_back(
                    {offsets::control_position_of(at), key, sigma, row.line, true});
        }
        out.view.rows.push_back({offsets::control_position_of(row.at), key, sigma, row.line,
                                 row.end, row.cut, row.repeated});
        out.view.marked = out.view.marked || row.end;
        before = &row;
    }
    out.view.keys = keys->count();
    out.by_number = keys->by_number();
    out.view.key_of = [keys](const PathBlock& block) { return keys->of_block(block); };
    set_noise(log, out);
    out.notes = mark_missing_rows(out.view);
    if (std::string note = lost_note(log); !note.empty()) out.notes.push_back(std::move(note));
    if (!log.unknown.empty())
        out.notes.push_back(fmt::format("{}: columns that are not read: {}", log.path,
                                        fmt::join(log.unknown, ", ")));
    if (!out.foreign.empty()) out.notes.push_back(foreign_note(log, out, keys->main()));
    if (!out.view.marked && has_rows_at_ends(out.view)) {
        out.view.marked = true;
        out.notes.push_back(log.path +
                            ": every corner is one of the rows, so ends of moves are compared "
                            "exactly");
    }
    set_start(log, out);
    out.path.ends_only = log.ends;
    out.path.chord_mm = chord_of(out.sigma);
    if (out.view.keys == 0)
        out.notes.push_back(log.path +
                            ": no block numbers: rows are assigned by their order alone");
    else if (keys->by_number())
        out.notes.push_back(log.path + ": the numbers of blocks are N numbers of the program");
    return out;
}

}  // namespace trunnion::choices
