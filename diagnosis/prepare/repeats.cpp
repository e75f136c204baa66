#include "diagnosis/prepare/repeats.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace trunnion::diagnosis {
namespace {

/// Key of repeats: device rows with equal keys repeat each other in different passes of one
/// session. What differs between sessions may be the machine, not its noise.
using Key = std::tuple<std::size_t, int, int, int, std::vector<long>, std::vector<int>>;

Key key_of(const emulator::Replay& replay, const records::ReadingTable& table, std::size_t i) {
    const emulator::Contact& contact = replay.contact(i);
    const AxisSample& sample = replay.sample(i);
    std::vector<long> place;
    std::vector<int> travel;
    for (const Axis axis : table.axes) {
        place.push_back(std::lround(sample.position[axis] * 1e5));
        if (table.names.is_rotary(axis) || contact.device == records::Device::ballbar ||
            reads_targets(contact.device))
            travel.push_back(sample.travel[index_of(axis)]);
    }
    if (contact.device != records::Device::ballbar)
        for (int d = 0; d < 3; ++d) place.push_back(std::lround(contact.direction_M(d) * 1e3));
    place.push_back(std::lround(sample.feed_mm_min));
    place.push_back(std::lround(sample.load_kg * 10.0));
    place.push_back(std::lround(sample.spindle_rad * 100.0));
    place.push_back(sample.clamped ? 1 : 0);
    return {replay.session(i),
            static_cast<int>(contact.device),
            contact.artefact,
            static_cast<int>(sample.mode),
            place,
            travel};
}

/// Time that a pass takes; 0 of readings taken at rest.
double duration_s(const emulator::Replay& replay, const NoiseBlock& block) {
    if (block.device != records::Device::ballbar && block.device != records::Device::axis)
        return 0.0;
    const auto time_s = [&](Eigen::Index row) {
        return replay.sample(static_cast<std::size_t>(row)).time_s;
    };
    return time_s(block.rows.back()) - time_s(block.rows.front());
}

/// Pairs of blocks that repeat each other row by row. Passes over the same path at different speeds
/// are none, also where no column tells the feed: lags and reversals do differ.
std::vector<std::pair<std::size_t, std::size_t>> repeated_blocks(
    const emulator::Replay& replay, const records::ReadingTable& table,
    const std::vector<NoiseBlock>& blocks) {
    constexpr double alike = 0.1;  // in proportion, assumed
    std::map<std::vector<Key>, std::vector<std::size_t>> seen;
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        std::vector<Key> keys;
        for (const Eigen::Index i : blocks[b].rows)
            keys.push_back(key_of(replay, table, static_cast<std::size_t>(i)));
        std::vector<std::size_t>& last = seen[std::move(keys)];  // one for each speed
        const double own_s = duration_s(replay, blocks[b]);
        const auto repeated = std::find_if(last.begin(), last.end(), [&](std::size_t other) {
            const double other_s = duration_s(replay, blocks[other]);
            return std::abs(own_s - other_s) <= alike * std::max(own_s, other_s);
        });
        if (repeated == last.end()) {
            last.push_back(b);
            continue;
        }
        pairs.emplace_back(*repeated, b);
        *repeated = b;
    }
    return pairs;
}

}  // namespace

std::vector<NoiseBlock> compared_rows(const std::vector<NoiseBlock>& blocks,
                                      const std::vector<bool>& used) {
    std::vector<NoiseBlock> list;
    for (const NoiseBlock& block : blocks) {
        if (!reads_targets(block.device)) {
            list.push_back(block);
            continue;
        }
        for (const Eigen::Index row : block.rows)
            if (used[static_cast<std::size_t>(row)]) list.push_back({block.device, {row}});
    }
    return list;
}

std::map<records::Device, std::vector<Stretch>> differences_of(
    const RepeatedRows& rows, const std::vector<NoiseBlock>& blocks,
    const Eigen::VectorXd& residual_mm, const Eigen::VectorXd& sigma_mm) {
    std::map<records::Device, std::vector<Stretch>> stretches;
    for (const auto& [first, second] : repeated_blocks(rows.replay, rows.table, blocks)) {
        Stretch s;
        std::vector<double> values;
        for (std::size_t k = 0; k < blocks[second].rows.size(); ++k) {
            const Eigen::Index a = blocks[first].rows[k], b = blocks[second].rows[k];
            if (!rows.used[static_cast<std::size_t>(a)] || !rows.used[static_cast<std::size_t>(b)])
                continue;
            if (s.rows.empty()) s.before = a;
            s.rows.push_back(b);
            values.push_back((residual_mm(b) - residual_mm(a)) /
                             std::hypot(sigma_mm(a), sigma_mm(b)));
        }
        if (values.empty()) continue;
        s.value = Eigen::Map<const Eigen::VectorXd>(values.data(),
                                                    static_cast<Eigen::Index>(values.size()));
        stretches[blocks[second].device].push_back(std::move(s));
    }
    return stretches;
}

}  // namespace trunnion::diagnosis
