#include "choices/trace_of_ends.h"

#include <algorithm>
#include <cmath>

#include "choices/row_fit.h"
#include "choices/space.h"
#include "choices/sparse_noise.h"

namespace trunnion::choices {

namespace {

constexpr std::size_t least_rows = 5;
constexpr double rows_a_move = 1.5;  ///< most; other retracts are other moves
constexpr double most_at_ends = 0.6;
constexpr std::size_t rows_before = 3;
constexpr double same_sigmas = 9.0;  ///< of the difference of two rows
constexpr double least_mm = 0.002;   ///< of it: the rounding of a control beside that of a log

/// The row keeps to an end of a move, or to the same difference from it as one of the rows before.
bool stands_at_end(const Space& space, const std::vector<const Pair*>& at, std::size_t row,
                   double near) {
    const Pair& own = *at[row];
    if (space.square(own.apart, {}) <= near * near)
        return at[row - 1] == nullptr || at[row - 1]->node != own.node;
    for (std::size_t back = 1; back <= std::min(rows_before, row); ++back) {
        const Pair* other = at[row - back];
        if (other != nullptr && other->node != own.node &&
            space.square(own.apart, other->apart) <= near * near)
            return true;
    }
    return false;
}

}  // namespace

bool seems_trace(const LogOfProgram& log, const ComparedRun& run) {
    const LogView& view = log.view;
    const Space space(view.axes);
    std::vector<const Pair*> at(view.rows.size(), nullptr);
    std::size_t first = run.path.nodes.size(), last = 0;
    for (const Pair& pair : run.pairs) {
        at[pair.row] = &pair;
        first = std::min<std::size_t>(first, pair.node);
        last = std::max<std::size_t>(last, pair.node);
    }
    double sigma = log.sigma;
    if (log.noise == LogNoise::assumed)
        if (const auto noise = sparse_noise(view, run, blocks_of(view, run)))
            sigma = std::max(sigma, noise->sigma);
    const double near = std::max(least_mm, same_sigmas * sigma);
    std::size_t moving = 0, ends = 0;
    for (std::size_t row = 1; row < at.size(); ++row) {
        if (space.square(view.rows[row].at, view.rows[row - 1].at) <= near * near) continue;
        ++moving;
        ends += at[row] != nullptr && stands_at_end(space, at, row, near) ? 1 : 0;
    }
    const double moves = static_cast<double>(last - std::min(first, last) + 1);
    return ends >= least_rows && static_cast<double>(moving) <= rows_a_move * moves &&
           static_cast<double>(ends) >= most_at_ends * static_cast<double>(moving);
}

bool may_be_trace(const records::PositionLog& log, const ControlPath& path) {
    const auto is_end = [](const PathNode& node) { return node.end; };
    const auto moves =
        static_cast<double>(std::count_if(path.nodes.begin(), path.nodes.end(), is_end));
    const auto rows = static_cast<double>(log.rows.size());
    return rows >= moves / rows_a_move && rows <= moves * rows_a_move;
}

records::PositionLog as_trace(records::PositionLog log) {
    log.ends = true;
    for (records::LoggedPosition& row : log.rows) row.end = true;
    return log;
}

}  // namespace trunnion::choices
