// Estimates of the noise model, from repeats or from the residuals of a fit.
#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <nlopt.hpp>
#include <set>
#include <utility>

#include "diagnosis/prepare/cycle_zeros.h"
#include "diagnosis/prepare/noise.h"
#include "diagnosis/prepare/repeats.h"
#include "diagnosis/prepare/spoiled_readings.h"
#include "estimation/distributions.h"
#include "estimation/projection.h"
#include "estimation/quantiles.h"
#include "estimation/scatter.h"

namespace trunnion::diagnosis {
namespace {

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

std::vector<double> values_of(const std::vector<Stretch>& stretches) {
    std::vector<double> all;
    for (const Stretch& s : stretches) all.insert(all.end(), s.value.begin(), s.value.end());
    return all;
}

/// Robust size of the differences, at least `least`.
double typical_size(const std::vector<Stretch>& stretches, double least) {
    return std::max(least, estimation::robust_deviation(values_of(stretches)));
}

constexpr double farthest = 6.0;  ///< of the typical difference: an outlier, which must not
                                  ///< determine the noise

/// Removes the effect of a shift of the machine that grows with time from the differences of rows
/// that are no passes. Outliers take no part in it.
void remove_shift(const emulator::Replay& replay, double least, std::vector<Stretch>& stretches) {
    constexpr int p = 6;  // a shift, and one that grows with time
    const double most = farthest * typical_size(stretches, least);
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

/// Takes spoiled differences out of readings that are taken one by one. Returns the deviation of
/// the others.
double without_spoiled(double least, std::vector<Stretch>& list) {
    const estimation::Scatter scatter = estimation::scatter_of(values_of(list), least);
    std::size_t at = 0;
    for (Stretch& s : list) {
        std::vector<Eigen::Index> rows;
        std::vector<double> values;
        for (std::size_t k = 0; k < s.rows.size(); ++k) {
            if (!scatter.kept[at++]) continue;
            rows.push_back(s.rows[k]);
            values.push_back(s.value(static_cast<Eigen::Index>(k)));
        }
        s.rows = std::move(rows);
        s.value = Eigen::Map<const Eigen::VectorXd>(values.data(),
                                                    static_cast<Eigen::Index>(values.size()));
    }
    std::erase_if(list, [](const Stretch& s) { return s.rows.empty(); });
    return scatter.deviation;
}

constexpr double least_of_stated = 0.05;    ///< less is arithmetic
constexpr double least_of_assumed = 0.002;  ///< nobody states it: a stage may be that good

/// Fewer differences say no more than what is stated or usual, unless they contradict it.
std::size_t fewest(records::Device device) {
    return reads_targets(device) ? 10 : 30;
}

/// True where differences tell the noise of a device better than what is stated or usual: they are
/// many, or they contradict it. Few of them, with twice the usual size, are no accident; of some
/// that are smaller than what is stated, the small size may be one. All limits assumed.
bool tell_noise(const std::vector<Stretch>& list, records::Device device, NoiseSource start) {
    constexpr std::size_t least = 4, many = 30;
    constexpr double rare = 1e-3, off = 2.0;
    double squares = 0.0;
    std::size_t count = 0;
    for (const Stretch& s : list) {
        squares += s.value.squaredNorm();
        count += static_cast<std::size_t>(s.value.size());
    }
    const auto freedom = static_cast<double>(count);
    const double larger = estimation::chi_squared_tail(squares, freedom);
    if (count < fewest(device))
        return reads_targets(device) && count >= least && squares > off * off * freedom &&
               larger < rare;
    if (count >= many || start != NoiseSource::given || squares >= freedom) return true;
    return 1.0 - larger < rare;
}

}  // namespace

double least_scatter(const RepeatedRows& rows, const Eigen::VectorXd& sigma_mm,
                     records::Device device) {
    return std::max(least_of_stated, rounding_of(rows, sigma_mm, device));
}

double least_by_rounding(const RepeatedRows& rows, const Eigen::VectorXd& sigma_mm,
                         const NoiseModel& noise) {
    std::set<records::Device> present;
    for (const NoiseBlock& block : rows.blocks) present.insert(block.device);
    double least = 1.0;
    for (const records::Device device : present)
        least = std::min(least, rounding_of(rows, sigma_mm, device) / noise.of(device).scale);
    return least;
}

std::vector<Eigen::Index> cycles_between_jumps(const RepeatedRows& rows,
                                               const Eigen::VectorXd& residual_mm,
                                               const Eigen::VectorXd& sigma_mm) {
    if (rows.cycle.empty()) return {};
    const auto differences =
        differences_of(rows, compared_rows(rows.blocks, rows.used), residual_mm, sigma_mm);
    std::vector<Eigen::Index> cycle = rows.cycle;
    for (const auto& [device, list] : differences)
        cycle = split_at_jumps(cycle, sigma_mm, least_scatter(rows, sigma_mm, device), list);
    return cycle;
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
        if (values_of(list).empty()) {
            all = false;
            continue;
        }
        // What is stated of a device is its resolution or its accuracy; what repeats differ by is
        // known from them alone. A ballbar or a log is one course, and the lines of a laser along
        // several axes have zeros that nothing takes off: their size is told as a whole.
        const bool lines = reads_targets(device) && rows.cycle.empty();
        const bool single = is_single(device) && !lines;
        const double digit = rounding_of(rows, sigma_mm, device);
        const double least = single ? least_scatter(rows, sigma_mm, device) : 1.0;
        if (!rows.cycle.empty())
            remove_zeros_of_cycles(rows.cycle, sigma_mm, least, list);
        else if (device != records::Device::ballbar)
            remove_shift(rows.replay, least, list);
        // Of few differences none is known to be spoiled.
        const bool few = values_of(list).size() < fewest(device);
        double usual = few      ? rms(list)
                       : single ? without_spoiled(least, list)
                                : typical_size(list, least);
        if (!tell_noise(list, device, start.source)) {
            all = false;
            continue;
        }
        usual = std::max(least, usual);
        for (Stretch& s : list)
            s.value = s.value.cwiseMax(-farthest * usual).cwiseMin(farthest * usual);
        const double low = start.source == NoiseSource::given ? least_of_stated : least_of_assumed;
        noise.of(device) =
            estimate(rows.replay, device, list, low * std::max(1.0, usual), 4.0 * usual);
        const auto count = static_cast<double>(values_of(list).size());
        noise.of(device).scale = std::max(noise.of(device).scale, digit);
        const double independent = noise.of(device).independent(count);
        // A variance of few differences is far too small more often than the square root says
        // (assumed).
        const double skew = few ? 1.5 : 1.0;
        noise.doubt = std::max(noise.doubt, skew * std::sqrt(2.0 / independent));
    }
    if (all) noise.source = NoiseSource::repeats;
    return noise;
}

}  // namespace trunnion::diagnosis
