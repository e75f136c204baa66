// The alignment in windows: nothing lost, nothing twice, whatever the size of the window.
#include "regression/align.h"

#include <catch2/catch.hpp>
#include <string>

#include "base/random.h"
#include "regression/program_lines.h"
#include "tests/regression/paths.h"

using namespace trunnion;
using namespace trunnion::testing;

namespace {

regression::Keys chosen(const regression::Keys& keys, const regression::PassRanges& ranges) {
    regression::Keys out;
    for (const regression::PassRange& range : ranges)
        for (std::uint64_t k = range.first; k < range.last; ++k) out.push_back(keys[k]);
    return out;
}

/// `most_read`: the most items of one side that were read at a time.
std::vector<regression::PassPair> aligned(const regression::Keys& a, const regression::Keys& b,
                                          regression::AlignLimits limits,
                                          std::size_t* most_read = nullptr) {
    const regression::AlignSource source{
        a.size(), b.size(), [&](std::uint64_t i, std::uint64_t j) { return a[i] == b[j]; },
        [&](const regression::PassRanges& in_a, const regression::PassRanges& in_b,
            regression::Keys& keys_a, regression::Keys& keys_b) {
            keys_a = chosen(a, in_a);
            keys_b = chosen(b, in_b);
            if (most_read) *most_read = std::max({*most_read, keys_a.size(), keys_b.size()});
        }};
    std::vector<regression::PassPair> pairs;
    regression::align(source, limits,
                      [&](const regression::PassPair& pair) { pairs.push_back(pair); });
    return pairs;
}

regression::AlignLimits windows(std::uint64_t size) {
    regression::AlignLimits limits;
    limits.window = size;
    limits.most_window = 4 * size;
    return limits;
}

/// Every item of both sides stands in exactly one pairing, and what is called alike is.
void check_complete(const regression::Keys& a, const regression::Keys& b,
                    const std::vector<regression::PassPair>& pairs) {
    std::vector<int> seen_a(a.size()), seen_b(b.size());
    for (const regression::PassPair& p : pairs) {
        for (std::uint64_t k = p.a.first; k < p.a.last; ++k) ++seen_a[k];
        for (std::uint64_t k = p.b.first; k < p.b.last; ++k) ++seen_b[k];
        if (p.pairing == regression::Pairing::same || p.pairing == regression::Pairing::reordered)
            for (std::uint64_t k = 0; k < p.a.size(); ++k)
                REQUIRE(a[p.a.first + k] == b[p.b.first + k]);
        REQUIRE((p.pairing == regression::Pairing::only_a) == (p.b.size() == 0));
        REQUIRE((p.pairing == regression::Pairing::only_b) == (p.a.size() == 0));
    }
    REQUIRE(std::count(seen_a.begin(), seen_a.end(), 1) == static_cast<long>(a.size()));
    REQUIRE(std::count(seen_b.begin(), seen_b.end(), 1) == static_cast<long>(b.size()));
}

std::size_t count_of(const std::vector<regression::PassPair>& pairs, regression::Pairing pairing) {
    std::size_t count = 0;
    for (const regression::PassPair& p : pairs)
        if (p.pairing == pairing) count += std::max(p.a.size(), p.b.size());
    return count;
}

regression::Keys numbers(std::size_t count) {
    regression::Keys keys(count);
    for (std::size_t k = 0; k < count; ++k) keys[k] = 1000 + k;
    return keys;
}

}  // namespace

TEST_CASE("random edits leave every item in exactly one pairing, in windows of any size",
          "[compare]") {
    SeededNoise noise(11);
    const auto pick = [&](std::size_t count) {
        return static_cast<std::size_t>(noise.bits() % count);
    };
    for (int round = 0; round < 300; ++round) {
        regression::Keys a(40 + pick(400));
        for (auto& key : a) key = pick(round % 2 == 0 ? 100000 : 30);  // unique, or often repeated
        regression::Keys b = a;
        for (std::size_t edits = pick(12); edits > 0 && !b.empty(); --edits) {
            const auto at = b.begin() + static_cast<std::ptrdiff_t>(pick(b.size()));
            const std::uint64_t key = *at;
            if (pick(3) == 0)
                b.insert(at, pick(100000));
            else
                b.erase(at);
            if (pick(2) == 0)
                b.insert(b.begin() + static_cast<std::ptrdiff_t>(pick(b.size() + 1)), key);
        }
        for (const std::uint64_t size : {4, 16, 100, 10000})
            check_complete(a, b, aligned(a, b, windows(size)));
    }
}

TEST_CASE("items that moved are reordered at any distance, a run of them as one", "[compare]") {
    const regression::Keys a = numbers(20000);
    const auto at = [](std::size_t k) { return static_cast<std::ptrdiff_t>(k); };
    const std::size_t run = GENERATE(1, 7);
    const std::size_t to = GENERATE(190, 5000, 19000);
    regression::Keys b = a;
    b.erase(b.begin() + 100, b.begin() + at(100 + run));
    b.insert(b.begin() + at(to), a.begin() + 100, a.begin() + at(100 + run));
    for (const std::uint64_t size : {16, 128, 1 << 14}) {
        const auto pairs = aligned(a, b, windows(size));
        INFO("run of " << run << " to " << to << " in windows of " << size);
        check_complete(a, b, pairs);
        CHECK(count_of(pairs, regression::Pairing::reordered) == run);
        CHECK(count_of(pairs, regression::Pairing::same) == a.size() - run);
        CHECK(std::count_if(pairs.begin(), pairs.end(), [](const regression::PassPair& p) {
                  return p.pairing == regression::Pairing::reordered;
              }) == 1);
    }
}

TEST_CASE("two halves that changed places are one run, however long", "[compare]") {
    const regression::Keys a = numbers(60000);
    regression::Keys b = a;
    std::rotate(b.begin(), b.begin() + 25000, b.end());
    const auto pairs = aligned(a, b, {});
    check_complete(a, b, pairs);
    CHECK(count_of(pairs, regression::Pairing::reordered) == 25000);
    CHECK(count_of(pairs, regression::Pairing::same) == 35000);
}

TEST_CASE("an insertion longer than a window leaves the rest paired one by one", "[compare]") {
    const regression::Keys a = numbers(100);
    for (const std::size_t inserted : {40, 63, 64, 65, 500}) {
        regression::Keys b = a;
        const regression::Keys more(inserted, 7);
        b.insert(b.begin() + 50, more.begin(), more.end());
        regression::AlignLimits limits;
        limits.window = 16;
        INFO(inserted);
        const auto pairs = aligned(a, b, limits);
        check_complete(a, b, pairs);
        CHECK(count_of(pairs, regression::Pairing::same) == 100);
        CHECK(count_of(pairs, regression::Pairing::only_b) == inserted);
        const auto taken_out = aligned(b, a, limits);
        check_complete(b, a, taken_out);
        CHECK(count_of(taken_out, regression::Pairing::same) == 100);
        CHECK(count_of(taken_out, regression::Pairing::only_a) == inserted);
    }
}

TEST_CASE("no more is read than the smallest window with a match in its first three quarters",
          "[align]") {
    const regression::Keys a = numbers(4000);
    regression::AlignLimits limits;
    limits.window = 16;
    limits.reordering = false;
    for (std::size_t inserted = 1; inserted <= 200; ++inserted) {
        regression::Keys b = a;
        b.insert(b.begin() + 1500, inserted, 7);
        std::size_t window = 16, there = 0, back = 0;
        while (4 * inserted >= 3 * window) window *= 4;
        INFO(inserted);
        CHECK(count_of(aligned(a, b, limits, &there), regression::Pairing::same) == a.size());
        CHECK(count_of(aligned(b, a, limits, &back), regression::Pairing::same) == a.size());
        CHECK(there == window);
        CHECK(back == window);
    }
}

TEST_CASE("a spilled array gives back what went in, across the border of memory and disk",
          "[compare]") {
    using Array = regression::SpilledArray<regression::KeyedLine>;
    Array array;
    const std::uint64_t count = Array::kept_in_memory * 3 + 17;
    for (std::uint64_t k = 0; k < count; ++k) array.append({k * k, static_cast<std::uint32_t>(k)});
    REQUIRE(array.size() == count);
    regression::SpilledWindow<regression::KeyedLine> window(array);
    SeededNoise noise(2);
    bool right = true;
    for (std::uint64_t k = 0; k < count; ++k) right = right && window[k].key == k * k;
    for (int n = 0; n < 100000; ++n) {
        const std::uint64_t k = noise.bits() % count;
        right = right && window[k].key == k * k && window[k].line == k;
    }
    CHECK(right);
}

TEST_CASE("beyond the resync window the verdict stays right and the search goes on behind it",
          "[compare]") {
    // A cut of 400 segments in which B has 60 more, far away; both run together again behind them.
    const auto cut = [](Pen& pen, std::size_t from, std::size_t to, double y) {
        SeededNoise noise(from + 3);
        for (std::size_t k = from; k < to; ++k)
            pen.cut(static_cast<double>(k) + 0.3 * noise.uniform(), y + noise.uniform(), 0);
    };
    const bool inserts = GENERATE(true, false);
    for (const std::size_t window : {8, 59, 60, 61, 100, 1 << 18}) {
        Pen a, b;
        a.at(0, 0, 0);
        b.at(0, 0, 0);
        cut(a, 0, 200, 0);
        cut(b, 0, 200, 0);
        if (inserts) cut(b, 1000, 1060, 50);
        cut(a, 200, 400, 0);
        cut(b, 200, 400, 0);
        regression::WalkOptions options;
        options.resync_segments = window;
        const regression::PathComparison r = compare(a, b, options);
        INFO("window " << window);
        CHECK(r.clusters.empty() == !inserts);
        if (inserts && window >= 61) {
            REQUIRE(r.clusters.size() == 1);
            CHECK(r.clusters[0].first.a.last <= 202);
        }
        // No corner behind the window was looked at.
        if (inserts && window < 60) CHECK(r.clusters[0].first.a.last > 202);
        if (inserts) CHECK(r.clusters[0].first.b.first == 201);
    }
}

TEST_CASE("passes are alike by tool, place, ends and length of the cut, each within its limit",
          "[compare]") {
    regression::Tolerances t;
    t.position_mm = 0.01;
    regression::Pass p;
    p.last = 9;
    p.tool = 3;
    p.cut_mm = 100.0;
    CHECK(regression::alike(p, p, t));
    const auto alike_with = [&](auto change) {
        regression::Pass q = p;
        change(q);
        CHECK(regression::alike(p, q, t) == regression::alike(q, p, t));
        return regression::alike(p, q, t);
    };
    CHECK_FALSE(alike_with([](regression::Pass& q) { q.tool = 4; }));
    for (const auto place :
         {&regression::Pass::start_mm, &regression::Pass::end_mm, &regression::Pass::centroid_mm})
        for (std::size_t k = 0; k < 3; ++k) {
            CHECK(alike_with([&](regression::Pass& q) { (q.*place)[k] = -0.019; }));
            CHECK_FALSE(alike_with([&](regression::Pass& q) { (q.*place)[k] = 0.021; }));
        }
    // A thousandth and four tolerances.
    CHECK(alike_with([](regression::Pass& q) { q.cut_mm = 100.139; }));
    CHECK_FALSE(alike_with([](regression::Pass& q) { q.cut_mm = 100.141; }));
    CHECK(alike_with([](regression::Pass& q) { q.cut_mm = 99.8615; }));
    CHECK_FALSE(alike_with([](regression::Pass& q) { q.cut_mm = 99.8585; }));
    // Rapids alone: alike wherever they lead, but never like a cut.
    CHECK_FALSE(alike_with([](regression::Pass& q) { q.cut_first = q.last; }));
    p.cut_first = p.last;
    CHECK(alike_with([](regression::Pass& q) { q.start_mm = {5.0, 5.0, 5.0}; }));
    CHECK_FALSE(alike_with([](regression::Pass& q) { q.tool = 4; }));
}

TEST_CASE("sequences with a common head, a common tail, both and none are matched", "[align]") {
    const auto matched = [](const regression::Keys& a, const regression::Keys& b,
                            std::size_t most_edits = 1000) {
        std::string text;
        for (const auto& p : regression::match_sequences(a, b, most_edits))
            text += std::to_string(p.a) + "=" + std::to_string(p.b) + " ";
        return text;
    };
    for (const std::size_t edits : {1000, 1}) {
        CHECK(matched({}, {}, edits).empty());
        CHECK(matched({1}, {}, edits).empty());
        CHECK(matched({1, 2, 3}, {1, 2, 3}, edits) == "0=0 1=1 2=2 ");
        CHECK(matched({1, 2, 3}, {1, 2, 4, 5}, edits) == "0=0 1=1 ");
        CHECK(matched({1, 2, 3}, {9, 2, 3}, edits) == "1=1 2=2 ");
        CHECK(matched({1, 2, 3, 4}, {1, 7, 8, 3, 4}, edits) == "0=0 2=3 3=4 ");
        CHECK(matched({1, 2}, {3, 4}, edits).empty());
    }
}

TEST_CASE("two sequences with nothing alike, or only far behind, keep every item", "[align]") {
    regression::Keys a, b;
    for (std::uint64_t k = 0; k < 100; ++k) {
        a.push_back(k);
        b.push_back(1000 + k);
    }
    const auto none = aligned(a, b, windows(4));
    check_complete(a, b, none);
    REQUIRE(none.size() == 1);
    CHECK(none[0].pairing == regression::Pairing::changed);
    // The only match of the largest window lies in its last quarter.
    for (const std::size_t at : {13, 14, 15}) {
        regression::Keys far = b;
        far[at] = a[at];
        const auto found = aligned(a, far, windows(4));
        check_complete(a, far, found);
        CHECK(std::any_of(found.begin(), found.end(), [&](const regression::PassPair& p) {
            return p.pairing == regression::Pairing::same && p.a.first == at;
        }));
    }
}

TEST_CASE("passes that lie near each other are alike across every border of the grid",
          "[compare]") {
    const regression::Tolerances tolerances;
    const double border_mm = 64.0 * tolerances.position_mm, off_mm = 0.5 * tolerances.position_mm;
    for (int side = 0; side < 8; ++side) {
        regression::Pass low, high;
        for (regression::Pass* pass : {&low, &high}) {
            pass->last = 2;
            pass->cut_mm = 10.0;
            for (std::size_t d = 0; d < 3; ++d) {
                const bool up = (((side >> d) & 1) == 1) == (pass == &high);
                pass->centroid_mm[d] = border_mm + (up ? off_mm : -off_mm);
            }
        }
        INFO(side);
        regression::PassIds ids(tolerances);
        CHECK(ids.id_of(low) == ids.id_of(high));
        high.centroid_mm[0] += 10.0 * tolerances.position_mm;
        CHECK(ids.id_of(low) != ids.id_of(high));
    }
}
