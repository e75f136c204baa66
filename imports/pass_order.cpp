#include "imports/pass_order.h"

#include <algorithm>
#include <cmath>

#include "base/units.h"

namespace trunnion::imports {
namespace {

/// Consecutive readings at one target.
struct Stand {
    std::size_t begin = 0, count = 0;
    int came = 0, goes = 0;  ///< direction of the step before and after it
};

std::vector<Stand> stands_of(const std::vector<IsoPoint>& points) {
    std::vector<Stand> stands;
    for (std::size_t k = 0; k < points.size(); ++k) {
        const double step = k > 0 ? points[k].target - points[k - 1].target : 0.0;
        if (k > 0 && step == 0.0) {
            ++stands.back().count;
            continue;
        }
        const int direction = step > 0.0 ? 1 : step < 0.0 ? -1 : 0;
        if (k > 0) stands.back().goes = direction;
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

}  // namespace

void unwrap_turns(std::vector<IsoPoint>& points) {
    for (std::size_t k = 1; k < points.size(); ++k) {
        const double step = points[k].target - points[k - 1].target;
        const double turns = std::round(step / (2.0 * pi));
        if (std::abs(step) <= pi || points[k].direction != 0) continue;
        points[k].target -= 2.0 * pi * turns;
    }
}

void follow_order(const TextTable& table, std::vector<IsoPoint>& points) {
    if (std::all_of(points.begin(), points.end(), [](auto& p) { return p.direction != 0; })) return;
    const std::vector<Stand> stands = stands_of(points);
    const std::size_t usual = readings_a_stand(stands);
    int direction = stands.front().came, run = 1;
    for (const Stand& stand : stands) {
        const bool turns = stand.came != stand.goes;
        if (stand.came == 0 || (turns && stand.count > usual && stand.count != 2 * usual))
            table.fail(points[stand.begin + stand.count - 1].row, 0,
                       "targets out of order: from which side was this one?");
        for (std::size_t k = 0; k < stand.count; ++k) {
            const int now =
                turns && stand.count == 2 * usual && k >= usual ? stand.goes : stand.came;
            if (direction < 0 && now > 0) ++run;
            IsoPoint& point = points[stand.begin + k];
            point.direction = direction = now;
            point.run = run;
        }
    }
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
