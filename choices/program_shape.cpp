#include "choices/program_shape.h"

#include <algorithm>
#include <cmath>

#include "choices/choice_table.h"
#include "choices/program_stores.h"
#include "choices/space.h"

namespace trunnion::choices {

namespace {

constexpr std::size_t least_cells = 1'000'000;  ///< rows times points: less ends soon anyhow
constexpr std::size_t most_compared = 4'000'000;
constexpr std::size_t least_ways = 30, rows_a_way = 4;
constexpr double straight_sigmas = 6.0, straight_mm = 0.01;
constexpr double same_direction = 0.01;  ///< rad: errors of a machine turn a way by less
constexpr double hardly_any = 0.35;   ///< of the straight length that fits: most of a foreign log
constexpr double clearly_more = 0.1;  ///< of it, that an option makes fit

struct StraightWay {
    Vector3 direction;
    double length_mm;
};

Vector3 linear_of(const offsets::ControlPosition& q) {
    return {q.value[index_of(Axis::X)], q.value[index_of(Axis::Y)], q.value[index_of(Axis::Z)]};
}

/// All programs have ways along an axis.
bool is_along_axis(const Vector3& way) {
    return way.cwiseAbs().maxCoeff() > (1.0 - same_direction) * way.norm();
}

/// Runs of rows that keep to their chord, but for those along an axis.
std::vector<StraightWay> ways_of(const LogView& view, double sigma) {
    const Space space(view.axes);
    const double most_mm = std::max(straight_mm, straight_sigmas * sigma);
    const auto keeps = [&](std::size_t from, std::size_t to) {
        const auto &a = view.rows[from].at, &b = view.rows[to].at;
        for (std::size_t i = from + 1; i < to; ++i) {
            const auto& p = view.rows[i].at;
            if (space.square(space.between(a, b, space.nearest(a, b, p)), p) > most_mm * most_mm)
                return false;
        }
        return true;
    };
    std::vector<StraightWay> out;
    for (std::size_t from = 0, to = 0; from + 1 < view.rows.size(); from = to) {
        for (to = from + 1; to + 1 < view.rows.size() && keeps(from, to + 1); ++to) continue;
        const Vector3 way = linear_of(view.rows[to].at) - linear_of(view.rows[from].at);
        // The noise of both ends turns a longer way by less than what is allowed.
        if (to - from >= rows_a_way && !is_along_axis(way) &&
            way.norm() * same_direction > 2.0 * most_mm)
            out.push_back({way.normalized(), way.norm()});
    }
    return out;
}

std::vector<StraightWay> ways_of(const ControlPath& path) {
    std::vector<StraightWay> out;
    for (std::size_t k = 1; k < path.nodes.size(); ++k) {
        if (!path.nodes[k].end || !path.nodes[k - 1].end) continue;
        const Vector3 way = linear_of(path.nodes[k].at) - linear_of(path.nodes[k - 1].at);
        if (way.norm() > 0.0) out.push_back({way.normalized(), way.norm()});
    }
    return out;
}

/// Part of the length of a log's ways that go as some move of the control, however far: its numbers
/// may be in another unit.
double fitting_part(const std::vector<StraightWay>& log, const std::vector<StraightWay>& moves) {
    const std::size_t step =
        1 + log.size() * moves.size() / most_compared;  // some ways tell enough of many
    double fitting = 0.0, all = 0.0;
    for (std::size_t i = 0; i < log.size(); i += step) {
        const bool fits = std::any_of(moves.begin(), moves.end(), [&](const StraightWay& move) {
            return (move.direction - log[i].direction).norm() < same_direction;
        });
        all += log[i].length_mm;
        fitting += fits ? log[i].length_mm : 0.0;
    }
    return all > 0.0 ? fitting / all : 1.0;
}

/// With two of its columns exchanged.
bool fits_exchanged(const std::vector<StraightWay>& log, const std::vector<StraightWay>& moves,
                    double least) {
    for (int k = 0; k < 3; ++k) {
        std::vector<StraightWay> other = log;
        for (StraightWay& way : other) std::swap(way.direction[k], way.direction[(k + 1) % 3]);
        if (fitting_part(other, moves) > least) return true;
    }
    return false;
}

bool is_three_axis(const LogView& view) {
    const auto has = [&](Axis axis) {
        return std::find(view.axes.begin(), view.axes.end(), axis) != view.axes.end();
    };
    return view.axes.size() == 3 && has(Axis::X) && has(Axis::Y) && has(Axis::Z);
}

}  // namespace

bool fits_nowhere(const Asked& asked, const LogOfProgram& log) {
    if (log.view.ends || log.view.keys > 0 || !is_three_axis(log.view) ||
        !stores_of(asked.texts).variables.empty())
        return false;
    const setup::Setup& setup = asked.question.setup;
    const Comparer comparer = asked.comparer(log);
    if (log.view.rows.size() * comparer.path(setup).nodes.size() < least_cells) return false;
    const std::vector<StraightWay> ways = ways_of(log.view, log.sigma);
    if (ways.size() < least_ways) return false;
    const ControlPath outline = comparer.outline(setup);
    const std::vector<StraightWay> moves = ways_of(outline);
    const double own = fitting_part(ways, moves);
    if (own > hardly_any || fits_exchanged(ways, moves, own + clearly_more)) return false;
    return std::none_of(choice_table().begin(), choice_table().end(), [&](const Choice& choice) {
        if (choice.holds(setup)) return false;
        setup::Setup other = setup;
        choice.take(other);
        const ControlPath path = comparer.outline(other);
        return !same_way(path, outline) && fitting_part(ways, ways_of(path)) > own + clearly_more;
    });
}

}  // namespace trunnion::choices
