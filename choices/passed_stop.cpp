#include "choices/passed_stop.h"

#include <algorithm>

namespace trunnion::choices {

namespace {

bool is_same(const PathBlock& a, const PathBlock& b) {
    return a.line == b.line && a.program == b.program;
}

const PathBlock& block_at(const ControlPath& path, std::size_t node) {
    return path.blocks[path.nodes[node].block];
}

/// A block begins at this node: the one before belongs to another.
bool begins_block(const ControlPath& path, std::size_t node) {
    return path.nodes[node].block != path.nodes[node - 1].block;
}

/// The node of `other` behind the last whole block that `own` ran.
std::optional<std::size_t> first_beyond(const ControlPath& own, const ControlPath& other) {
    if (own.nodes.size() < 2) return 1;
    const PathBlock& last = block_at(own, own.nodes.size() - 1);
    std::size_t passes = 0;
    for (std::size_t k = 1; k < own.nodes.size(); ++k)
        passes += begins_block(own, k) && is_same(block_at(own, k), last) ? 1 : 0;
    const bool stops_within = own.alarm && own.alarm->where.line == last.line;
    for (std::size_t k = 1; k < other.nodes.size(); ++k) {
        if (passes == 0 && begins_block(other, k)) return k;
        if (!begins_block(other, k) || !is_same(block_at(other, k), last)) continue;
        if (--passes == 0 && stops_within) return k;
    }
    return std::nullopt;
}

}  // namespace

std::optional<BeforeStop> before_stop(const Comparer& comparer, const ComparedRun& own,
                                      const ComparedRun& other) {
    const auto beyond = first_beyond(own.path, other.path);
    if (!beyond) return std::nullopt;
    LogView view = comparer.log();
    std::size_t rows = view.rows.size();
    for (const Pair& pair : other.pairs)
        if (pair.node >= *beyond) rows = std::min(rows, pair.row);
    BeforeStop out;
    out.rows = rows;
    if (rows == 0) return out;
    view.rows.resize(rows);
    view.whole = false;
    const Comparer part = comparer.on(view);
    out.own = part.compared(own.path).loss;
    out.other = part.compared(other.path).loss;
    return out;
}

}  // namespace trunnion::choices
