#include "choices/gap_notes.h"

#include <fmt/format.h>

#include <algorithm>

namespace trunnion::choices {

namespace {

constexpr double least_told_mm = 0.01;  ///< distance of samples that is worth a note

std::size_t last_node(const ComparedRun& run) {
    std::size_t last = 0;
    for (const Pair& pair : run.pairs) last = std::max<std::size_t>(last, pair.node);
    return last;
}

}  // namespace

bool ends_before(const ComparedRun& base) {
    return last_node(base) + 1 < base.path.nodes.size();
}

void tell_rest(const LogView& log, const ComparedRun& base, std::vector<std::string>& notes) {
    std::size_t first = base.path.nodes.size();
    for (const Pair& pair : base.pairs) first = std::min<std::size_t>(first, pair.node);
    if (log.begins_within && first < base.path.nodes.size())
        notes.push_back(fmt::format(
            "the log begins within the program: the moves before line {} are not judged",
            base.path.blocks[base.path.nodes[first].block].line));
    if (!ends_before(base)) return;
    const PathBlock& next = base.path.blocks[base.path.nodes[last_node(base) + 1].block];
    notes.push_back(fmt::format(
        "the log ends before the program: the moves from line {} on are not judged", next.line));
}

void tell_sampling(const LogView& log, std::vector<std::string>& notes) {
    if (log.spacing <= least_told_mm || log.marked) return;
    notes.push_back(fmt::format(
        "a move of less than {:.2g} mm, out and back between two samples, would not be seen{}",
        log.spacing,
        log.even ? "; the end of a sampled motion is judged to the distance of its own samples"
                 : ""));
}

}  // namespace trunnion::choices
