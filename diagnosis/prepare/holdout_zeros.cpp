#include "diagnosis/prepare/holdout_zeros.h"

#include <cmath>
#include <map>
#include <utility>

#include "estimation/quantiles.h"

namespace trunnion::diagnosis {

std::vector<std::vector<std::size_t>> rows_of_zeros(const emulator::Replay& replay) {
    std::vector<std::vector<std::size_t>> zeros;
    for (const emulator::ZeroGroup& group : replay.zeros()) zeros.push_back(group.rows);
    std::map<std::pair<std::size_t, Axis>, std::vector<std::size_t>> encoders;
    for (std::size_t i = 0; i < replay.size(); ++i)
        if (replay.contact(i).device == records::Device::axis)
            encoders[{replay.session(i), replay.contact(i).axis}].push_back(i);
    for (auto& [encoder, rows] : encoders) zeros.push_back(std::move(rows));
    return zeros;
}

void free_medians(const std::vector<std::vector<std::size_t>>& zeros, Eigen::VectorXd& left_mm) {
    for (const std::vector<std::size_t>& rows : zeros) {
        std::vector<double> values;
        for (const std::size_t i : rows) values.push_back(left_mm(static_cast<Eigen::Index>(i)));
        const double median = estimation::median(std::move(values));
        for (const std::size_t i : rows) left_mm(static_cast<Eigen::Index>(i)) -= median;
    }
}

void free_means(const std::vector<std::vector<std::size_t>>& zeros, const std::vector<bool>& used,
                const Eigen::VectorXd& sigma_mm, Eigen::VectorXd& left_mm) {
    for (const std::vector<std::size_t>& rows : zeros) {
        double sum = 0.0, weights = 0.0;
        for (const std::size_t i : rows) {
            if (!used[i]) continue;
            const auto at = static_cast<Eigen::Index>(i);
            const double weight = 1.0 / (sigma_mm(at) * sigma_mm(at));
            sum += weight * left_mm(at);
            weights += weight;
        }
        if (weights == 0.0) continue;
        for (const std::size_t i : rows) left_mm(static_cast<Eigen::Index>(i)) -= sum / weights;
    }
}

}  // namespace trunnion::diagnosis
