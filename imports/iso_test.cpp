#include "imports/iso_test.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "imports/headings.h"
#include "imports/run_names.h"

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

bool one_axis(const IsoTest& a, const IsoTest& b) {
    const auto same = [&](const char* fact) { return a.facts.text(fact) == b.facts.text(fact); };
    return a.axis.axis == b.axis.axis && a.what.test == b.what.test &&
           a.series.timed == b.series.timed && same("session") && same("test") && same("at") &&
           same("feature") && same_targets(a, b);
}

bool complement(const IsoTest& a, const IsoTest& b) {
    const int way = only_way(a.series.points);
    return way != 0 && way == -only_way(b.series.points) && one_axis(a, b);
}

std::set<std::pair<int, int>> passes_of(const std::vector<IsoPoint>& points) {
    std::set<std::pair<int, int>> passes;
    for (const IsoPoint& p : points) passes.insert({p.run, p.direction});
    return passes;
}

/// A pass that the earlier test does not have, by the headings: "Run 1 up", "Run 2 up".
bool further_run(const IsoTest& a, const IsoTest& b) {
    if (a.run == 0 || b.run == 0 || a.table->path() != b.table->path() || !one_axis(a, b))
        return false;
    const auto known = passes_of(a.series.points), passes = passes_of(b.series.points);
    return std::none_of(passes.begin(), passes.end(),
                        [&](const auto& pass) { return known.contains(pass); });
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

int run_of_heading(const TextTable& table, IsoSeries& series) {
    if (table.headings().empty() || series.points.empty()) return 0;
    const RunName name = run_name(heading_words(table.headings().front().text));
    const bool one_pass = passes_of(series.points).size() == 1;
    if (name.run == 0 || name.other || !one_pass) return 0;
    for (IsoPoint& point : series.points) point.run = name.run;
    return name.run;
}

void add_test(std::vector<IsoTest>& tests, IsoTest test, std::vector<std::string>& notes) {
    const auto other = std::find_if(tests.rbegin(), tests.rend(), [&](const IsoTest& t) {
        return complement(t, test) || further_run(t, test);
    });
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
        fmt::format("{}: {}: the tables of lines {} and {} are {} of one test, with one zero",
                    test.table->path(), test.axis.name, other->table->header_line().number,
                    test.table->header_line().number,
                    complement(*other, test) ? "the two directions" : "runs"));
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
