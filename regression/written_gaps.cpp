#include "regression/written_gaps.h"

#include <fmt/format.h>

#include <algorithm>

#include "regression/block_difference.h"
#include "regression/written_layers.h"

namespace trunnion::regression {

namespace {

constexpr std::size_t longest_text = 16U << 20U;

int line_at(SpilledWindow<KeyedLine>& keys, std::uint64_t at) {
    if (keys.size() == 0) return 0;
    return static_cast<int>(keys[std::min(at, keys.size() - 1)].line);
}

}  // namespace

WrittenGaps::WrittenGaps(const interpreter::ProgramText& a, const setup::Setup& setup_a,
                         const interpreter::ProgramText& b, const setup::Setup& setup_b)
    : a_(a), b_(b), setup_a_(setup_a), setup_b_(setup_b), lines_a_(a.text), lines_b_(b.text) {}

void WrittenGaps::find_gaps() {
    gaps_.emplace();
    if (a_.text.size() > longest_text || b_.text.size() > longest_text) return;
    const KeyedLines keys_a = all_keys(*written_keys(a_, Layer::words, setup_a_));
    const KeyedLines keys_b = all_keys(*written_keys(b_, Layer::words, setup_b_));
    SpilledWindow<KeyedLine> in_a(keys_a), in_b(keys_b);
    key_gaps(keys_a, keys_b, [&](const KeyGap& g) {
        WrittenGap gap;
        gap.count_a = g.a_last - g.a_first;
        gap.count_b = g.b_last - g.b_first;
        gap.line_a = line_at(in_a, g.a_first);
        gap.line_b = line_at(in_b, g.b_first);
        gap.last_a = gap.count_a > 0 ? line_at(in_a, g.a_last - 1) : gap.line_a;
        gap.last_b = gap.count_b > 0 ? line_at(in_b, g.b_last - 1) : gap.line_b;
        gaps_->push_back(gap);
    });
}

std::optional<WrittenCause> WrittenGaps::before(int line_a, int line_b) {
    if (!gaps_) find_gaps();
    const auto ahead = [&](const WrittenGap& gap) {
        // A side without blocks: the gap is before its line.
        const int at_a = gap.line_a - (gap.count_a == 0 ? 1 : 0);
        const int at_b = gap.line_b - (gap.count_b == 0 ? 1 : 0);
        return (line_a > 0 && at_a > line_a) || (line_b > 0 && at_b > line_b);
    };
    const auto behind = std::partition_point(gaps_->begin(), gaps_->end(),
                                             [&](const WrittenGap& gap) { return !ahead(gap); });
    if (behind == gaps_->begin()) return std::nullopt;
    return said(*std::prev(behind), line_a, line_b);
}

std::optional<WrittenCause> WrittenGaps::at(int line_a, int line_b) {
    if (!gaps_) find_gaps();
    for (const WrittenGap& gap : *gaps_) {
        if (gap.count_a == 0 || gap.count_a != gap.count_b) continue;
        const int behind = line_a > 0 ? line_a - gap.line_a : line_b - gap.line_b;
        const bool inside = line_a > 0 ? line_a <= gap.last_a : line_b <= gap.last_b;
        if (behind >= 0 && inside) return pair(gap.line_a + behind, gap.line_b + behind);
    }
    return std::nullopt;
}

std::optional<WrittenCause> WrittenGaps::block_missing(int line_a, int line_b) {
    if (!gaps_) find_gaps();
    for (const WrittenGap& gap : *gaps_) {
        const bool only_a = gap.count_b == 0 && line_a >= gap.line_a && line_a <= gap.last_a;
        const bool only_b = gap.count_a == 0 && line_b >= gap.line_b && line_b <= gap.last_b;
        if (only_a || only_b) return missing(gap);
        if (gap.line_a > line_a && gap.line_b > line_b) break;
    }
    return std::nullopt;
}

std::optional<WrittenCause> WrittenGaps::first_that_writes() {
    if (!gaps_) find_gaps();
    const auto writes = [](const std::string& block) {
        return block.find("G10") != std::string::npos || block.find('#') != std::string::npos;
    };
    for (const WrittenGap& gap : *gaps_)
        for (int k = 0; k <= std::max(gap.last_a - gap.line_a, gap.last_b - gap.line_b); ++k) {
            const int a = gap.line_a + k, b = gap.line_b + k;
            const bool in_a = gap.count_a > 0 && a <= gap.last_a && writes(lines_a_.line(a));
            const bool in_b = gap.count_b > 0 && b <= gap.last_b && writes(lines_b_.line(b));
            if (!in_a && !in_b) continue;
            if (gap.count_a == 0 || gap.count_b == 0) return missing(gap);
            if (auto said = pair(a, b)) return said;
            return WrittenCause{a, b, ""};
        }
    return std::nullopt;
}

/// X Y Z as last written before a block of A (G91 and macros would require a run).
std::array<std::optional<double>, 3> WrittenGaps::start_of(int line_a) {
    constexpr int looked_at = 200;
    std::array<std::optional<double>, 3> start;
    for (int line = line_a - 1; line > std::max(0, line_a - looked_at); --line) {
        const auto written = position_words(lines_a_.line(line));
        for (std::size_t k = 0; k < 3; ++k)
            if (!start[k]) start[k] = written[k];
        if (start[0] && start[1] && start[2]) break;
    }
    return start;
}

std::optional<WrittenCause> WrittenGaps::pair(int line_a, int line_b) {
    const BlockDifference found =
        block_difference(lines_a_.line(line_a), lines_b_.line(line_b), start_of(line_a));
    if (found.words.empty()) return std::nullopt;
    return WrittenCause{line_a, line_b, text_of(found), found.name};
}

WrittenCause WrittenGaps::missing(const WrittenGap& gap) {
    const bool in_a = gap.count_a > 0;
    const std::uint64_t count = in_a ? gap.count_a : gap.count_b;
    const std::string block = in_a ? lines_a_.line(gap.line_a) : lines_b_.line(gap.line_b);
    const std::string more = count > 1 ? fmt::format(" and {} more", count - 1) : "";
    return {gap.line_a, gap.line_b,
            fmt::format("block '{}'{} {}", block, more, in_a ? "is missing in B" : "is only in B")};
}

std::optional<WrittenCause> WrittenGaps::said(const WrittenGap& gap, int line_a, int line_b) {
    if (gap.count_a == 0 || gap.count_b == 0) return missing(gap);
    const bool inside = line_a >= gap.line_a && line_a <= gap.last_a && line_b >= gap.line_b &&
                        line_b <= gap.last_b;
    if (inside)
        if (const auto here = pair(line_a, line_b)) return here;
    if (gap.count_a != gap.count_b || gap.count_a > 20) return std::nullopt;
    for (int k = 0; gap.line_a + k <= gap.last_a && gap.line_b + k <= gap.last_b; ++k)
        if (const auto there = pair(gap.line_a + k, gap.line_b + k)) return there;
    return WrittenCause{gap.line_a, gap.line_b, ""};
}

}  // namespace trunnion::regression
