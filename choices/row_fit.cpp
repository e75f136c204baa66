#include "choices/row_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace trunnion::choices {

namespace {

constexpr std::size_t least_differences = 10;  ///< of rows, for their scatter
constexpr double median_of_square = 0.7;       ///< of a normal variable in two or three directions
constexpr double visible = 9.0;                ///< loss of an axis: a row beyond it shows a gap
constexpr double spoiled = 5.0;                ///< rows or blocks that a wrong one counts as
constexpr double clearly = 4.0;                ///< times the limit of a row: it is wrong
constexpr double surely = 100.0;               ///< times it: one such row is enough
constexpr double other_columns = 1e-3;         ///< of the loss: it is that of noise
constexpr double most_scatter = 0.05;          ///< of the gap: a larger scatter is no noise
constexpr double most_remainder = 0.07;        ///< of the gap, where it stays in most rows
constexpr double alike = 2.25;                 ///< times the loss: half as far again
constexpr double most_rows = 0.9;              ///< that show it
constexpr double most_servo_mm = 0.03;         ///< of backlash, and of lag across the way: assumed
constexpr double least_increment = 0.001;      ///< mm or deg, of a control (IS-B)
constexpr double of_chord = 2e-4;              ///< mm or deg: a path's chords beside its curves

}  // namespace

std::vector<int> blocks_of(const LogView& log, const ComparedRun& run) {
    std::vector<int> out(log.rows.size(), 0);
    for (const Pair& pair : run.pairs)
        out[pair.row] = static_cast<int>(run.path.nodes[pair.node].block);
    if (log.keys == 0) return out;
    for (std::size_t row = 0; row < out.size(); ++row) {
        int key = log.rows[row].key;
        if (key < 0) key = log.key_of(run.path.blocks[static_cast<std::size_t>(out[row])]);
        out[row] = key >= 0 ? key + 1 : log.keys + 1 + out[row];
    }
    return out;
}

std::optional<double> scatter_about(const LogView& view, const ComparedRun& run,
                                    const std::vector<int>& blocks) {
    std::vector<const Pair*> at(view.rows.size(), nullptr);
    for (const Pair& pair : run.pairs) at[pair.row] = &pair;
    std::vector<double> squares;
    for (std::size_t row = 1; row < at.size(); ++row) {
        if (!at[row] || !at[row - 1] || blocks[row] != blocks[row - 1]) continue;
        // A sample that slides along its segment has no difference in that direction.
        const bool slides = at[row]->slides && at[row - 1]->slides;
        const double axes = static_cast<double>(view.axes.size()) - (slides ? 1.0 : 0.0);
        double sum = 0.0;
        for (const Axis axis : view.axes) {
            const double d = at[row]->apart[axis] - at[row - 1]->apart[axis];
            sum += d * d;
        }
        if (axes > 0.0) squares.push_back(sum / (2.0 * axes));
    }
    if (squares.size() < least_differences) return std::nullopt;
    const auto middle = squares.begin() + static_cast<std::ptrdiff_t>(squares.size() / 2);
    std::nth_element(squares.begin(), middle, squares.end());
    return std::sqrt(*middle / median_of_square);
}

double reached(const std::vector<double>& before, const std::vector<double>& after,
               double row_limit) {
    double rows = 0.0, good = 0.0;
    for (std::size_t row = 0; row < before.size(); ++row) {
        const bool fits = after[row] <= row_limit;
        if (before[row] > row_limit) {
            ++rows;
            good += fits ? 1.0 : 0.0;
        } else if (!fits) {
            rows += spoiled;
        }
    }
    return rows > 0.0 ? good / rows : 1.0;
}

double reached_blocks(const std::vector<double>& before, const std::vector<double>& after,
                      const std::vector<int>& blocks, double row_limit) {
    struct Sum {
        double gaps = 0.0, good = 0.0;
        bool is_wrong = false;
    };
    std::map<int, Sum> sums;
    for (std::size_t row = 0; row < before.size(); ++row) {
        Sum& sum = sums[blocks[row]];
        if (before[row] > row_limit) {
            sum.gaps += 1.0;
            sum.good += after[row] <= row_limit ? 1.0 : 0.0;
        } else {
            sum.is_wrong = sum.is_wrong || after[row] > clearly * row_limit;
        }
    }
    double all = 0.0, good = 0.0;
    for (const auto& [block, sum] : sums) {
        if (sum.gaps > 0.0) {
            all += 1.0;
            good += sum.good / sum.gaps;
        } else if (sum.is_wrong) {
            all += spoiled;
        }
    }
    return all > 0.0 ? good / all : 1.0;
}

bool stays_wrong(const std::vector<double>& before, const std::vector<double>& after,
                 double row_limit) {
    constexpr std::size_t one_in = 100;
    std::size_t wrong = 0;
    for (std::size_t row = 0; row < before.size(); ++row) {
        if (after[row] <= clearly * row_limit) continue;
        if (before[row] <= row_limit || after[row] > surely * row_limit) return true;
        ++wrong;
    }
    return one_in * wrong > before.size();
}

double row_limit_of(const LogOfProgram& log, const ComparedRun& base, const ComparedRun& explained,
                    const std::vector<int>& blocks, double gap) {
    const double axes = static_cast<double>(log.view.axes.size());
    double ratio = 1.0;
    if (log.noise != LogNoise::given) {
        const double seen = log.dense
                                ? log.sigma
                                : std::min(scatter_about(log.view, explained, blocks).value_or(0.0),
                                           scatter_about(log.view, base, blocks).value_or(0.0));
        const double scatter = std::min(std::max(seen, least_increment / std::sqrt(12.0)),
                                        most_scatter * gap / std::sqrt(axes));
        ratio = std::max(1.0, scatter / log.sigma);
    }
    return visible * axes * ratio * ratio;
}

double beside_remainder(const LogOfProgram& log, const ComparedRun& base,
                        const ComparedRun& explained, const std::vector<int>& blocks,
                        double row_limit) {
    if (explained.losses.empty()) return row_limit;
    const auto rows = static_cast<double>(explained.losses.size());
    const double small = most_remainder * most_remainder * base.loss / rows;
    // The rows of another cause, or of a foreign block, are far more than what most rows have.
    std::vector<double> left = explained.losses;
    std::sort(left.begin(), left.end());
    left.resize(static_cast<std::size_t>(most_rows * rows) + 1);
    const double usual = visible * sum_of(left) / static_cast<double>(left.size());
    const double largest = std::pow(most_servo_mm / log.sigma, 2);
    const double out = std::max(row_limit, std::min({usual, small, largest}));
    if (explained.loss > small * rows) return out;
    std::map<int, double> most;
    for (std::size_t row = 0; row < blocks.size(); ++row)
        most[blocks[row]] = std::max(most[blocks[row]], explained.losses[row]);
    std::vector<double> at_blocks;
    for (const auto& [block, loss] : most) at_blocks.push_back(loss);
    const auto upper = at_blocks.begin() + static_cast<std::ptrdiff_t>(3 * at_blocks.size() / 4);
    std::nth_element(at_blocks.begin(), upper, at_blocks.end());
    return std::max(out, std::min(alike * *upper, largest));
}

bool is_rounding(const LogView& view, const ComparedRun& run) {
    return is_rounding(view, run, std::vector<double>(view.rows.size(), -1.0));
}

bool is_rounding(const LogView& view, const ComparedRun& run, const std::vector<double>& other) {
    if (view.rounding <= 0.0) return false;
    return std::all_of(run.pairs.begin(), run.pairs.end(), [&](const Pair& pair) {
        return other[pair.row] >= run.losses[pair.row] ||
               std::all_of(view.axes.begin(), view.axes.end(), [&](Axis axis) {
                   return std::abs(pair.apart[axis]) <= view.rounding + of_chord;
               });
    });
}

std::string agreeing_columns(const Comparer& comparer, const setup::Setup& setup, double loss) {
    struct Unit {
        double mm;
        const char* name;
    };
    constexpr Unit units[] = {{25.4, "inches"}, {0.001, "micrometres"}, {1000.0, "metres"}};
    const auto agrees = [&](const auto& read) {
        LogView view = comparer.log();
        for (LogView::Row& row : view.rows) read(row.at);
        const ComparedRun run = comparer.on(view).run(setup);
        // A log that shrinks to a point fits the start of any program.
        std::size_t last = 0;
        for (const Pair& pair : run.pairs) last = std::max<std::size_t>(last, pair.node);
        return run.loss < other_columns * loss && 2 * last >= run.path.nodes.size();
    };
    const std::vector<Axis>& axes = comparer.log().axes;
    for (const Unit& unit : units)
        if (agrees([&](offsets::ControlPosition& at) {
                for (const Axis axis : axes)
                    if (!is_rotary(axis)) at[axis] *= unit.mm;
            }))
            return fmt::format("its lengths are {}", unit.name);
    for (std::size_t a = 0; a < axes.size(); ++a)
        for (std::size_t b = a + 1; b < axes.size(); ++b)
            if (is_rotary(axes[a]) == is_rotary(axes[b]) &&
                agrees([&](offsets::ControlPosition& at) { std::swap(at[axes[a]], at[axes[b]]); }))
                return fmt::format("{} and {} are exchanged", letter_of(axes[a]),
                                   letter_of(axes[b]));
    return "";
}

}  // namespace trunnion::choices
