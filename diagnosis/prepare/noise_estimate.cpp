// Estimates of the noise model, from repeats or from the residuals of a fit.
#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <nlopt.hpp>
#include <set>
#include <tuple>

#include "diagnosis/prepare/noise.h"
#include "estimation/projection.h"
#include "estimation/quantiles.h"

namespace trunnion::diagnosis {
namespace {

/// A sequence of values with the noise model of one device, in units of sigma, and the rows whose
/// directions define the shared part.
struct Stretch {
    std::vector<Eigen::Index> rows;
    Eigen::Index before = 0;  ///< the row that the first one repeats
    Eigen::VectorXd value;
};

double touch_likelihood(const emulator::Replay& replay, const Stretch& s,
                        const DeviceNoise& noise) {
    const auto n = s.value.size();
    Eigen::MatrixXd v(n, n);
    for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0; j < n; ++j) {
            const auto a = static_cast<std::size_t>(s.rows[static_cast<std::size_t>(i)]);
            const auto b = static_cast<std::size_t>(s.rows[static_cast<std::size_t>(j)]);
            const double along = replay.contact(a).direction_M.dot(replay.contact(b).direction_M);
            // 1e-9 of the variance is always independent: touches in one direction that share all
            // their noise would have a singular covariance.
            v(i, j) = noise.shared * along + (i == j ? 1.0 - noise.shared + 1e-9 : 0.0);
        }
    const Eigen::LLT<Eigen::MatrixXd> llt(v);
    const Eigen::VectorXd w = llt.matrixL().solve(s.value);
    const double log_scale = std::log(noise.scale);
    return -w.squaredNorm() / (2.0 * noise.scale * noise.scale) -
           static_cast<double>(n) * log_scale - llt.matrixLLT().diagonal().array().log().sum();
}

/// Log likelihood of the values from their innovations under the noise of one pass. The machine may
/// have shifted between the two passes of a difference: that vector is profiled out with its loss
/// of freedom (restricted likelihood).
double pass_likelihood(const emulator::Replay& replay, const Stretch& s, const DeviceNoise& noise) {
    const double scale2 = noise.scale * noise.scale;
    const double shared = scale2 * noise.shared, white = scale2 * (1.0 - noise.shared) + 1e-12;
    using Row = Eigen::Matrix<double, 4, 1>;
    double variance = shared, sum = 0.0;
    Row state = Row::Zero();
    Eigen::Matrix4d square = Eigen::Matrix4d::Zero();
    for (Eigen::Index k = 0; k < s.value.size(); ++k) {
        Row entry = Row::Zero();
        entry(0) = s.value(k);
        entry.tail<3>() =
            replay.contact(static_cast<std::size_t>(s.rows[static_cast<std::size_t>(k)]))
                .direction_M;
        const double expected = variance + white;
        const Row innovation = entry - state;
        square += innovation * innovation.transpose() / expected;
        sum -= 0.5 * std::log(expected);
        const double gain = variance / expected;
        state = noise.memory * (state + gain * innovation);
        variance = noise.memory * noise.memory * variance * (1.0 - gain) +
                   (1.0 - noise.memory * noise.memory) * shared;
    }
    Eigen::Matrix3d normal = square.bottomRightCorner<3, 3>();
    // The prior of a shift is 1000 sigma wide: a bar that stays in a plane gives no information
    // perpendicular to it.
    normal.diagonal().array() += 1e-6;
    const Eigen::LLT<Eigen::Matrix3d> llt(normal);
    const Vector3 half = llt.matrixL().solve(square.bottomLeftCorner<3, 1>());
    return sum - 0.5 * (square(0, 0) - half.squaredNorm()) -
           llt.matrixLLT().diagonal().array().log().sum();
}

double likelihood(const emulator::Replay& replay, records::Device device,
                  const std::vector<Stretch>& stretches, const DeviceNoise& noise) {
    double sum = 0.0;
    for (const Stretch& s : stretches)
        sum += device == records::Device::ballbar ? pass_likelihood(replay, s, noise)
               : device == records::Device::touch
                   ? touch_likelihood(replay, s, noise)
                   : -s.value.squaredNorm() / (2.0 * noise.scale * noise.scale) -
                         static_cast<double>(s.value.size()) * std::log(noise.scale);
    return sum;
}

double rms(const std::vector<Stretch>& stretches) {
    double sum = 0.0, count = 0.0;
    for (const Stretch& s : stretches) {
        sum += s.value.squaredNorm();
        count += static_cast<double>(s.value.size());
    }
    return std::sqrt(sum / std::max(1.0, count));
}

/// Correlation of the noise between neighbours is limited to a tenth of a pass (0.9 to 0.97 from
/// sample to sample): anything longer is a change of the machine, not noise.
double longest_memory(const std::vector<Stretch>& stretches) {
    std::vector<double> samples;
    for (const Stretch& s : stretches) samples.push_back(static_cast<double>(s.value.size()));
    return std::clamp(std::exp(-10.0 / std::max(1.0, estimation::median(samples))), 0.9, 0.97);
}

/// Maximum likelihood within bounds on the scale; the shared part must gain at least `worth` nats.
DeviceNoise estimate(const emulator::Replay& replay, records::Device device,
                     const std::vector<Stretch>& stretches, double low, double high) {
    DeviceNoise plain;
    plain.scale = std::clamp(rms(stretches), low, high);
    plain.shared = 0.0;
    if (device != records::Device::touch && device != records::Device::ballbar) return plain;
    DeviceNoise best = plain;
    double most = likelihood(replay, device, stretches, plain) + 4.0;
    const bool pass = device == records::Device::ballbar;
    const double longest = longest_memory(stretches);
    for (const double memory :
         pass ? std::vector<double>{0.6, 0.85, 0.96} : std::vector<double>{0.0}) {
        nlopt::opt search(nlopt::LN_NELDERMEAD, pass ? 3 : 2);
        const auto noise_of = [&](const std::vector<double>& x) {
            return DeviceNoise{x[0], x[1], pass ? x[2] : 0.0};
        };
        struct Context {
            std::function<double(const std::vector<double>&)> value;
        } context{[&](const std::vector<double>& x) {
            return likelihood(replay, device, stretches, noise_of(x));
        }};
        search.set_max_objective([](const std::vector<double>& x, std::vector<double>&,
                                    void* data) { return static_cast<Context*>(data)->value(x); },
                                 &context);
        std::vector<double> lower{low, 0.0}, upper{high, 0.98}, x{plain.scale, 0.4};
        if (pass) {
            lower.push_back(0.2);
            upper.push_back(longest);
            x.push_back(std::min(memory, longest));
        }
        search.set_lower_bounds(lower);
        search.set_upper_bounds(upper);
        search.set_xtol_abs(2e-3);
        search.set_maxeval(60);
        double value = 0.0;
        search.optimize(x, value);
        if (value <= most) continue;
        most = value;
        best = noise_of(x);
    }
    return best;
}

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

/// Rows that are compared as a whole: the blocks; at targets single readings of those used, each
/// with the last one at the same target from the same side.
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

/// Robust size of the differences, at least 1. What is stated of a device is its resolution or its
/// accuracy; what repeats differ by is known from them alone.
double typical_size(const std::vector<Stretch>& stretches) {
    std::vector<double> all;
    for (const Stretch& s : stretches) all.insert(all.end(), s.value.begin(), s.value.end());
    return std::max(1.0, estimation::robust_deviation(std::move(all)));
}

constexpr double farthest = 6.0;  ///< of the typical difference: an outlier, which must not
                                  ///< determine the noise

/// Removes the effect of a shift of the machine that grows with time from the differences of rows
/// that are no passes. Outliers take no part in it.
void remove_shift(const emulator::Replay& replay, std::vector<Stretch>& stretches) {
    constexpr int p = 6;  // a shift, and one that grows with time
    const double most = farthest * typical_size(stretches);
    std::vector<double*> values;
    std::vector<std::size_t> rows;
    for (Stretch& s : stretches)
        for (std::size_t k = 0; k < s.rows.size(); ++k)
            if (double& value = s.value(static_cast<Eigen::Index>(k)); std::abs(value) <= most) {
                values.push_back(&value);
                rows.push_back(static_cast<std::size_t>(s.rows[k]));
            }
    const auto n = static_cast<Eigen::Index>(rows.size());
    Eigen::MatrixXd a(n, p);
    Eigen::VectorXd y(n);
    for (Eigen::Index k = 0; k < n; ++k) {
        const std::size_t i = rows[static_cast<std::size_t>(k)];
        a.row(k).head<3>() = replay.contact(i).direction_M.transpose();
        a.row(k).tail<3>() = a.row(k).head<3>() * (replay.sample(i).time_s * 1e-4);
        y(k) = *values[static_cast<std::size_t>(k)];
    }
    const estimation::Projection shifts(std::move(a));
    const auto free = std::max<Eigen::Index>(1, n - shifts.rank());
    const Eigen::VectorXd left =
        shifts.beside(y) * std::sqrt(static_cast<double>(n) / static_cast<double>(free));
    for (Eigen::Index k = 0; k < n; ++k) *values[static_cast<std::size_t>(k)] = left(k);
}

/// Removes from the differences between two cycles of a laser test their median: the zero of a
/// cycle may differ from that of the one before. Few differences between two cycles keep it.
void remove_zeros_of_cycles(const std::vector<Eigen::Index>& cycle, std::vector<Stretch>& list) {
    constexpr std::size_t fewest_of_cycle = 5;
    std::map<std::pair<Eigen::Index, Eigen::Index>, std::vector<double*>> between;
    for (Stretch& s : list)
        between[{cycle[static_cast<std::size_t>(s.before)],
                 cycle[static_cast<std::size_t>(s.rows.front())]}]
            .push_back(&s.value(0));
    for (auto& [cycles, values] : between) {
        const std::size_t n = values.size();
        if (cycles.first == cycles.second || n < fewest_of_cycle) continue;
        std::vector<double> all;
        for (const double* value : values) all.push_back(*value);
        const double zero = estimation::median(std::move(all));
        const double free = std::sqrt(static_cast<double>(n) / static_cast<double>(n - 1));
        for (double* value : values) *value = (*value - zero) * free;
    }
}

/// The part of the deviation of typical rows of a device that is due to their last digit.
double rounding_of(const RepeatedRows& rows, const Eigen::VectorXd& sigma_mm,
                   records::Device device) {
    std::vector<double> part;
    for (Eigen::Index i = 0; i < sigma_mm.size(); ++i)
        if (const auto row = static_cast<std::size_t>(i);
            rows.used[row] && rows.replay.contact(row).device == device)
            part.push_back(rows.rounding_mm(i) / sigma_mm(i));
    return part.empty() ? 0.0 : estimation::median(std::move(part));
}

/// Differences of rows that repeat each other, by device.
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

/// Fewer differences say no more than what is stated or usual.
std::size_t fewest(records::Device device) {
    return reads_targets(device) ? 10 : 30;
}

}  // namespace

double least_by_rounding(const RepeatedRows& rows, const Eigen::VectorXd& sigma_mm,
                         const NoiseModel& noise) {
    std::set<records::Device> present;
    for (const NoiseBlock& block : rows.blocks) present.insert(block.device);
    double least = 1.0;
    for (const records::Device device : present)
        least = std::min(least, rounding_of(rows, sigma_mm, device) / noise.of(device).scale);
    return least;
}

NoiseModel noise_from_repeats(const RepeatedRows& rows, const Eigen::VectorXd& residual_mm,
                              const Eigen::VectorXd& sigma_mm, const NoiseModel& start) {
    const std::vector<NoiseBlock> blocks = compared_rows(rows.blocks, rows.used);
    NoiseModel noise = start;
    auto stretches = differences_of(rows, blocks, residual_mm, sigma_mm);
    std::set<records::Device> present;
    for (const NoiseBlock& block : blocks) present.insert(block.device);
    bool all = !present.empty();
    for (const records::Device device : present) {
        auto& list = stretches[device];
        std::size_t count = 0;
        for (const Stretch& s : list) count += static_cast<std::size_t>(s.value.size());
        if (count < fewest(device)) {
            all = false;
            continue;
        }
        if (!rows.cycle.empty())
            remove_zeros_of_cycles(rows.cycle, list);
        else if (device != records::Device::ballbar)
            remove_shift(rows.replay, list);
        const double usual = typical_size(list);
        for (Stretch& s : list)
            s.value = s.value.cwiseMax(-farthest * usual).cwiseMin(farthest * usual);
        noise.of(device) = estimate(rows.replay, device, list, 0.05 * usual, 4.0 * usual);
        noise.of(device).scale =
            std::max(noise.of(device).scale, rounding_of(rows, sigma_mm, device));
        const double independent = noise.of(device).independent(static_cast<double>(count));
        noise.doubt = std::max(noise.doubt, std::sqrt(2.0 / independent));
    }
    if (all) noise.source = NoiseSource::repeats;
    return noise;
}

}  // namespace trunnion::diagnosis
