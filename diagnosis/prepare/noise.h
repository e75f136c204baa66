// The noise of readings: its size (noise_estimate.cpp), and its correlation between neighbours.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "emulator/replay.h"

namespace trunnion::diagnosis {

enum class NoiseSource : unsigned char { given, repeats, assumed };
const char* to_string(NoiseSource source);

/// Covariance of one device's readings, in units of each row's stated sigma:
///   sphere   scale^2
///   touch    scale^2 ((1 - shared) delta + shared n_i . n_j) within the touches of one pose
///   point    scale^2 ((1 - shared - turned) delta + shared n_i . n_j + turned m_i . m_j) within
///            one stop of the axes; m: arm of the target x direction, of mean square 1 in a stop
///   ballbar  scale^2 ((1 - shared) delta + shared memory^|i - j|) along one pass
///   others   scale^2
struct DeviceNoise {
    double scale = 1.0;
    double shared = 0.0;  ///< fraction of the variance shared by neighbours
    double memory = 0.9;  ///< correlation of the shared part from one ballbar sample to the next
    double turned = 0.0;  ///< of points: fraction shared as a rotation of the stop

    /// Number of independent readings with the same information about the variance as `rows` of
    /// these.
    double independent(double rows) const {
        const double m2 = memory * memory;  // 0 for touches: eight neighbours with random
                                            // directions
        const double pairs = m2 > 0.0 ? 2.0 * m2 / (1.0 - m2) : 8.0 / 3.0;
        return rows / (1.0 + shared * shared * pairs);
    }
};

struct NoiseModel {
    DeviceNoise sphere, touch, ballbar, linear, angle, point, axis;
    NoiseSource source = NoiseSource::given;
    double doubt = 0.0;  ///< relative standard error of the variance, if estimated from repeats
    const DeviceNoise& of(records::Device device) const;
    DeviceNoise& of(records::Device device);
};

/// True for a laser and an autocollimator: readings taken one by one at targets (ISO 230-2).
constexpr bool reads_targets(records::Device device) {
    return device == records::Device::linear || device == records::Device::angle;
}

/// Device rows that share an error: the touches (or components) of one pose, or the samples of one
/// ballbar pass. Each device row belongs to exactly one block.
struct NoiseBlock {
    records::Device device = records::Device::none;
    std::vector<Eigen::Index> rows;
};
std::vector<NoiseBlock> noise_blocks(const emulator::Replay& replay,
                                     const records::ReadingTable& table);

/// The same with one block for all that an instrument reads at one stop of the axes: what the
/// machine does not repeat moves all targets alike.
std::vector<NoiseBlock> stops_of(const std::vector<NoiseBlock>& blocks,
                                 const emulator::Replay& replay);
/// Covariance of touches, or of the targets of a stop, in their sigma.
Eigen::MatrixXd shared_covariance(const emulator::Replay& replay,
                                  const std::vector<Eigen::Index>& rows, const DeviceNoise& noise);

/// Multiplies by the inverse square root of the noise covariance, block by block.
class Whitener {
  public:
    Whitener(const emulator::Replay& replay, std::vector<NoiseBlock> blocks,
             const NoiseModel& noise, const Eigen::VectorXd& sigma_mm);
    /// Whitens every column of `m` (mm): independent rows with variance 1.
    void apply(Eigen::MatrixXd& m) const;
    Eigen::VectorXd apply(const Eigen::VectorXd& v) const;

  private:
    void whiten_shared(const NoiseBlock& block, Eigen::MatrixXd& m) const;
    void whiten_pass(const NoiseBlock& block, Eigen::MatrixXd& m) const;

    const emulator::Replay& replay_;
    std::vector<NoiseBlock> blocks_;
    NoiseModel noise_;
    Eigen::VectorXd sigma_mm_;
};

/// Readings in which repeats are looked for.
struct RepeatedRows {
    const emulator::Replay& replay;
    const records::ReadingTable& table;
    const std::vector<NoiseBlock>& blocks;
    const std::vector<bool>& used;           ///< of device rows; others repeat nothing
    const std::vector<Eigen::Index>& cycle;  ///< of each row of a laser test, else empty
    const Eigen::VectorXd& rounding_mm;  ///< least deviation of a row (identification/resolution.h)
};

/// The smallest part of the noise of a device, by sigma and its scale, that its last digits are.
double least_by_rounding(const RepeatedRows& rows, const Eigen::VectorXd& sigma_mm,
                         const NoiseModel& noise);

/// Noise from repeated poses and passes: differences of their residuals, after removing a shift
/// between the two. No device is better than the last digit of its readings, however well they
/// repeat. Devices without enough repeats keep the values of `start`; `source` says whether repeats
/// were used.
NoiseModel noise_from_repeats(const RepeatedRows& rows, const Eigen::VectorXd& residual_mm,
                              const Eigen::VectorXd& sigma_mm, const NoiseModel& start);

}  // namespace trunnion::diagnosis
