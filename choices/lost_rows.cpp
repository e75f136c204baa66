#include "choices/lost_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "choices/space.h"

namespace trunnion::choices {

namespace {

// All of these are assumed.
constexpr double breaks_off = 2.0;  ///< distances of samples before the end of a motion
constexpr double bends_a_little = 0.87, goes_straight = 1.0 - 1e-6;  ///< cosines
constexpr double least_lost = 4.0;          ///< distances of samples: of feeds without a row
constexpr std::size_t least_on_feeds = 50;  ///< pairs of rows on one feed, which tell its period
constexpr double noise_of_step = 6.0;       ///< sigmas: a shorter distance is none
constexpr double is_wrong = 1e-3;    ///< of the loss: least of a place where rows may be lost
constexpr double almost_all = 0.05;  ///< of the loss: most that stays with the places cut
constexpr std::size_t most_places = 10, rows_a_place = 100;
constexpr std::size_t told_places = 3;
constexpr std::size_t rows_beside = 3;
constexpr std::uint32_t no_node = 0;

/// Where the rows stand on the path, and how far its corners are.
class RowsOnPath {
  public:
    RowsOnPath(const LogView& view, const ComparedRun& run)
        : view_(view), run_(run), path_(run.path), space_(view.axes), place_(view.rows.size()) {
        along_.assign(path_.nodes.size(), 0.0);
        for (std::size_t k = 1; k < along_.size(); ++k) along_[k] = along_[k - 1] + length(k);
        for (const Pair& pair : run.pairs) {
            Place& own = place_[pair.row];
            if (pair.node == no_node || (own.node != no_node && !is_of_block(pair))) continue;
            own = {pair.node, along_[pair.node] - (1.0 - pair.fraction) * length(pair.node)};
        }
    }

    /// Rows are missing behind this one.
    bool is_broken(std::size_t i) const {
        if (i < 2 || i + 3 >= view_.rows.size() || view_.rows[i].cut) return false;
        if (!is_near_wrong_row(i)) return false;
        const Place &from = place_[i], &to = place_[i + 1];
        if (from.node == no_node || to.node == no_node) return false;
        const double between = to.along - from.along;
        const double before = std::max(step(i - 1), step(i - 2)),
                     behind = std::max(step(i + 1), step(i + 2));
        const auto is_way = [&](double step_mm) {
            return step_mm > noise_of_step / view_.rows[i].weight && between > breaks_off * step_mm;
        };
        const double end = end_of_move(from), begin = begin_of_move(to);
        const bool leaves =
            is_way(before) && end < to.along && end - from.along > breaks_off * before;
        const bool enters =
            is_way(behind) && begin > from.along && to.along - begin > breaks_off * behind;
        if (leaves == enters) return leaves;
        return feed_between(from, to) > least_lost * (leaves ? before : behind);
    }

    /// Of two rows on one move at a feed: their distance over it; else 0.
    double minutes_behind(std::size_t i) const {
        const Place &from = place_[i], &to = place_[i + 1];
        if (from.node == no_node || to.node == no_node || view_.rows[i].cut) return 0.0;
        const double feed = path_.nodes[from.node].feed_mm_min;
        if (feed <= 0.0 || begin_of_path(from.node) != begin_of_path(to.node)) return 0.0;
        return step(i) / feed;
    }

  private:
    struct Place {
        std::uint32_t node = no_node;
        double along = 0.0;  ///< of the path, mm and deg
    };
    /// Rows behind lost ones may have found another place, and show it a little later.
    bool is_near_wrong_row(std::size_t i) const {
        const auto begin = run_.losses.begin();
        const std::size_t first = i - std::min(i, rows_beside);
        const std::size_t last = std::min(i + 1 + rows_beside, run_.losses.size() - 1);
        return std::any_of(begin + static_cast<std::ptrdiff_t>(first),
                           begin + static_cast<std::ptrdiff_t>(last) + 1,
                           [this](double loss) { return loss > is_wrong * run_.loss; });
    }
    /// The last pair of a row in its block is that of its own place. (Those of blocks without rows
    /// follow.)
    bool is_of_block(const Pair& pair) const {
        const int key = view_.rows[pair.row].key;
        return key < 0 || view_.key_of(path_.blocks[path_.nodes[pair.node].block]) == key;
    }
    double step(std::size_t i) const {
        return std::sqrt(space_.square(view_.rows[i].at, view_.rows[i + 1].at));
    }
    double length(std::size_t k) const {
        return std::sqrt(space_.square(path_.nodes[k - 1].at, path_.nodes[k].at));
    }
    /// A move ends here: the path has a corner. Where it goes straight on, its speed may change (a
    /// rapid and a feed to one depth); where it bends a little, it is a curve of short moves.
    bool ends(std::size_t k) const {
        if (k + 1 >= path_.nodes.size()) return true;
        if (!path_.nodes[k].end) return false;
        const auto in = space_.apart(path_.nodes[k].at, path_.nodes[k - 1].at),
                   out = space_.apart(path_.nodes[k + 1].at, path_.nodes[k].at);
        double dot = 0.0;
        for (const Axis axis : view_.axes) dot += in[axis] * out[axis];
        const double cosine = dot / std::max(length(k) * length(k + 1), 1e-12);
        return cosine < bends_a_little || cosine > goes_straight;
    }
    /// The node where the move to this one begins.
    std::size_t begin_of_path(std::size_t k) const {
        do --k;
        while (k > 0 && !path_.nodes[k].end);
        return k;
    }
    double end_of_move(const Place& place) const {
        std::size_t k = place.node;
        while (!ends(k)) ++k;
        return along_[k];
    }
    double begin_of_move(const Place& place) const {
        std::size_t k = place.node - 1;
        while (k > 0 && !ends(k)) --k;
        return along_[k];
    }

    /// Length of the moves at a feed that have no row.
    double feed_between(const Place& from, const Place& to) const {
        double sum = 0.0;
        const double first = end_of_move(from), last = begin_of_move(to);
        for (std::size_t k = from.node; k <= to.node; ++k)
            if (path_.nodes[k].feed_mm_min > 0.0 && along_[k - 1] >= first && along_[k] <= last)
                sum += length(k);
        return sum;
    }

    const LogView& view_;
    const ComparedRun& run_;
    const ControlPath& path_;
    Space space_;
    std::vector<Place> place_;
    std::vector<double> along_;  ///< from the start to each node
};

}  // namespace

std::optional<LogOfProgram> with_lost_rows(LogOfProgram log, const ComparedRun& run) {
    LogView& view = log.view;
    if (view.ends) return std::nullopt;
    const RowsOnPath rows(view, run);
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i + 1 < view.rows.size(); ++i)
        if (rows.is_broken(i)) places.push_back(i);
    if (places.empty() || places.size() > std::min(most_places, view.rows.size() / rows_a_place))
        return std::nullopt;
    for (std::size_t n = 0; n < places.size(); ++n) {
        view.rows[places[n]].cut = true;
        if (n < told_places)
            log.notes.push_back(fmt::format(
                "the samples break off within a move at line {} of the log, and go on within "
                "another one: rows are missing, and what the control does there is not judged",
                view.rows[places[n]].line));
    }
    return log;
}

double minutes_of_samples(const LogView& view, const ComparedRun& run) {
    if (view.ends) return 0.0;
    const RowsOnPath rows(view, run);
    std::vector<double> minutes;
    for (std::size_t i = 0; i + 1 < view.rows.size(); ++i)
        if (const double own = rows.minutes_behind(i); own > 0.0) minutes.push_back(own);
    if (minutes.size() < least_on_feeds) return 0.0;
    std::nth_element(minutes.begin(), minutes.end() - 3, minutes.end());
    return *(minutes.end() - 3);
}

void settle_lost_rows(const Asked& asked, LogOfProgram& log) {
    const ComparedRun own = asked.comparer(log).run(asked.question.setup);
    if (is_quiet(log, own)) return;
    auto other = with_lost_rows(log, own);
    if (!other) return;
    const ComparedRun run = asked.comparer(*other).run(asked.question.setup);
    if (run.loss <= almost_all * own.loss || is_quiet(*other, run)) log = std::move(*other);
}

}  // namespace trunnion::choices
