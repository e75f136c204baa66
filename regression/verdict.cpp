#include "regression/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/units.h"

namespace trunnion::regression {

namespace {

std::string with_place(const Difference& d) {
    if (d.b.line == 0) return d.what;
    return fmt::format("{} at A line {}, B line {}", d.what, d.a.line, d.b.line);
}

/// Difference of the cut length, if larger than rounding.
std::string longer_cut(const Comparison& c) {
    double cut_a = 0.0, cut_b = 0.0;
    for (const ToolRow& row : c.tools) {
        cut_a += row.cut_a_mm;
        cut_b += row.cut_b_mm;
    }
    if (std::abs(cut_b - cut_a) < std::max(0.1, 1e-4 * cut_a)) return {};
    return fmt::format("; cut {:.3f} -> {:.3f} mm", cut_a, cut_b);
}

bool has_layer(const Comparison& c, Layer layer) {
    return std::any_of(c.layers.begin(), c.layers.end(),
                       [layer](const LayerVerdict& l) { return l.layer == layer; });
}

std::string equal_verdict(const Comparison& c, const Tolerances& tolerances) {
    static constexpr std::array<const char*, layer_names.size()> same{
        "the same text",      "the same words",       "the same blocks", "the same machining",
        "the same functions", "the same axis motion", "the same effects"};
    std::string text =
        fmt::format("equal by {}: {}", name_of(c.by), same[static_cast<std::size_t>(c.by)]);
    if (c.by == Layer::path || c.by == Layer::axes)
        text +=
            fmt::format(" within {:g} mm, {:g} deg and {:g} % of the feed", tolerances.position_mm,
                        deg_from_rad(tolerances.direction_rad), 100.0 * tolerances.feed_ratio);
    if (c.by != Layer::functions && has_layer(c, Layer::functions)) text += ", the same functions";
    if (c.layers.size() > 1 && !c.layers.front().equal)
        text += fmt::format("; first to differ: {}", name_of(c.layers.front().layer));
    return text;
}

std::string differing_verdict(const Comparison& c) {
    const std::uint64_t count = c.differences.size() + c.differences_left_out;
    const std::size_t gravest = gravest_difference(c);
    std::string text = fmt::format("differs by {}: ", name_of(c.by));
    if (count > 1) text += fmt::format("{} differences, the most serious: ", count);
    text += with_place(c.differences[gravest]);
    if (gravest > 0) text += ", the first: " + with_place(c.differences.front());
    if (!c.alarm_a.empty() && c.alarm_a == c.alarm_b)
        text += fmt::format("; both stop with alarm {}", c.alarm_a);
    return text + longer_cut(c);
}

}  // namespace

std::string verdict_of(const Comparison& c, const Tolerances& tolerances) {
    if (c.status == CompareStatus::alarm) return "alarm: " + c.differences[0].what;
    if (c.status == CompareStatus::limit) return "limit: a program was not run to its end";
    return c.equal ? equal_verdict(c, tolerances) : differing_verdict(c);
}

}  // namespace trunnion::regression
