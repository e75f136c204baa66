// Pairing of long logs without block numbers: straight lines, positions by hand.
#include <catch2/catch.hpp>
#include <cmath>

#include "base/random.h"
#include "base/waiting.h"
#include "choices/row_losses.h"

namespace trunnion {

namespace {

using choices::ControlPath;
using choices::LogView;

constexpr double length_mm = 40.0, pitch_mm = 0.5;

/// Passes along X, a pitch apart in Y; every tenth one is deeper.
ControlPath passes(int count) {
    ControlPath path;
    path.blocks = {{"", 0}};
    path.nodes.push_back({{}, 0, true});
    for (int k = 0; k < count; ++k) {
        path.blocks.push_back({"", k + 1});
        offsets::ControlPosition at = path.nodes.back().at;
        at[Axis::Y] = pitch_mm * k;
        at[Axis::Z] = k % 10 == 5 ? -3.0 : 0.0;
        path.nodes.push_back({at, static_cast<std::uint32_t>(k + 1), true});
        at[Axis::X] = k % 2 == 0 ? length_mm : 0.0;
        path.nodes.push_back({at, static_cast<std::uint32_t>(k + 1), true});
    }
    return path;
}

/// Samples along the nodes from one to another, `step_mm` apart on each segment from its start.
LogView samples(const ControlPath& path, std::size_t from, std::size_t to, double step_mm) {
    LogView log;
    log.axes = {Axis::X, Axis::Y, Axis::Z};
    log.spacing = step_mm;
    for (std::size_t k = from + 1; k <= to; ++k) {
        const auto &a = path.nodes[k - 1].at, &b = path.nodes[k].at;
        double far = 0.0;
        for (const Axis axis : log.axes) far = std::max(far, std::abs(b[axis] - a[axis]));
        const int parts = std::max(1, static_cast<int>(far / step_mm));
        for (int part = 0; part < parts; ++part) {
            log.rows.emplace_back();
            for (const Axis axis : log.axes)
                log.rows.back().at[axis] = a[axis] + (b[axis] - a[axis]) * part / parts;
        }
    }
    return log;
}

double loss_of(const LogView& log, const ControlPath& path) {
    double sum = 0.0;
    for (const double row : choices::row_losses(log, choices::pair_up(log, path))) sum += row;
    return sum;
}

/// The same block as where the row was made: row k of log, segment by segment.
void check_order(const LogView& log, const ControlPath& path) {
    std::size_t node = 0;
    std::vector<std::size_t> of_row(log.rows.size(), 0);
    for (const choices::Pair& pair : choices::pair_up(log, path)) of_row[pair.row] = pair.node;
    for (const std::size_t k : of_row) {
        if (k + 1 < node) FAIL("the rows do not keep the order of the path");
        node = std::max(node, k);
    }
}

}  // namespace

TEST_CASE("a long log without blocks lies on the path, whole or cut off, at rest and moving") {
    const ControlPath path = passes(900);
    const std::size_t end = path.nodes.size() - 1;
    LogView whole = samples(path, 0, end, 1.0);
    REQUIRE(whole.rows.size() * path.nodes.size() > 50'000'000);
    CHECK(loss_of(whole, path) < 1e-9);
    check_order(whole, path);
    CHECK(loss_of(samples(path, 0, end / 3, 0.4), path) < 1e-9);  // it ends within the program
    LogView rests = samples(path, 0, end, 1.0);
    rests.rows.insert(rests.rows.begin() + 9000, 20'000, rests.rows[9000]);
    CHECK(loss_of(rests, path) < 1e-9);
}

TEST_CASE("a long log with few rows beside a finely divided path") {
    const ControlPath coarse = passes(600);
    ControlPath path = coarse;
    path.nodes.resize(1);
    LogView log = samples(coarse, 0, coarse.nodes.size() - 1, length_mm);
    for (std::size_t k = 1; k < coarse.nodes.size(); ++k)
        for (int part = 1; part <= 100; ++part) {
            choices::PathNode node = coarse.nodes[k];
            const auto& from = coarse.nodes[k - 1].at;
            for (const Axis axis : log.axes)
                node.at[axis] = from[axis] + (node.at[axis] - from[axis]) * part / 100.0;
            node.end = part == 100;
            path.nodes.push_back(node);
        }
    REQUIRE(log.rows.size() * path.nodes.size() > 50'000'000);
    CHECK(loss_of(log, path) < 1e-9);
}

TEST_CASE("a long log of another offset and with noise is paired row by row") {
    const ControlPath path = passes(500);
    LogView log = samples(path, 0, path.nodes.size() - 1, 0.8);
    SeededNoise random(5);
    for (LogView::Row& row : log.rows) {
        row.at[Axis::Z] += 2.0;
        row.at[Axis::Y] += 0.004 * (random.uniform() - 0.5);
        row.weight = 1e3;
    }
    const double rows = static_cast<double>(log.rows.size());
    const double mean = loss_of(log, path) / rows / 1e6;
    CHECK(mean < 4.001);  // never farther than the offset
    CHECK(mean > 3.5);    // moves along Z hide it
}

TEST_CASE("a long log that begins within the program is paired with its part") {
    const ControlPath path = passes(900);
    LogView log = samples(path, 700, 1300, 0.3);
    CHECK(loss_of(log, path) > 1.0);
    log.begins_within = true;
    CHECK(loss_of(log, path) < 1e-9);
}

TEST_CASE("a long log that begins in one of several layers finds its own") {
    ControlPath path = passes(80);
    const std::vector<choices::PathNode> layer = path.nodes;
    SeededNoise random(2);
    for (int k = 1; k < 8; ++k)
        for (choices::PathNode node : layer) {
            node.at[Axis::Z] -= k;
            node.at[Axis::X] += node.at[Axis::X] > 0.0 ? random.uniform() : 0.0;
            path.nodes.push_back(node);
        }
    LogView log = samples(path, 3 * layer.size() + 71, path.nodes.size() - 1, 0.2);
    log.begins_within = true;
    CHECK(log.rows.size() * path.nodes.size() > 50'000'000);
    CHECK(loss_of(log, path) < 1e-9);
}

TEST_CASE("the limit of time ends a pairing") {
    const ControlPath path = passes(300);
    const LogView log = samples(path, 0, path.nodes.size() - 1, 0.5);
    const WaitLimits ended(0.0, [] { return true; });
    CHECK_THROWS_AS(choices::pair_up(log, path), choices::PathEnded);
}

}  // namespace trunnion
