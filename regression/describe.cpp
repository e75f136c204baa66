#include "regression/describe.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/alarm.h"
#include "base/units.h"
#include "interpreter/lexical.h"
#include "interpreter/program_folders.h"
#include "regression/arrays.h"
#include "regression/block_difference.h"
#include "regression/compare_picture.h"

namespace trunnion::regression {

SourceLines::SourceLines(const interpreter::ProgramText& main) : name_(main.name) {
    texts_[main.name] = main;
}

const ProgramLines* SourceLines::lines_of(const std::string& program) {
    const auto known = lines_.find(program);
    if (known != lines_.end()) return known->second ? &*known->second : nullptr;
    std::optional<ProgramLines>& lines = lines_[program];
    try {
        if (!texts_.contains(program)) texts_[program] = interpreter::read_program(program);
        lines.emplace(texts_[program].text);
    } catch (const InputError&) {
        return nullptr;  // a golden, or a program that is no file: nothing to show
    }
    return &*lines;
}

void SourceLines::show(ComparePlace& place) {
    const ProgramLines* lines = lines_of(place.program);
    if (lines == nullptr || place.line <= 0) return;
    constexpr int around = 2;
    place.block = lines->line(place.line);
    const int first = std::max(1, place.line - around);
    place.context_at = place.line - first;
    for (int n = first; n <= std::min(lines->count(), place.line + around); ++n)
        place.context.push_back(lines->line(n));
}

namespace {

/// Position of a stretch; `cause`: position of the cause, if it is another block.
ComparePlace place_of(SegmentWindow& path, const PathRecord& record, Stretch stretch,
                      CausePlace cause, SourceLines& lines) {
    ComparePlace place;
    place.program = lines.main_name();
    if (record.size() == 0) return place;
    // For a side without segments: the block before which they are missing.
    const std::uint64_t at = std::min(stretch.first, record.segments().size() - 1);
    const Segment segment = path[at];
    const std::uint16_t program = cause.line > 0 ? cause.program : segment.program;
    if (program < record.programs().size()) place.program = record.programs()[program];
    place.line = static_cast<int>(cause.line > 0 ? cause.line : segment.line);
    place.last_line = place.line;
    if (stretch.last > stretch.first) {
        const Segment last = path[stretch.last - 1];
        if (last.program == program)
            place.last_line = std::max(place.line, static_cast<int>(last.line));
    }
    lines.show(place);
    return place;
}

std::string shift_text(const Vector3& shift) {
    std::string out;
    for (int k = 0; k < 3; ++k)
        if (std::abs(shift[k]) >= 5e-5)
            out += fmt::format("{}{}{:+.4f}", out.empty() ? "" : " ", "XYZ"[k], shift[k]);
    return out;
}

std::string away_text(double position_mm) {
    return position_mm < 5e-5 ? " along the same way"
                              : fmt::format(", up to {:.4f} mm away", position_mm);
}

std::string times(std::uint64_t count, const char* what) {
    return count > 1 ? fmt::format(", in {} {}", count, what) : "";
}

/// One sentence for a cluster.
std::string sentence(const PathCluster& c, PathSpace space, const Tolerances& tolerances) {
    const std::string tool = fmt::format(" (T{})", c.tool);
    const double deg = deg_from_rad(c.direction_rad);
    switch (c.kind) {
        case DifferenceKind::moved:
            return "moved by " + shift_text(c.first.shift_mm) + " mm" + times(c.count, "places") +
                   tool;
        case DifferenceKind::only_a:
            return c.cut_a_mm > 0.0
                       ? fmt::format("only in A: a pass with {:.3f} mm of cut", c.cut_a_mm) + tool
                       : fmt::format("only in A: moves{}", away_text(c.position_mm)) + tool;
        case DifferenceKind::only_b:
            return c.cut_b_mm > 0.0
                       ? fmt::format("only in B: a pass with {:.3f} mm of cut", c.cut_b_mm) + tool
                       : fmt::format("only in B: moves{}", away_text(c.position_mm)) + tool;
        case DifferenceKind::reordered:
            return fmt::format("{} {:.3f} mm of cut at another place in the order",
                               c.count > 1 ? fmt::format("{} passes with", c.count) : "a pass with",
                               c.cut_a_mm) +
                   tool;
        case DifferenceKind::feed:
            return fmt::format("feed {:g} -> {:g} mm/min", c.first.value_a, c.first.value_b) +
                   times(c.count, "places") + tool;
        case DifferenceKind::spindle:
            return fmt::format("spindle {:g} -> {:g} rpm", c.first.value_a, c.first.value_b) +
                   times(c.count, "places") + tool;
        case DifferenceKind::coolant:
            return fmt::format("coolant {} -> {}", c.first.value_a != 0.0 ? "on" : "off",
                               c.first.value_b != 0.0 ? "on" : "off") +
                   times(c.count, "places") + tool;
        case DifferenceKind::tool:
            return fmt::format("tool T{:g} -> T{:g}", c.first.value_a, c.first.value_b) +
                   times(c.count, "places");
        default: break;
    }
    const std::string places = times(c.count, "places");
    const bool turned = c.direction_rad > tolerances.direction_rad;
    const bool shifted = c.position_mm > tolerances.position_mm;
    const char* what = space == PathSpace::tip ? "tool direction" : "rotary axes";
    if (turned && shifted)
        return fmt::format("another path, up to {:.4f} mm and {:.4f} deg apart", c.position_mm,
                           deg) +
               places + tool;
    if (turned) return fmt::format("{} up to {:.4f} deg apart", what, deg) + places + tool;
    if (shifted)
        return fmt::format("another path, up to {:.4f} mm apart", c.position_mm) + places + tool;
    return "the same points by another motion (rapid or feed, or along the path to and fro)" +
           places + tool;
}

/// The block without its N number and blanks: input of a fingerprint.
std::string bare(const std::string& block) {
    std::string out;
    for (const char c : block)
        if (!interpreter::is_blank(c)) out += interpreter::upper(c);
    std::size_t end = out.starts_with("N") ? 1 : 0;
    while (end > 0 && end < out.size() && interpreter::is_digit(out[end])) ++end;
    return out.substr(end);
}

}  // namespace

void describe_paths(const PathComparison& found, const std::vector<ExplainedCluster>& clusters,
                    const DescribedPaths& paths, Comparison& result) {
    const PathRecord &a = paths.a.path, &b = paths.b.path;
    SourceLines &lines_a = paths.a.lines, &lines_b = paths.b.lines;
    SegmentWindow path_a(a.segments()), path_b(b.segments());
    std::vector<PathRegion> regions;
    for (const ExplainedCluster& e : clusters) {
        const PathCluster& c = e.cluster;
        Difference d;
        d.kind = c.kind;
        d.cause = e.cause;
        d.what =
            (e.cause.empty() ? "" : e.cause + ": ") + sentence(c, paths.space, paths.tolerances);
        d.a = place_of(path_a, a, c.first.a, e.a, lines_a);
        d.b = place_of(path_b, b, c.first.b, e.b, lines_b);
        d.position_mm = c.position_mm;
        d.direction_deg = deg_from_rad(c.direction_rad);
        d.shift_mm = array_of(c.first.shift_mm);
        d.value_a = c.first.value_a;
        d.value_b = c.first.value_b;
        d.tool = c.tool;
        d.count = c.count;
        result.differences.push_back(std::move(d));
        regions.push_back(c.first);
    }
    result.differences_left_out += found.left_out;
    result.position_mm = found.totals.position_mm;
    result.direction_deg = deg_from_rad(found.totals.direction_rad);
    result.worst_a = place_of(path_a, a, {found.totals.worst_a, found.totals.worst_a}, {}, lines_a);
    result.worst_b = place_of(path_b, b, {found.totals.worst_b, found.totals.worst_b}, {}, lines_b);
    result.tools = found.tools;
    result.compared = found.totals.compared;
    if (found.approaches_differ > 0)
        result.notes.push_back(
            fmt::format("the rapid moves to {} cuts take another path, as expected with other "
                        "positioning functions or machines; only their end points were compared",
                        found.approaches_differ));
    const auto farthest = std::max_element(
        result.differences.begin(), result.differences.end(),
        [](const Difference& p, const Difference& q) { return p.position_mm < q.position_mm; });
    const std::uint64_t worst_a = found.totals.worst_a, worst_b = found.totals.worst_b;
    draw_paths(regions,
               {a,
                b,
                paths.tolerances,
                {worst_a, worst_a + 1},
                {worst_b, worst_b + 1},
                static_cast<std::size_t>(farthest - result.differences.begin())},
               result.picture);
}

namespace {

ComparePlace place_in(SpilledWindow<KeyedLine>& keyed, std::uint64_t first, std::uint64_t last,
                      SourceLines& lines) {
    ComparePlace p;
    p.program = lines.main_name();
    if (keyed.size() == 0) return p;
    p.line = static_cast<int>(keyed[std::min(first, keyed.size() - 1)].line);
    p.last_line = last > first ? std::max(p.line, static_cast<int>(keyed[last - 1].line)) : p.line;
    lines.show(p);
    return p;
}

std::string counted(std::uint64_t count, const char* noun) {
    return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

}  // namespace

void describe_gaps(DescribedKeys a, DescribedKeys b, std::size_t most, Comparison& result) {
    SpilledWindow<KeyedLine> keyed_a(a.keys), keyed_b(b.keys);
    const char* const noun = result.by == Layer::text     ? "line"
                             : result.by == Layer::blocks ? "move"
                                                          : "block";
    key_gaps(a.keys, b.keys, [&](const KeyGap& gap) {
        if (result.differences.size() >= most) {
            ++result.differences_left_out;
            return;
        }
        Difference d;
        d.kind = DifferenceKind::text;
        const std::uint64_t in_a = gap.a_last - gap.a_first, in_b = gap.b_last - gap.b_first;
        if (in_a == 0) d.kind = DifferenceKind::only_b;
        if (in_b == 0) d.kind = DifferenceKind::only_a;
        d.what = in_a == 0      ? counted(in_b, noun) + " only in B"
                 : in_b == 0    ? counted(in_a, noun) + " only in A"
                 : in_a == in_b ? counted(in_a, noun) + " changed"
                                : fmt::format("{} of A became {} of B", counted(in_a, noun), in_b);
        d.a = place_in(keyed_a, gap.a_first, gap.a_last, a.lines);
        d.b = place_in(keyed_b, gap.b_first, gap.b_last, b.lines);
        if (in_a == 1 && in_b == 1 && result.by != Layer::blocks)
            d.cause = text_of(block_difference(d.a.block, d.b.block, {}));
        if (!d.cause.empty()) d.what += ": " + d.cause;
        result.differences.push_back(std::move(d));
    });
    result.compared = std::max(a.keys.size(), b.keys.size());
}

void add_fingerprints(Comparison& result) {
    std::map<std::string, int> before;
    for (Difference& d : result.differences) {
        const std::string what =
            fmt::format("{}|{}|{}|{}", name_of(d.kind), d.tool, bare(d.a.block), bare(d.b.block));
        const int occurrence = before[what]++;
        d.fingerprint = fmt::format("{:016x}", hash_of(fmt::format("{}|{}", what, occurrence)));
    }
}

}  // namespace trunnion::regression
