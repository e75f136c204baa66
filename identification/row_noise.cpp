#include "identification/row_noise.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "emulator/device_noise.h"
#include "identification/resolution.h"

namespace trunnion::identification {

bool states_noise(const setup::Setup& setup, const records::Reading& row) {
    return emulator::device_noise(setup.model, row).given;
}

RowNoise stated_noise(const setup::Setup& setup, const records::ReadingTable& table,
                      const emulator::Replay& replay) {
    RowNoise noise;
    noise.sigma_mm.resize(static_cast<Eigen::Index>(replay.size()));
    for (std::size_t i = 0; i < replay.size(); ++i) {
        const records::Reading& row = table.rows[replay.table_row(i)];
        const emulator::DeviceNoise of_row = emulator::device_noise(setup.model, row);
        noise.sigma_mm(static_cast<Eigen::Index>(i)) = of_row.sigma_mm;
        noise.given = noise.given && of_row.given;
    }
    return noise;
}

RowNoise row_noise(const setup::Setup& setup, const records::ReadingTable& table,
                   const emulator::Replay& replay) {
    RowNoise noise = stated_noise(setup, table, replay);
    add_rounding(table, replay, noise.sigma_mm);
    add_rest_scatter(setup, table, replay, noise.sigma_mm);
    return noise;
}

Eigen::VectorXd row_weights(const Eigen::VectorXd& residual_mm, const Eigen::VectorXd& sigma_mm) {
    std::vector<double> size;
    for (Eigen::Index i = 0; i < residual_mm.size(); ++i)
        size.push_back(std::abs(residual_mm(i)) / sigma_mm(i));
    std::vector<double> sorted = size;
    std::nth_element(sorted.begin(), sorted.begin() + static_cast<long>(sorted.size() / 2),
                     sorted.end());
    const double limit = 3.0 * std::max(1.0, 1.4826 * sorted[sorted.size() / 2]);
    Eigen::VectorXd weight = sigma_mm.cwiseInverse();
    const auto beyond =
        std::count_if(size.begin(), size.end(), [&](double s) { return s > limit; });
    if (10 * beyond > residual_mm.size()) return weight;
    for (Eigen::Index i = 0; i < residual_mm.size(); ++i) {
        const double s = size[static_cast<std::size_t>(i)];
        if (s > limit) weight(i) *= std::sqrt(limit / s);
    }
    return weight;
}

}  // namespace trunnion::identification
