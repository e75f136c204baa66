#include "choices/late_numbers.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "choices/space.h"

namespace trunnion::choices {

namespace {

constexpr int earliest = -3, latest = 5;  ///< rows that are looked at beside a change
constexpr int window = 3;                 ///< rows among which most changes lie
constexpr int places = latest - earliest + 1;
constexpr std::size_t least_rows = 6;  ///< of a block on each side of a change
constexpr double corner_sigmas = 8.0;  ///< of a row from the chord of its neighbours
constexpr double no_corner = 0.25;     ///< of the largest corner: the change itself has none
constexpr double same_corner = 0.999;
constexpr double most_changes = 0.7, few_changes = 0.3;  ///< of those with a corner
constexpr double some_changes = 0.1;
constexpr int least_changes = 3, many_changes = 6;

/// Squared distance of each row from the chord of its neighbours; rows at rest count as one.
std::vector<double> corners_of(const LogView& log) {
    const Space space(log.axes);
    const std::size_t n = log.rows.size();
    std::vector<double> out(n, 0.0);
    for (std::size_t from = 0, to = 0; from < n; from = to) {
        const double ball = corner_sigmas / log.rows[from].weight;
        const auto& here = log.rows[from].at;
        for (to = from + 1; to < n && space.square(log.rows[to].at, here) <= ball * ball;) ++to;
        if (from == 0 || to == n) continue;
        const auto &a = log.rows[from - 1].at, &b = log.rows[to].at;
        const double apart = space.square(space.between(a, b, space.nearest(a, b, here)), here);
        if (apart > ball * ball)
            std::fill(out.begin() + static_cast<std::ptrdiff_t>(from),
                      out.begin() + static_cast<std::ptrdiff_t>(to), apart);
    }
    return out;
}

using Votes = std::array<int, places>;

/// Lateness for which the rows on both sides of a change turn most; nothing without a corner.
std::optional<int> vote(const std::vector<double>& corners, int change) {
    const auto turn = [&](int late) {
        const int row = change - late;
        if (row < 1 || row >= static_cast<int>(corners.size())) return 0.0;
        return corners[static_cast<std::size_t>(row - 1)] + corners[static_cast<std::size_t>(row)];
    };
    double most = 0.0;
    for (int late = earliest; late <= latest; ++late) most = std::max(most, turn(late));
    if (most <= 0.0) return std::nullopt;
    int best = latest + 1;
    for (int late = earliest; late <= latest; ++late)
        if (turn(late) >= same_corner * most && std::abs(late) < std::abs(best)) best = late;
    // A corner stands between two rows, so the next change has a part of it.
    return std::abs(best) > 1 && turn(0) > no_corner * most ? 0 : best;
}

/// Changes between two blocks with so many rows that their other corners are out of reach.
Votes votes_of(const LogView& log) {
    const std::vector<double> corners = corners_of(log);
    const auto same = [&log](std::size_t from, std::size_t to) {
        const int key = log.rows[from].key;
        return key >= 0 && std::all_of(log.rows.begin() + static_cast<std::ptrdiff_t>(from),
                                       log.rows.begin() + static_cast<std::ptrdiff_t>(to),
                                       [key](const LogView::Row& row) { return row.key == key; });
    };
    Votes out{};
    for (std::size_t i = least_rows; i + least_rows <= log.rows.size(); ++i) {
        if (log.rows[i - 1].key == log.rows[i].key) continue;
        if (!same(i - least_rows, i) || !same(i, i + least_rows)) continue;
        if (const auto late = vote(corners, static_cast<int>(i)))
            ++out[static_cast<std::size_t>(*late - earliest)];
    }
    return out;
}

}  // namespace

std::optional<Lateness> lateness_of(const LogView& log) {
    if (log.ends || log.keys < 2) return std::nullopt;
    const Votes votes = votes_of(log);
    int all = 0, best = 0, most = 0;
    for (const int count : votes) all += count;
    for (int first = 0; first + window <= places; ++first) {
        int sum = 0;
        for (int k = first; k < first + window; ++k) sum += votes[static_cast<std::size_t>(k)];
        if (sum > most) {
            most = sum;
            best = first;
        }
    }
    const int in_time = votes[static_cast<std::size_t>(-earliest)];
    const bool sure = all >= many_changes
                          ? most >= most_changes * all && in_time < few_changes * all
                          : all >= least_changes && most == all && in_time == 0;
    if (!sure) return std::nullopt;
    Lateness out{latest, earliest};
    for (int k = best; k < best + window; ++k) {
        if (votes[static_cast<std::size_t>(k)] < some_changes * all) continue;
        out.least = std::min(out.least, k + earliest);
        out.most = std::max(out.most, k + earliest);
    }
    return out;
}

LogView without_lateness(const LogView& log, const Lateness& late) {
    LogView out = log;
    const int n = static_cast<int>(log.rows.size());
    for (int i = 0; i < n; ++i) {
        // The number of this row stands between the least and the most lateness behind it.
        const int from = i + late.least - 1, to = i + late.most + 1;
        int key = from < 0 || to >= n ? -1 : log.rows[static_cast<std::size_t>(from)].key;
        for (int k = from; k <= to && key >= 0; ++k)
            if (log.rows[static_cast<std::size_t>(k)].key != key) key = -1;
        out.rows[static_cast<std::size_t>(i)].key = key;
    }
    return out;
}

}  // namespace trunnion::choices
