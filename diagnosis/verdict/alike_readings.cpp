#include "diagnosis/verdict/alike_readings.h"

#include <algorithm>
#include <cmath>

#include "diagnosis/prepare/near_readings.h"
#include "diagnosis/rules/rules.h"
#include "diagnosis/search/solution.h"

namespace trunnion::diagnosis {
namespace {

/// Mean square of what a model leaves of a ballbar, in the variance of its noise; 0 where
/// neighbours share none of it.
double slow_variance(const Prepared& p, Design& design, const Model& model,
                     const NoiseModel& noise) {
    constexpr double farthest = 6.0;  // deviations: a few spoiled readings are no course
    double square = 0.0, count = 0.0;
    const Eigen::VectorXd left = left_mm(p, design, model, solved(design, model));
    for (std::size_t i = 0; i < p.replay.size(); ++i) {
        const DeviceNoise& own = noise.of(p.replay.contact(i).device);
        if (p.replay.contact(i).device != records::Device::ballbar || own.shared <= 0.0) continue;
        const auto row = static_cast<Eigen::Index>(i);
        const double size = std::abs(left(row)) / (own.scale * p.base.sigma_mm(row));
        square += std::pow(std::min(size, farthest), 2);
        count += 1.0;
    }
    return count > 0.0 ? square / count : 0.0;
}

}  // namespace

double part_of(const Judgement& j, double unknowns) {
    const double excess = j.before - j.floor * (1.0 + unknowns);
    return excess > 0.0 ? (j.before - j.after) / excess : 0.0;
}

void see_neighbours(const Prepared& p, const std::vector<bool>& used,
                    const Eigen::VectorXd& remainder, double unknowns, Judgement& j) {
    constexpr double beyond_digit = 2.0;  // of the variance that is expected (assumed)
    const auto rows = static_cast<Eigen::Index>(used.size());
    const Eigen::VectorXd left = remainder.head(rows), one = Eigen::VectorXd::Ones(rows);
    NeighbourNoise near = noise_of_neighbours(p.replay, used, left, one);
    const bool log = near.variance == 0.0 && j.floor > beyond_digit;
    if (log) near = noise_of_successive(p.replay, p.blocks, used, left, one);
    if (near.alike < rules::alike || near.variance >= j.floor) return;
    j.gap = true;
    j.alike_near = !log;
    j.alike_in_time = log;
    j.floor = near.variance;
    j.part = part_of(j, unknowns);
}

void see_slow_course(const Prepared& p, Design& design, const Model& model, const NoiseModel& noise,
                     Judgement& j) {
    if (slow_variance(p, design, model, noise) <= rules::most_slow) return;
    j.gap = j.alike_in_time = true;
}

}  // namespace trunnion::diagnosis
