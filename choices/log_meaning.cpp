#include "choices/log_meaning.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <set>

#include "choices/late_numbers.h"
#include "estimation/distributions.h"

namespace trunnion::choices {

namespace {

constexpr double quiet_mean = 1.5;        ///< mean loss below which there is no gap
constexpr double quiet_worst = 6.0;       ///< and the largest distance, in sigma
constexpr double noise_by_chance = 1e-6;  ///< p of what noise does that is not well known
constexpr double other_meaning = 0.1;     ///< of the loss: most that another reading may leave
constexpr double other_lateness = 0.05;   ///< the same where no corner shows it
constexpr std::size_t most_unlogged = 2;  ///< blocks that a control may leave out at the start
constexpr std::size_t least_wrong = 3;    ///< blocks with rows that their numbers do not fit
constexpr std::size_t rows_a_change = 8;  ///< of a log whose numbers may be late
constexpr double shown_loss = 9.0;        ///< of an axis, at a change of the number
constexpr int earliest_shift = -3, latest_shift = 5;

/// One reading of a log.
struct Meaning {
    LogOfProgram log;
    ComparedRun run;
};

/// Blocks with motion before the first row.
std::size_t blocks_before(const ComparedRun& run) {
    std::size_t first = run.path.nodes.size();
    for (const Pair& pair : run.pairs) first = std::min<std::size_t>(first, pair.node);
    std::set<std::uint32_t> blocks;
    for (std::size_t k = 1; k < first; ++k) blocks.insert(run.path.nodes[k].block);
    if (first < run.path.nodes.size()) blocks.erase(run.path.nodes[first].block);
    return blocks.size();
}

/// Most rows stand far from a change of the number.
bool is_dense(const LogView& view) {
    std::size_t changes = 0;
    for (std::size_t i = 1; i < view.rows.size(); ++i)
        changes += view.rows[i].key != view.rows[i - 1].key ? 1 : 0;
    return view.keys > 1 && view.rows.size() > rows_a_change * changes;
}

class Meanings {
  public:
    Meanings(const LogSource& source, LogOfProgram& log)
        : source_(source), now_{log, source.run(log)} {}

    void settle() {
        settle_part();
        settle_lateness();
    }
    /// What stays in one or two blocks may be another end of these.
    std::optional<LogOfProgram> in_order() const {
        if (is_settled() || now_.log.view.keys == 0 || wrong_blocks() < least_wrong)
            return std::nullopt;
        Meaning other = meaning(without_numbers(now_.log));
        if (!is_quiet(other.log, other.run)) return std::nullopt;
        return std::move(other.log);
    }
    /// False: the log stays.
    bool settle_lateness() {
        if (is_settled() || now_.log.late) return false;
        const LogView view = now_.log.view;
        if (const auto late = lateness_of(view)) {
            Meaning moved = late_by(view, *late);
            if (moved.run.loss >= now_.run.loss) return false;
            now_ = std::move(moved);
            return true;
        }
        if (view.ends || !is_dense(view)) return false;
        std::optional<Meaning> best;
        double limit = other_lateness * now_.run.loss;
        for (int shift = earliest_shift; shift <= latest_shift; ++shift) {
            if (shift == 0) continue;
            Meaning moved = late_by(view, {shift, shift});
            if (moved.run.loss >= limit || !most_changes_show(moved, shift)) continue;
            limit = moved.run.loss;
            best = std::move(moved);
        }
        if (best) now_ = std::move(*best);
        return best.has_value();
    }
    LogOfProgram log() { return std::move(now_.log); }

  private:
    Meaning meaning(LogOfProgram log) const {
        ComparedRun run = source_.run(log);
        return {std::move(log), std::move(run)};
    }
    bool is_settled() const { return is_quiet(now_.log, now_.run); }
    /// One block with another end may look like late numbers of that block alone.
    bool most_changes_show(const Meaning& moved, int shift) const {
        const auto& rows = now_.log.view.rows;
        const std::size_t reach = static_cast<std::size_t>(std::abs(shift)) + 1;
        const double shown = shown_loss * static_cast<double>(now_.log.view.axes.size());
        std::size_t changes = 0, show = 0;
        for (std::size_t i = 1; i < rows.size(); ++i) {
            if (rows[i].key == rows[i - 1].key) continue;
            double gain = 0.0;
            for (std::size_t k = i - std::min(i, reach); k < std::min(rows.size(), i + reach); ++k)
                gain += now_.run.losses[k] - moved.run.losses[k];
            ++changes;
            show += gain > shown ? 1 : 0;
        }
        return 2 * show > changes;
    }

    /// Lines from 0, a log of a part of the program, or both; or another start.
    void settle_part() {
        if (is_settled()) return;
        std::vector<Meaning> others;
        others.push_back(part(now_.log));
        if (!now_.log.view.ends) others.push_back(meaning(from_machine_zero(now_.log)));
        if (auto zero = from_zero()) {
            others.push_back(part(*zero));
            others.push_back(meaning(std::move(*zero)));
        }
        // Later ones say less that is unusual, or as much.
        Meaning* best = nullptr;
        for (Meaning& other : others) {
            const double limit = best ? best->run.loss : other_meaning * now_.run.loss;
            const bool simpler = best && other.run.loss <= limit + noise();
            if (is_possible(other) && (other.run.loss < limit || simpler)) best = &other;
        }
        if (best != nullptr) now_ = std::move(*best);
    }
    std::size_t wrong_blocks() const {
        const double most = static_cast<double>(now_.log.view.axes.size()) * shown_loss;
        std::set<int> out;
        for (std::size_t row = 0; row < now_.run.losses.size(); ++row)
            if (now_.run.losses[row] > most) out.insert(now_.log.view.rows[row].key);
        return out.size();
    }
    double noise() const {
        return static_cast<double>(now_.log.view.axes.size() * now_.log.view.rows.size());
    }
    Meaning part(LogOfProgram log) const { return meaning(begun_within(std::move(log))); }
    static bool is_possible(const Meaning& other) {
        return !other.log.view.begins_within || lacks_begin(other.log, other.run);
    }
    std::optional<LogOfProgram> from_zero() const {
        if (now_.log.view.keys == 0 || now_.log.by_number) return std::nullopt;
        records::PositionLog log = source_.log;
        for (records::LoggedPosition& row : log.rows)
            if (row.block > 0) ++row.block;
        try {
            LogOfProgram out = log_of_program(log, source_.texts);
            out.lines_from_0 = true;
            out.notes.push_back(log.path + ": the lines agree if the first one is 0");
            return out;
        } catch (const InputError&) {  // a line beyond the last
            return std::nullopt;
        }
    }

    Meaning late_by(const LogView& view, const Lateness& late) const {
        LogOfProgram log = now_.log;
        log.view = without_lateness(view, late);
        log.late = true;
        const bool behind = late.most > 0;
        const int least = std::min(std::abs(late.least), std::abs(late.most)),
                  most = std::max(std::abs(late.least), std::abs(late.most));
        log.notes.push_back(fmt::format(
            "the numbers of blocks are {} rows {} the positions: rows at the changes are assigned "
            "by their positions",
            least == most ? fmt::format("{}", most) : fmt::format("{} to {}", least, most),
            behind ? "behind" : "ahead of"));
        return meaning(std::move(log));
    }

    const LogSource& source_;
    Meaning now_;
};

}  // namespace

bool is_quiet(const LogOfProgram& log, const ComparedRun& run) {
    double worst = 0.0;
    for (const double loss : run.losses) worst = std::max(worst, loss);
    const double axes = static_cast<double>(log.view.axes.size()),
                 rows = static_cast<double>(run.losses.size()), freedom = log.view.freedom;
    // Noise that nobody knows may be anything.
    const bool known = log.noise == LogNoise::given || std::isfinite(freedom);
    const auto is_chance = [&](double loss, double terms, double cases) {
        const double p = std::isfinite(freedom) ? estimation::f_tail(loss / terms, terms, freedom)
                                                : estimation::chi_squared_tail(loss, terms);
        return known && cases * p > noise_by_chance;
    };
    return (run.loss <= quiet_mean * axes * rows || is_chance(run.loss, axes * rows, 1.0)) &&
           (worst <= axes * quiet_worst * quiet_worst || is_chance(worst, axes, rows));
}

LogOfProgram from_machine_zero(LogOfProgram log) {
    log.view.from_zero = true;
    log.path.start = {};
    log.notes.emplace_back(
        "the control started at its machine zero, and the first row of the log stands on its first "
        "move");
    return log;
}

LogOfProgram begun_within(LogOfProgram log) {
    log.view.begins_within = true;
    log.path.start = {};  // its first row is not where the program began
    return log;
}

bool lacks_begin(const LogOfProgram& log, const ComparedRun& run) {
    return blocks_before(run) > (log.view.ends ? most_unlogged : 0);
}

LogOfProgram without_numbers(LogOfProgram log) {
    log.view.keys = 0;
    log.view.key_of = [](const PathBlock&) { return -1; };
    for (LogView::Row& row : log.view.rows) row.key = -1;
    log.notes.emplace_back(
        "the numbers of blocks do not fit: the positions agree in their order, by which the rows "
        "are assigned");
    return log;
}

void settle_meaning(const LogSource& source, LogOfProgram& log) {
    Meanings meanings(source, log);
    meanings.settle();
    log = meanings.log();
}

std::optional<LogOfProgram> agreeing_in_order(const LogSource& source, LogOfProgram log) {
    return Meanings(source, log).in_order();
}

bool settle_lateness(const LogSource& source, LogOfProgram& log) {
    Meanings meanings(source, log);
    if (!meanings.settle_lateness()) return false;
    log = meanings.log();
    return true;
}

}  // namespace trunnion::choices
