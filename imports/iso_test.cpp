#include "imports/iso_test.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace trunnion::imports {
namespace {

/// +1 or -1 if all points have this direction, else 0.
int only_way(const std::vector<IsoPoint>& points) {
    const int first = points.front().direction;
    const bool one =
        std::all_of(points.begin(), points.end(), [&](auto& p) { return p.direction == first; });
    return one ? first : 0;
}

std::set<double> targets_of(const std::vector<IsoPoint>& points) {
    std::set<double> targets;
    for (const IsoPoint& p : points) targets.insert(p.target);
    return targets;
}

/// A reading may be missing: the targets of one table contain those of the other.
bool same_targets(const IsoTest& a, const IsoTest& b) {
    const std::set<double> one = targets_of(a.series.points), two = targets_of(b.series.points);
    return std::includes(one.begin(), one.end(), two.begin(), two.end()) ||
           std::includes(two.begin(), two.end(), one.begin(), one.end());
}

bool complement(const IsoTest& a, const IsoTest& b) {
    const int way = only_way(a.series.points);
    const auto same = [&](const char* fact) { return a.facts.text(fact) == b.facts.text(fact); };
    return way != 0 && way == -only_way(b.series.points) && a.axis.axis == b.axis.axis &&
           a.what.test == b.what.test && a.series.timed == b.series.timed && same("session") &&
           same("test") && same("at") && same("feature") && same_targets(a, b);
}

/// In the order of their times or, without any: run 1 up, run 1 down, run 2 up ...
void join(IsoTest& one, const IsoTest& other) {
    std::vector<IsoPoint>& points = one.series.points;
    points.insert(points.end(), other.series.points.begin(), other.series.points.end());
    if (one.series.timed) {
        std::stable_sort(points.begin(), points.end(),
                         [](auto& a, auto& b) { return a.time_s < b.time_s; });
        return;
    }
    std::stable_sort(points.begin(), points.end(), [](auto& a, auto& b) {
        return std::pair(a.run, -a.direction) < std::pair(b.run, -b.direction);
    });
    step_times(one.facts, points);
}

}  // namespace

void add_test(std::vector<IsoTest>& tests, IsoTest test, std::vector<std::string>& notes) {
    const auto other = std::find_if(tests.rbegin(), tests.rend(),
                                    [&](const IsoTest& t) { return complement(t, test); });
    const bool one_file = other != tests.rend() && other->table->path() == test.table->path();
    if (other != tests.rend() && !one_file)
        notes.push_back(
            fmt::format("{} and {}: the two directions of {} in two files: each has a "
                        "zero of its own, and the reversal is not read; one file with "
                        "both tables has one zero",
                        other->table->path(), test.table->path(), test.axis.name));
    if (!one_file) {
        tests.push_back(std::move(test));
        return;
    }
    notes.push_back(
        fmt::format("{}: {}: the tables of lines {} and {} are the two directions of "
                    "one test, with one zero",
                    test.table->path(), test.axis.name, other->table->header_line().number,
                    test.table->header_line().number));
    join(*other, test);
}

bool repeats(const IsoTest& earlier, const IsoTest& test) {
    // Another measurement differs by its noise, which is far more of the range.
    constexpr double rounding = 0.05;
    const auto same = [&](const char* fact) {
        return earlier.facts.text(fact) == test.facts.text(fact);
    };
    if (earlier.axis.axis != test.axis.axis || earlier.what.test != test.what.test ||
        earlier.table->path() != test.table->path() || !same("session") || !same("test"))
        return false;
    std::map<std::tuple<double, int, int>, double> known;
    for (const IsoPoint& p : earlier.series.points)
        known[{p.target, p.direction, p.run}] = p.deviation;
    double low = test.series.points.front().deviation, high = low, apart = 0.0;
    for (const IsoPoint& p : test.series.points) {
        const auto it = known.find({p.target, p.direction, p.run});
        if (it == known.end()) return false;
        low = std::min(low, p.deviation);
        high = std::max(high, p.deviation);
        apart = std::max(apart, std::abs(it->second - p.deviation));
    }
    return high > low && apart <= rounding * (high - low);
}

}  // namespace trunnion::imports
