#include "choices/early_end.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "choices/block_texts.h"
#include "choices/choice_table.h"
#include "choices/gap_notes.h"
#include "choices/space.h"

namespace trunnion::choices {

namespace {

constexpr double rest_sigmas = 6.0;    ///< of a row that stands where another one does
constexpr double on_end_sigmas = 3.0;  ///< of a row that is an end
constexpr double by_chance = 0.02;     ///< of the last distance: most that a sample is off an end
constexpr std::size_t least_rest = 4;  ///< rows at one place, the last one of the motion too
constexpr std::size_t times_slow = 3;  ///< of the rows that a slow motion needs to leave the noise
constexpr double least_way_mm = 1e-3;  ///< or deg: of a move that a log misses
constexpr const char* cut_off = "a log that was cut off";

class LastRows {
  public:
    LastRows(const LogView& view, double sigma)
        : view_(view), space_(view.axes), ball_(rest_sigmas * sigma) {}

    double ball() const { return ball_; }
    double apart(std::size_t row, const offsets::ControlPosition& at) const {
        return std::sqrt(space_.square(view_.rows[row].at, at));
    }
    /// The axes stand in the last rows, longer than anywhere before except at the start.
    bool rest() const {
        const std::size_t n = view_.rows.size(), count = rows_at_end();
        if (count == n) return false;
        const std::size_t enough = std::max(least_rest, times_slow * rows_to_leave(n - count));
        if (logged(n - count, n) < enough) return false;
        std::size_t longest = 0, begin = 0;
        for (std::size_t i = 1; i < n - count; ++i) {
            if (apart(i, view_.rows[begin].at) <= ball_) continue;
            if (begin > 0) longest = std::max(longest, logged(begin, i));
            begin = i;
        }
        return logged(n - count, n) > longest;
    }
    /// The last row is this end, which a sample in motion meets by a small chance only.
    bool meet(const offsets::ControlPosition& end) const {
        const std::size_t n = view_.rows.size();
        if (view_.marked || n < 2) return false;
        const double near = ball_ * on_end_sigmas / rest_sigmas;
        return apart(n - 1, end) <= near && near <= by_chance * apart(n - 1, view_.rows[n - 2].at);
    }

  private:
    /// Rows of the file, those that say the same too.
    std::size_t logged(std::size_t from, std::size_t to) const {
        std::size_t count = to - from;
        for (std::size_t i = from; i < to; ++i)
            count += static_cast<std::size_t>(view_.rows[i].repeated);
        return count;
    }
    std::size_t rows_at_end() const {
        std::size_t count = 1;
        const std::size_t n = view_.rows.size();
        while (count < n && apart(n - 1 - count, view_.rows.back().at) <= ball_) ++count;
        return count;
    }
    /// By the median distance of the rows before the rest.
    std::size_t rows_to_leave(std::size_t moving) const {
        std::vector<double> steps;
        for (std::size_t i = 1; i < moving; ++i)
            if (const double step = apart(i, view_.rows[i - 1].at); step > 0.0)
                steps.push_back(step);
        if (steps.empty()) return 1;
        const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
        std::nth_element(steps.begin(), middle, steps.end());
        return static_cast<std::size_t>(std::ceil(ball_ / *middle));
    }

    const LogView& view_;
    Space space_;
    double ball_;
};

std::size_t last_paired(const ComparedRun& run) {
    std::size_t last = 0;
    for (const Pair& pair : run.pairs) last = std::max<std::size_t>(last, pair.node);
    return last;
}

/// The first node that the log would show if it went on: some way from the last row.
std::optional<std::size_t> first_missing(const LastRows& rows, std::size_t last_row,
                                         const ComparedRun& run) {
    for (std::size_t k = last_paired(run); k < run.path.nodes.size(); ++k)
        if (rows.apart(last_row, run.path.nodes[k].at) > std::max(rows.ball(), least_way_mm))
            return k;
    return std::nullopt;
}

/// Its run ends in an alarm behind the same nodes.
bool stops_behind(const ControlPath& path, const ControlPath& own, std::size_t nodes) {
    if (!path.alarm || path.nodes.size() != nodes) return false;
    ControlPath part;
    part.nodes.assign(own.nodes.begin(), own.nodes.begin() + static_cast<std::ptrdiff_t>(nodes));
    return same_way(part, path);
}

/// Options with which this control stops where the log ends.
std::vector<const Choice*> stopping_choices(const Asked& asked, const LogOfProgram& log,
                                            const setup::Setup& setup, const ComparedRun& run) {
    std::vector<const Choice*> out;
    const Comparer comparer = asked.comparer(log);
    for (const Choice& choice : choice_table()) {
        if (choice.holds(setup)) continue;
        setup::Setup other = setup;
        choice.take(other);
        if (stops_behind(comparer.path(other), run.path, last_paired(run) + 1))
            out.push_back(&choice);
    }
    return out;
}

GapCause cause_of_stop(const std::vector<const Choice*>& choices, const GapPlace& at) {
    GapCause out;
    out.blocks = 1;
    out.first = out.worst = at;
    out.rivals = {cut_off};
    if (choices.empty()) return out;
    out.name = choices.front()->name();
    out.what = choices.front()->what + ": this control then stops where the log ends";
    for (std::size_t k = 1; k < choices.size(); ++k) out.rivals.push_back(choices[k]->name());
    // One block tells of it; the log that was cut off has its part.
    out.probability = 2.0 / 3.0 / static_cast<double>(out.rivals.size() + 1);
    return out;
}

}  // namespace

void tell_early_end(const Asked& asked, const LogOfProgram& log, Answer& answer) {
    ControlGap& gap = answer.gap;
    const ComparedRun run = asked.comparer(log).run(answer.reached);
    if (!ends_before(run)) return;
    const LastRows rows(log.view, log.sigma);
    const std::size_t last_row = log.view.rows.size() - 1;
    const auto missing = first_missing(rows, last_row, run);
    if (!missing) return;
    const PathNode& end = run.path.nodes[last_paired(run)];
    const PathBlock& next = run.path.blocks[run.path.nodes[*missing].block];
    gap.ends_before = {
        next.program, next.line, BlockTexts(asked.question.program, asked.texts).block(next),
        rows.apart(last_row, run.path.nodes[*missing].at), log.view.rows[last_row].line};
    // A trace that begins at the begin has all moves: one that lacks the first ones is a part.
    gap.stands_there =
        log.view.ends ? !log.view.begins_within : rows.rest() || (end.end && rows.meet(end.at));
    if (!gap.stands_there || is_left(gap)) return;
    const bool agrees = gap.verdict == GapVerdict::no_gap;
    const auto choices = stopping_choices(asked, log, answer.reached, run);
    GapCause cause = cause_of_stop(choices, gap.ends_before);
    if (!choices.empty()) {
        gap.verdict = GapVerdict::ambiguous;
        gap.causes.push_back(std::move(cause));
        if (choices.size() == 1) choices.front()->take(gap.setup);
        return;
    }
    gap.verdict = agrees ? GapVerdict::unexplained : GapVerdict::partly_explained;
    cause.what = "the log ends where this control goes on: the other one stopped there";
    add_unknown(gap, 1, std::move(cause));
}

}  // namespace trunnion::choices
