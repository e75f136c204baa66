#include "imports/pass_order.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "base/units.h"

namespace trunnion::imports {
namespace {

/// Consecutive readings at one target.
struct Stand {
    std::size_t begin = 0, count = 0;
    int came = 0, goes = 0;  ///< direction of the step before and after it
};

/// The stands of points[begin] to points[end - 1].
std::vector<Stand> stands_of(const std::vector<IsoPoint>& points, std::size_t begin,
                             std::size_t end) {
    std::vector<Stand> stands;
    for (std::size_t k = begin; k < end; ++k) {
        const double step = k > begin ? points[k].target - points[k - 1].target : 0.0;
        if (k > begin && step == 0.0) {
            ++stands.back().count;
            continue;
        }
        const int direction = step > 0.0 ? 1 : step < 0.0 ? -1 : 0;
        if (k > begin) stands.back().goes = direction;
        stands.push_back({k, 1, direction, 0});
    }
    if (stands.front().came == 0) stands.front().came = stands.front().goes;
    if (stands.back().goes == 0) stands.back().goes = stands.back().came;
    return stands;
}

/// Number of readings at each target in passing; 1 if none is passed.
std::size_t readings_a_stand(const std::vector<Stand>& stands) {
    std::size_t least = 0;
    for (std::size_t k = 1; k + 1 < stands.size(); ++k)
        if (stands[k].came == stands[k].goes && (least == 0 || stands[k].count < least))
            least = stands[k].count;
    return std::max<std::size_t>(1, least);
}

/// First points of the runs of a column if the targets of every run rise, or those of every run
/// fall; else empty.
std::vector<std::size_t> starts_of_runs(const std::vector<IsoPoint>& points) {
    std::vector<std::size_t> starts{0};
    std::set<int> runs{points.front().run};
    bool up = false, down = false;
    for (std::size_t k = 1; k < points.size(); ++k) {
        if (points[k].run == points[k - 1].run) {
            up |= points[k].target > points[k - 1].target;
            down |= points[k].target < points[k - 1].target;
            continue;
        }
        if (!runs.insert(points[k].run).second) return {};
        starts.push_back(k);
    }
    return starts.size() > 1 && up != down ? starts : std::vector<std::size_t>();
}

bool passes_a_target(const std::vector<IsoPoint>& points, double from, double to) {
    return std::any_of(points.begin(), points.end(), [&](const IsoPoint& p) {
        return (p.target - from) * (p.target - to) < 0.0;
    });
}

/// Passes that all begin at the first target again: back over other targets without a reading, then
/// on in the old direction. If one direction is told, back over none will do.
std::vector<std::size_t> starts_by_steps(const std::vector<IsoPoint>& points, bool one_way) {
    const std::vector<Stand> stands = stands_of(points, 0, points.size());
    std::vector<std::size_t> starts{0};
    int way = stands.front().came;
    for (std::size_t k = 1; k < stands.size(); ++k) {
        if (stands[k].came == way) continue;
        const bool last = k + 1 == stands.size();
        const bool over = passes_a_target(points, points[stands[k].begin - 1].target,
                                          points[stands[k].begin].target);
        if ((over || one_way) && (last ? starts.size() > 1 : stands[k].goes == way))
            starts.push_back(stands[k].begin);
        else
            way = stands[k].came;
    }
    return starts;
}

/// The passes before the one that is being read.
struct PassesRead {
    int direction = 0, run = 1;
};

/// Directions and runs of points[begin] to points[end - 1], which no jump interrupts.
void follow_steps(const TextTable& table, std::vector<IsoPoint>& points, std::size_t begin,
                  std::size_t end, PassesRead& read) {
    std::vector<Stand> stands = stands_of(points, begin, end);
    if (stands.size() == 1) stands[0].came = stands[0].goes = read.direction;
    const std::size_t usual = readings_a_stand(stands);
    if (begin > 0 && read.direction == stands.front().came) ++read.run;
    for (const Stand& stand : stands) {
        const bool turns = stand.came != stand.goes;
        if (stand.came == 0 || (turns && stand.count > usual && stand.count != 2 * usual))
            table.fail(points[stand.begin + stand.count - 1].row, 0,
                       "targets out of order: from which side was this one?");
        for (std::size_t k = 0; k < stand.count; ++k) {
            const int now =
                turns && stand.count == 2 * usual && k >= usual ? stand.goes : stand.came;
            if (read.direction < 0 && now > 0) ++read.run;
            IsoPoint& point = points[stand.begin + k];
            point.direction = read.direction = now;
            point.run = read.run;
        }
    }
}

}  // namespace

void unwrap_turns(std::vector<IsoPoint>& points) {
    for (std::size_t k = 1; k < points.size(); ++k) {
        const double step = points[k].target - points[k - 1].target;
        const double turns = std::round(step / (2.0 * pi));
        if (std::abs(step) <= pi || points[k].direction != 0) continue;
        points[k].target -= 2.0 * pi * turns;
    }
}

void follow_order(const TextTable& table, std::vector<IsoPoint>& points, int way) {
    if (std::all_of(points.begin(), points.end(), [](auto& p) { return p.direction != 0; })) return;
    std::vector<std::size_t> starts = starts_of_runs(points);
    if (starts.empty()) starts = starts_by_steps(points, way != 0);
    PassesRead read;
    for (std::size_t k = 0; k < starts.size(); ++k)
        follow_steps(table, points, starts[k],
                     k + 1 < starts.size() ? starts[k + 1] : points.size(), read);
    const int first = points.front().direction;
    const bool one_way =
        std::all_of(points.begin(), points.end(), [&](auto& p) { return p.direction == first; });
    if (way != 0 && one_way)
        for (IsoPoint& point : points) point.direction = way;
}

bool turn_passes(std::vector<IsoPoint>& points) {
    bool turned = false;
    for (std::size_t begin = 0, end = 0; begin < points.size(); begin = end) {
        const IsoPoint first = points[begin];
        bool against = true;
        for (end = begin + 1; end < points.size() && points[end].run == first.run &&
                              points[end].direction == first.direction;
             ++end)
            against &= (points[end].target - points[end - 1].target) * first.direction <= 0.0;
        if (!against || points[end - 1].target == first.target) continue;
        for (std::size_t a = begin, b = end - 1; a < b; ++a, --b) {
            std::swap(points[a], points[b]);
            std::swap(points[a].time_s, points[b].time_s);
        }
        turned = true;
    }
    return turned;
}

void check_order(const TextTable& table, const std::vector<IsoPoint>& points) {
    for (std::size_t k = 1; k < points.size(); ++k) {
        const IsoPoint &a = points[k - 1], &b = points[k];
        const bool same = a.run == b.run && a.direction == b.direction;
        if (same && (b.target - a.target) * b.direction < 0.0)
            table.fail(b.row, 0, "targets out of order within a run");
    }
}

}  // namespace trunnion::imports
