#include "diagnosis/prepare/noise.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace trunnion::diagnosis {
namespace {

/// Innovations of "memory + white" noise: the Kalman filter of the shared state predicts each step.
struct PassFilter {
    explicit PassFilter(const DeviceNoise& noise)
        : memory(noise.memory),
          shared(noise.scale * noise.scale * noise.shared),
          white(noise.scale * noise.scale * (1.0 - noise.shared) + 1e-12),
          variance(shared) {}

    double memory, shared, white;
    double variance;  ///< of the predicted state
    double gain = 0.0, deviation = 1.0;

    void step() {
        const double s = variance + white;
        gain = variance / s;
        deviation = std::sqrt(s);
        const double left = variance * (1.0 - gain);
        variance = memory * memory * left + (1.0 - memory * memory) * shared;
    }
};

constexpr double same_angle_rad = 1e-7;  ///< below any control's increment
constexpr double long_pause = 10.0;      ///< relative to the shortest one within a visit

/// True when a rotary axis was elsewhere between two table rows: it came to the pose again.
bool turned_between(const records::ReadingTable& table, std::size_t before, std::size_t row) {
    for (std::size_t i = before + 1; i < row; ++i)
        for (const Axis axis : table.axes)
            if (table.names.is_rotary(axis) &&
                std::abs(table.rows[i].commanded[axis] - table.rows[row].commanded[axis]) >
                    same_angle_rad)
                return true;
    return false;
}

bool touch_alike(const emulator::Replay& replay, std::size_t a, std::size_t b) {
    return (replay.contact(a).direction_M - replay.contact(b).direction_M).norm() < 1e-3;
}

/// True when a touch in a direction that the visit has already touched follows a long pause.
bool touches_again(const emulator::Replay& replay, const records::ReadingTable& table,
                   const std::vector<Eigen::Index>& visit, std::size_t i) {
    const auto time_s = [&](std::size_t k) { return table.rows[replay.table_row(k)].time_s; };
    bool again = false;
    double shortest_s = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < visit.size(); ++k) {
        const auto at = static_cast<std::size_t>(visit[k]);
        again = again || touch_alike(replay, at, i);
        if (k > 0)
            shortest_s =
                std::min(shortest_s, time_s(at) - time_s(static_cast<std::size_t>(visit[k - 1])));
    }
    const double pause_s = time_s(i) - time_s(static_cast<std::size_t>(visit.back()));
    return again && pause_s > long_pause * shortest_s;
}

/// True when the first direction of three and more is touched again: another calibration begins.
bool calibrates_again(const emulator::Replay& replay, const std::vector<Eigen::Index>& visit,
                      std::size_t i) {
    constexpr std::size_t directions_of_one = 3;
    if (!touch_alike(replay, static_cast<std::size_t>(visit.front()), i)) return false;
    std::vector<std::size_t> directions;
    for (const Eigen::Index row : visit) {
        const auto at = static_cast<std::size_t>(row);
        if (std::none_of(directions.begin(), directions.end(),
                         [&](std::size_t other) { return touch_alike(replay, at, other); }))
            directions.push_back(at);
    }
    return directions.size() >= directions_of_one;
}

/// True where no rotary axis moves: touches share no error of a pose that differs from another's.
bool has_one_pose(const emulator::Replay& replay, const records::ReadingTable& table) {
    return std::all_of(table.axes.begin(), table.axes.end(), [&](Axis axis) {
        if (!table.names.is_rotary(axis)) return true;
        for (std::size_t i = 1; i < replay.size(); ++i)
            if (std::abs(replay.sample(i).position[axis] - replay.sample(0).position[axis]) >
                same_angle_rad)
                return false;
        return true;
    });
}

/// Readings of a pass of a laser or autocollimator that are left out together: eight, of few
/// readings a sixth of them, so that what is left determines an effect.
std::size_t longest_of_pass(const emulator::Replay& replay) {
    constexpr std::size_t longest = 8, blocks = 6;
    std::size_t count = 0;
    for (std::size_t i = 0; i < replay.size(); ++i)
        if (reads_targets(replay.contact(i).device)) ++count;
    return std::clamp<std::size_t>(count / blocks, 1, longest);
}

/// True when an axis reversed after the approaches of a pass: the way back is another pass. Were
/// both readings of the last target left out together, nothing would be known of it.
bool turned_back(const emulator::Replay& replay, const records::ReadingTable& table,
                 std::size_t i) {
    constexpr std::size_t least = 3;  // readings; targets in random order are approached at will
    const std::string& test = table.rows[replay.table_row(i)].test;
    return std::any_of(table.axes.begin(), table.axes.end(), [&](Axis axis) {
        const auto travel = [&](std::size_t row) {
            return replay.sample(row).travel[index_of(axis)];
        };
        if (travel(i - 1) == travel(i)) return false;
        std::size_t count = 1;
        while (count < least && count < i && travel(i - 1 - count) == travel(i - 1) &&
               table.rows[replay.table_row(i - 1 - count)].test == test)
            ++count;
        return count == least;
    });
}

/// True when reading i continues a visit, that is the readings of one pose of a probe or target, or
/// of one approach of a pass: they share an error. A pose that is left and taken again has another.
bool continues(const emulator::Replay& replay, const records::ReadingTable& table,
               const std::vector<Eigen::Index>& visit, std::size_t i) {
    constexpr std::size_t most = 64;
    const std::size_t last = replay.table_row(static_cast<std::size_t>(visit.back()));
    const records::Reading &before = table.rows[last], &row = table.rows[replay.table_row(i)];
    if (before.feature != row.feature || before.mode != row.mode || visit.size() >= most)
        return false;
    if (reads_targets(row.device)) return true;  // as long as a pass may be
    for (const Axis axis : table.axes)
        if ((table.names.is_rotary(axis) || row.device == records::Device::point) &&
            std::abs(before.commanded[axis] - row.commanded[axis]) > same_angle_rad)
            return false;
    if (row.device != records::Device::touch) return before.time_s == row.time_s;
    return !turned_between(table, last, replay.table_row(i)) &&
           !touches_again(replay, table, visit, i);
}

}  // namespace

const DeviceNoise& NoiseModel::of(records::Device device) const {
    switch (device) {
        case records::Device::sphere: return sphere;
        case records::Device::touch: return touch;
        case records::Device::linear: return linear;
        case records::Device::angle: return angle;
        case records::Device::point: return point;
        case records::Device::axis: return axis;
        default: return ballbar;
    }
}
DeviceNoise& NoiseModel::of(records::Device device) {
    return const_cast<DeviceNoise&>(std::as_const(*this).of(device));
}

std::vector<NoiseBlock> noise_blocks(const emulator::Replay& replay,
                                     const records::ReadingTable& table) {
    std::vector<NoiseBlock> blocks;
    std::map<std::string, std::size_t> open;  // by test
    const std::size_t of_pass = longest_of_pass(replay);
    const bool one_pose = has_one_pose(replay, table);
    for (std::size_t i = 0; i < replay.size(); ++i) {
        const records::Reading& row = table.rows[replay.table_row(i)];
        const auto it = open.find(row.test);
        bool same = it != open.end() && blocks[it->second].device == row.device;
        if (same && row.device != records::Device::ballbar && row.device != records::Device::axis) {
            const std::vector<Eigen::Index>& visit = blocks[it->second].rows;
            same = static_cast<std::size_t>(visit.back()) + 1 == i &&
                   !(reads_targets(row.device) &&
                     (visit.size() >= of_pass || turned_back(replay, table, i))) &&
                   continues(replay, table, visit, i) &&
                   !(one_pose && row.device == records::Device::touch &&
                     calibrates_again(replay, visit, i));
        }
        if (!same) {
            open[row.test] = blocks.size();
            blocks.push_back({row.device, {}});
        }
        blocks[open[row.test]].rows.push_back(static_cast<Eigen::Index>(i));
    }
    return blocks;
}

namespace {

/// How a rotation of the machine at a stop moves each reading of its targets, mean square 1; zero
/// where all stand at one point.
Eigen::MatrixXd turns_of(const emulator::Replay& replay, const std::vector<Eigen::Index>& rows) {
    constexpr double no_arm_mm = 1e-3;
    const auto contact = [&](Eigen::Index row) -> const emulator::Contact& {
        return replay.contact(static_cast<std::size_t>(row));
    };
    Vector3 middle = Vector3::Zero();
    for (const Eigen::Index row : rows) middle += contact(row).commanded_I_mm;
    middle /= static_cast<double>(rows.size());
    Eigen::MatrixXd turns(static_cast<Eigen::Index>(rows.size()), 3);
    for (Eigen::Index k = 0; k < turns.rows(); ++k) {
        const emulator::Contact& c = contact(rows[static_cast<std::size_t>(k)]);
        turns.row(k) = (c.commanded_I_mm - middle).cross(c.direction_I).transpose();
    }
    const double mean = turns.squaredNorm() / static_cast<double>(rows.size());
    if (mean < no_arm_mm * no_arm_mm) return Eigen::MatrixXd::Zero(turns.rows(), 3);
    return turns / std::sqrt(mean);
}

}  // namespace

Eigen::MatrixXd shared_covariance(const emulator::Replay& replay,
                                  const std::vector<Eigen::Index>& rows, const DeviceNoise& noise) {
    const auto n = static_cast<Eigen::Index>(rows.size());
    Eigen::MatrixXd directions(n, 3);
    for (Eigen::Index k = 0; k < n; ++k)
        directions.row(k) =
            replay.contact(static_cast<std::size_t>(rows[static_cast<std::size_t>(k)]))
                .direction_M.transpose();
    Eigen::MatrixXd v = noise.shared * directions * directions.transpose();
    v.diagonal().array() += 1.0 - noise.shared - noise.turned;
    if (noise.turned > 0.0) {
        const Eigen::MatrixXd turns = turns_of(replay, rows);
        v += noise.turned * turns * turns.transpose();
    }
    return noise.scale * noise.scale * v;
}

std::vector<NoiseBlock> stops_of(const std::vector<NoiseBlock>& blocks,
                                 const emulator::Replay& replay) {
    std::vector<NoiseBlock> joined;
    for (const NoiseBlock& block : blocks) {
        const auto at = static_cast<std::size_t>(block.rows.front());
        const auto same_stop = [&](const NoiseBlock& last) {
            const auto before = static_cast<std::size_t>(last.rows.back());
            return last.device == records::Device::point && before + 1 == at &&
                   replay.session(before) == replay.session(at) &&
                   replay.sample(before).position.value == replay.sample(at).position.value;
        };
        if (block.device == records::Device::point && !joined.empty() && same_stop(joined.back()))
            joined.back().rows.insert(joined.back().rows.end(), block.rows.begin(),
                                      block.rows.end());
        else
            joined.push_back(block);
    }
    return joined;
}

Whitener::Whitener(const emulator::Replay& replay, std::vector<NoiseBlock> blocks,
                   const NoiseModel& noise, const Eigen::VectorXd& sigma_mm)
    : replay_(replay), blocks_(std::move(blocks)), noise_(noise), sigma_mm_(sigma_mm) {
    if (noise_.point.shared + noise_.point.turned > 0.0) blocks_ = stops_of(blocks_, replay_);
}

void Whitener::whiten_shared(const NoiseBlock& block, Eigen::MatrixXd& m) const {
    const auto n = static_cast<Eigen::Index>(block.rows.size());
    Eigen::MatrixXd part(n, m.cols());
    for (Eigen::Index k = 0; k < n; ++k)
        part.row(k) = m.row(block.rows[static_cast<std::size_t>(k)]);
    const Eigen::LLT<Eigen::MatrixXd> llt(
        shared_covariance(replay_, block.rows, noise_.of(block.device)));
    llt.matrixL().solveInPlace(part);
    for (Eigen::Index k = 0; k < n; ++k)
        m.row(block.rows[static_cast<std::size_t>(k)]) = part.row(k);
}

void Whitener::whiten_pass(const NoiseBlock& block, Eigen::MatrixXd& m) const {
    PassFilter steady(noise_.ballbar);
    std::vector<double> gain, inverse;
    for (std::size_t k = 0; k < block.rows.size(); ++k) {
        steady.step();
        gain.push_back(steady.gain);
        inverse.push_back(1.0 / steady.deviation);
    }
    for (Eigen::Index c = 0; c < m.cols(); ++c) {
        double state = 0.0;
        for (std::size_t k = 0; k < block.rows.size(); ++k) {
            double& entry = m(block.rows[k], c);
            const double innovation = entry - state;
            state = noise_.ballbar.memory * (state + gain[k] * innovation);
            entry = innovation * inverse[k];
        }
    }
}

void Whitener::apply(Eigen::MatrixXd& m) const {
    m = sigma_mm_.cwiseInverse().asDiagonal() * m;
    for (const NoiseBlock& block : blocks_) {
        const DeviceNoise& noise = noise_.of(block.device);
        const bool stop =
            block.device == records::Device::point && noise.shared + noise.turned > 0.0;
        if (stop || (noise.shared > 0.0 && block.device == records::Device::touch)) {
            whiten_shared(block, m);
        } else if (noise.shared > 0.0 && block.device == records::Device::ballbar) {
            whiten_pass(block, m);
        } else {
            for (const Eigen::Index row : block.rows) m.row(row) /= noise.scale;
        }
    }
}

Eigen::VectorXd Whitener::apply(const Eigen::VectorXd& v) const {
    Eigen::MatrixXd m = v;
    apply(m);
    return m.col(0);
}

const char* to_string(NoiseSource source) {
    return source == NoiseSource::repeats ? "repeats"
           : source == NoiseSource::given ? "given"
                                          : "assumed";
}

}  // namespace trunnion::diagnosis
