#include "backup/program_differences.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace trunnion::backup {

namespace {

using Lines = std::vector<ProgramLine>;

/// "O0001" of O1 or :1, "<NAME>"; empty for a line that starts no program.
std::string program_name(const std::string& line) {
    if (line[0] == '<') return line.substr(0, line.find('>') + 1);
    if (line[0] != 'O' && line[0] != ':') return "";
    const std::size_t first = std::min(line.find_first_not_of('0', 1), line.size());
    const std::size_t end = std::min(line.find_first_not_of("0123456789", first), line.size());
    return fmt::format("O{:0>4}", line.substr(first, end - first));
}

/// The part of two texts between their equal beginnings and ends.
struct Middle {
    const Lines &a, &b;
    int begin = 0, end_a = 0, end_b = 0;

    Middle(const Lines& first, const Lines& second) : a(first), b(second) {
        end_a = static_cast<int>(a.size()), end_b = static_cast<int>(b.size());
        while (begin < std::min(end_a, end_b) && equal(begin, begin)) ++begin;
        while (std::min(end_a, end_b) > begin && equal(end_a - 1, end_b - 1)) --end_a, --end_b;
    }
    bool equal(int i, int j) const {
        return a[static_cast<std::size_t>(i)] == b[static_cast<std::size_t>(j)];
    }
    int size_a() const { return end_a - begin; }
    int size_b() const { return end_b - begin; }
};

constexpr int most_edits = 2000;  ///< beyond it no count is worth its time

/// Fewest lines to take out and put in (Myers 1986, greedy); none beyond `most_edits`.
std::optional<int> fewest_edits(const Middle& m) {
    const int n = m.size_a(), k = m.size_b(), most = std::min(n + k, most_edits);
    std::vector<int> reached(static_cast<std::size_t>(2 * most + 3), 0);  // x by diagonal x - y
    const auto at = [&](int diagonal) -> int& {
        return reached[static_cast<std::size_t>(diagonal + most + 1)];
    };
    for (int d = 0; d <= most; ++d)
        for (int diagonal = -d; diagonal <= d; diagonal += 2) {
            const bool down =
                diagonal == -d || (diagonal != d && at(diagonal - 1) < at(diagonal + 1));
            int x = down ? at(diagonal + 1) : at(diagonal - 1) + 1, y = x - diagonal;
            while (x < n && y < k && m.equal(m.begin + x, m.begin + y)) ++x, ++y;
            at(diagonal) = x;
            if (x >= n && y >= k) return d;
        }
    return std::nullopt;
}

std::string shown(const Lines& lines, int i) {
    constexpr std::size_t widest = 60;
    if (i >= static_cast<int>(lines.size())) return "(end)";
    std::string text = lines[static_cast<std::size_t>(i)].text;
    for (char& c : text)
        if (static_cast<unsigned char>(c) < ' ') c = ' ';
    return text.size() > widest ? text.substr(0, widest) + "..." : text;
}

}  // namespace

std::vector<ProgramLine> lines_of(std::string_view text) {
    std::vector<ProgramLine> out;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find_first_of("\r\n", at), text.size());
        ProgramLine line{std::string(text.substr(at, end - at)), {}};
        at = end + 1;
        std::copy_if(line.text.begin(), line.text.end(), std::back_inserter(line.key),
                     [](char c) { return c != ' ' && c != '\t'; });
        if (!line.key.empty() && line.key != "%") out.push_back(std::move(line));
    }
    return out;
}

std::map<ProgramKey, std::vector<ProgramLine>> programs_of(const ControlBackup& backup) {
    std::map<ProgramKey, std::vector<ProgramLine>> out;
    for (const char* const file : {"ALL-PROG.TXT", "ALL-FLDR.TXT"}) {
        const auto found = backup.files.find(file);
        if (found == backup.files.end()) continue;
        std::string folder, name;
        for (ProgramLine& line : lines_of(found->second)) {
            if (line.key.starts_with("&F=")) folder = line.key.substr(3);
            if (const std::string start = program_name(line.key); !start.empty())
                name = folder + start;
            if (line.key[0] != '&' && line.key[0] != '%')
                out[{file, name}].push_back(std::move(line));
        }
    }
    return out;
}

std::string line_difference(const Lines& a, const Lines& b) {
    const Middle middle(a, b);
    const auto edits = fewest_edits(middle);
    if (edits == 0) return "blanks or line ends alone";
    std::string count = fmt::format("more than {} lines", most_edits);
    if (edits) {
        const int out = (middle.size_a() - middle.size_b() + *edits) / 2;
        count = fmt::format("{} line{} out, {} in", out, out == 1 ? "" : "s", *edits - out);
    }
    return fmt::format("{}; first at line {}: {} | {}", count, middle.begin + 1,
                       shown(a, middle.begin), shown(b, middle.begin));
}

}  // namespace trunnion::backup
