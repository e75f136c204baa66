// Pairing of a log with a path: against every possible pairing of small cases, and by hand.
#include "choices/pairing.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>

#include "base/random.h"
#include "choices/folds.h"
#include "choices/row_losses.h"

namespace trunnion {

namespace {

using choices::ControlPath;
using choices::LogView;

offsets::ControlPosition at(double x, double y) {
    offsets::ControlPosition out;
    out[Axis::X] = x;
    out[Axis::Y] = y;
    return out;
}

double square(const offsets::ControlPosition& a, const offsets::ControlPosition& b) {
    const double x = a[Axis::X] - b[Axis::X], y = a[Axis::Y] - b[Axis::Y];
    return x * x + y * y;
}

LogView log_of(const std::vector<offsets::ControlPosition>& rows, bool ends) {
    LogView log;
    log.axes = {Axis::X, Axis::Y};
    log.ends = ends;
    for (const auto& row : rows) {
        log.rows.emplace_back();
        log.rows.back().at = row;
        log.rows.back().end = ends;
    }
    return log;
}

ControlPath path_of(const std::vector<offsets::ControlPosition>& nodes) {
    ControlPath path;
    path.blocks = {{"", 0}, {"", 1}};
    path.nodes.push_back({at(0, 0), 0, true});
    for (const auto& node : nodes) path.nodes.push_back({node, 1, true});
    return path;
}

double loss(const LogView& log, const ControlPath& path) {
    double sum = 0.0;
    for (const double row : choices::row_losses(log, choices::pair_up(log, path))) sum += row;
    return sum;
}

/// The least sum over every monotone pairing of rows i.. and nodes j..; the last row may stop at
/// any node.
double least(const LogView& log, const ControlPath& path, std::size_t i, std::size_t j) {
    const double here = square(log.rows[i].at, path.nodes[j].at);
    const bool last_row = i + 1 == log.rows.size(), last_node = j + 1 == path.nodes.size();
    double behind = last_row ? 0.0 : std::numeric_limits<double>::infinity();
    if (!last_row) behind = std::min(behind, least(log, path, i + 1, j));
    if (!last_node) behind = std::min(behind, least(log, path, i, j + 1));
    if (!last_row && !last_node) behind = std::min(behind, least(log, path, i + 1, j + 1));
    return here + behind;
}

}  // namespace

TEST_CASE("ends of moves: the pairing costs no more than the best of all") {
    SeededNoise random(3);
    for (int n = 0; n < 300; ++n) {
        std::vector<offsets::ControlPosition> rows, nodes;
        const auto fill = [&](auto& list) {
            const int count = 1 + static_cast<int>(6 * random.uniform());
            for (int k = 0; k < count; ++k)
                list.push_back(at(10 * random.uniform(), 10 * random.uniform()));
        };
        fill(rows);
        fill(nodes);
        const LogView log = log_of(rows, true);
        const ControlPath path = path_of(nodes);
        CHECK(loss(log, path) == Approx(least(log, path, 0, 1)).margin(1e-9));
    }
}

TEST_CASE("samples lie on the way: their distance is that from the segments, in order") {
    const ControlPath path = path_of({at(10, 0), at(10, 10)});
    CHECK(loss(log_of({at(0, 0), at(4, 0), at(9, 0), at(10, 5), at(10, 10)}, false), path) == 0.0);
    CHECK(loss(log_of({at(0, 0.1), at(4, 0.1), at(8, 0.1), at(10.1, 4), at(10.1, 9)}, false),
               path) == Approx(0.05));
    // Back again over the same line: order tells, the nearest place would not.
    const ControlPath twice = path_of({at(10, 0), at(2, 0), at(10, 0)});
    std::vector<offsets::ControlPosition> once;
    for (int k = 0; k <= 20; ++k) once.push_back(at(0.5 * k, 0));
    once.push_back(at(10, 0.5));  // the log goes on elsewhere, without the way back
    for (int k = 0; k < 3; ++k) once.push_back(at(10, 1 + 0.5 * k));
    ControlPath further = twice;
    for (const double y : {1.0, 2.0}) further.nodes.push_back({at(10, y), 1, true});
    CHECK(loss(log_of(once, false), further) > 5.0);
}

TEST_CASE("an end of a move among samples belongs to an end of the path") {
    const ControlPath path = path_of({at(10, 0), at(4, 0), at(20, 0)});
    LogView log = log_of({at(0, 0), at(5, 0), at(10, 0), at(6, 0), at(12, 0), at(20, 0)}, false);
    CHECK(loss(log, path) < 1e-9);  // samples 6 mm apart do not show that it turned at 6, not at 4
    for (const std::size_t end : {2U, 3U, 5U}) log.rows[end].end = true;
    log.marked = true;
    CHECK(loss(log, path) == Approx(8.0));  // 2 mm from row to node, and from node to the log
}

TEST_CASE("a row that does not move may stand where the move of its block begins") {
    ControlPath path;
    path.blocks = {{"", 0}, {"", 1}, {"", 2}, {"", 3}};
    path.nodes = {
        {at(0, 0), 0, true}, {at(10, 0), 1, true}, {at(10, 30), 2, true}, {at(0, 30), 3, true}};
    const auto log_with = [](const std::vector<std::pair<int, offsets::ControlPosition>>& rows) {
        LogView log = log_of({}, true);
        log.keys = 3;
        log.key_of = [](const choices::PathBlock& block) { return block.line - 1; };
        for (const auto& [block, place] : rows) {
            log.rows.emplace_back();
            log.rows.back().at = place;
            log.rows.back().key = block - 1;
        }
        return log;
    };
    // Another control's trace has the intermediate point of G28 as a row of its own.
    CHECK(loss(log_with({{1, at(10, 0)}, {2, at(10, 0)}, {2, at(10, 30)}, {3, at(0, 30)}}), path) ==
          0.0);
    // A control that did not move at all there differs, whatever its row says.
    CHECK(loss(log_with({{1, at(10, 0)}, {2, at(10, 0)}, {3, at(0, 30)}}), path) >= 900.0);
    // Nor is a row that moved excused.
    CHECK(loss(log_with({{1, at(10, 0)}, {2, at(10, 12)}, {2, at(10, 30)}, {3, at(0, 30)}}),
               path) >= 100.0);
}

TEST_CASE("what a change touches in one block is left out row by row, else block by block") {
    const std::vector<double> before{9, 9, 9, 9, 9, 9}, one{9, 0, 0, 0, 9, 9},
        several{0, 9, 0, 9, 0, 9};
    const std::vector<int> blocks{1, 2, 2, 2, 3, 4},
        single = choices::folds_for(before, one, blocks),
        spread = choices::folds_for(before, several, blocks);
    CHECK(single[1] != single[2]);
    CHECK(single[2] != single[3]);
    CHECK(spread[2] == spread[3]);
    CHECK(spread[0] != spread[2]);
    CHECK(spread[2] != spread[4]);
}

}  // namespace trunnion
