#include "choices/gap_causes.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "choices/folds.h"
#include "choices/gap_notes.h"
#include "choices/row_fit.h"

namespace trunnion::choices {

namespace {

using offsets::ControlPosition;

constexpr std::size_t enough_blocks = 2;      ///< for the numbers of a store, beside foreign blocks
constexpr double only_one_block = 2.0 / 3.0;  ///< most that a single block or event can prove
constexpr double still_helps = 0.01;  ///< of what a cause removes: it does so without another one

/// The control with all steps but some.
setup::Setup without(const setup::Setup& setup, const GapSearch& found,
                     const std::set<std::size_t>& left_out) {
    setup::Setup out = setup;
    for (std::size_t k = 0; k < found.steps.size(); ++k)
        if (!left_out.contains(k)) found.steps[k].chosen.take(out);
    return out;
}

/// Part of a loss that is removed.
double removed(const std::vector<double>& before, const std::vector<double>& after) {
    const double sum = sum_of(before);
    return sum > 0.0 ? 1.0 - sum_of(after) / sum : 0.0;
}

/// The cause changes a row by more than what it may have beside it.
bool is_own(const Judged& by, double before, double after) {
    if (!is_changed(before, after)) return false;
    const double least = std::sqrt(by.beside / by.row_limit);
    return by.beside <= by.row_limit || std::abs(std::sqrt(before) - std::sqrt(after)) > least;
}

/// A row's difference, or its part across the segment on which the row slides, is that of `shift`.
bool is_shifted(const LogView& view, const Pair& pair, const ControlPosition& shift, double most) {
    double square = 0.0, along = 0.0, apart = 0.0;
    for (const Axis axis : view.axes) {
        const double own = pair.apart[axis], off = own - shift[axis];
        square += own * own;
        along += own * shift[axis];
        apart += off * off;
    }
    if (!pair.slides) return apart <= most * most;
    return std::abs(along - square) <= most * std::sqrt(std::max(square, most * most));
}

/// In a log that is a part of its program: without the cause all rows from one on, or up to one,
/// have the same difference. Any single event does that, however many blocks follow.
bool is_one_event(const Judged& by, const ComparedRun& rest, const ComparedRun& found) {
    const LogView& view = by.comparer.log();
    const bool ends = !view.whole && ends_before(found);
    if (by.row_limit == infinite_loss || (!ends && !view.begins_within)) return false;
    std::size_t first = view.rows.size(), last = 0;
    const Pair* farthest = nullptr;
    for (const Pair& pair : rest.pairs) {
        if (!is_changed(rest.losses[pair.row], found.losses[pair.row])) continue;
        first = std::min(first, pair.row);
        last = std::max(last, pair.row);
        const auto square = [&](const Pair& of) {
            double sum = 0.0;
            for (const Axis axis : view.axes) sum += of.apart[axis] * of.apart[axis];
            return sum;
        };
        if (farthest == nullptr || square(pair) > square(*farthest)) farthest = &pair;
    }
    if (farthest == nullptr) return false;
    if (!(ends && view.begins_within)) {
        if (ends) last = view.rows.size() - 1;
        if (view.begins_within) first = 0;
    }
    return std::all_of(rest.pairs.begin(), rest.pairs.end(), [&](const Pair& pair) {
        const double most = std::sqrt(by.beside) / view.rows[pair.row].weight;
        return pair.row < first || pair.row > last || is_shifted(view, pair, farthest->apart, most);
    });
}

}  // namespace

namespace {

/// Most that so many blocks can prove of a cause and its rivals together.
double most_by_blocks(const GapCause& cause) {
    const double blocks = static_cast<double>(cause.blocks);
    return (blocks + 1.0) / (blocks + 2.0);
}

}  // namespace

void cap_probability(GapCause& cause, double explained) {
    cause.probability =
        std::min({cause.probability, most_by_blocks(cause), std::max(0.0, explained)});
}

GapCause cause_of(const GapQuestion& question, const GapSearch& found, std::size_t k,
                  const Judged& by) {
    const GapStep& step = found.steps[k];
    const ComparedRun rest = by.comparer.run(without(question.setup, found, {k}));
    GapCause out{step.chosen.name,
                 step.chosen.what,
                 step.chosen.numbers,
                 step.probability,
                 step.rivals,
                 0.0,
                 0,
                 {},
                 {},
                 {}};
    if (by.excess > 0.0) out.share = std::clamp((rest.loss - found.run.loss) / by.excess, 0.0, 1.0);
    const auto changed = [&](std::size_t row) {
        return is_changed(rest.losses[row], found.run.losses[row]);
    };
    out.blocks = changed_blocks(rest.losses, found.run.losses, by.blocks).size();
    // The rest is that of a cause which nobody named: rivals share what is left of it.
    out.probability *= most_by_blocks(out);
    out.first = by.teller.first(rest, changed);
    out.worst = by.teller.worst(rest, changed);
    out.heldout = by.teller.shrink(rest.losses, found.left_out);
    // An exact cause leaves nothing in most of what it touches.
    // Foreign blocks beside it are none of its rows. A store in a single block must explain more
    // than they are, because its numbers fit one of them, too.
    std::vector<double> before = rest.losses, after = found.run.losses, left_out = found.left_out;
    const double all = reached(before, after, by.beside);
    for (std::size_t row = 0; row < before.size(); ++row)
        if (!is_own(by, before[row], after[row])) before[row] = after[row] = left_out[row] = 0.0;
    const double own = 2.0 * std::min(reached(before, after, by.beside),
                                      reached_blocks(before, after, by.blocks, by.beside)) -
                       1.0;
    const bool may_be_foreign = out.blocks < enough_blocks && !step.chosen.numbers.empty();
    cap_probability(out, may_be_foreign ? std::min(own, 4.0 * all - 2.0) : own);
    for (std::size_t row = 0; row < before.size(); ++row)
        if (after[row] > by.beside) before[row] = left_out[row] = 0.0;
    if (by.row_limit < infinite_loss) cap_probability(out, removed(before, left_out));
    if (is_one_event(by, rest, found.run))
        out.probability = std::min(out.probability, only_one_block);
    if (step.only_passes_stop) {
        // All that the log shows of it is that the other control did not stop.
        out.probability = std::min(out.probability, only_one_block);
        out.rivals.push_back("another meaning of the block that stops");
    }
    return out;
}

void cap_by_needed(const GapQuestion& question, const GapSearch& found, const Judged& by,
                   std::vector<GapCause>& causes) {
    const std::size_t n = found.steps.size();
    std::vector<double> loss(n);
    for (std::size_t k = 0; k < n; ++k)
        loss[k] = by.comparer.run(without(question.setup, found, {k})).loss;
    std::vector<std::pair<std::size_t, std::size_t>> needs;
    for (std::size_t k = 0; k < n; ++k)
        for (std::size_t i = k + 1; i < n; ++i) {
            const double neither = by.comparer.run(without(question.setup, found, {i, k})).loss;
            if (neither - loss[i] <= still_helps * (loss[k] - found.run.loss))
                needs.emplace_back(k, i);
            if (neither - loss[k] <= still_helps * (loss[i] - found.run.loss))
                needs.emplace_back(i, k);
        }
    for (std::size_t turn = 0; turn < n; ++turn)
        for (const auto& [k, i] : needs)
            causes[k].probability = std::min(causes[k].probability, causes[i].probability);
}

}  // namespace trunnion::choices
