// Where a gap lives, without naming a cause: how much of it follows each driver.
#pragma once

#include "diagnosis/diagnosis.h"

namespace trunnion {

/// Part of `left_mm` that smooth functions of each driver explain beyond the columns `known` (mm).
/// Its size is measured in stated sigma, its F test on whitened readings, so that what neighbours
/// share does not pass for structure. Rows with `used` 0 take no part. Strongest first.
struct DriverTest {
    std::string by, component, text;
    double explained = 0.0;  ///< fall of the mean squared z, freedom accounted for
    double p_value = 1.0;    ///< corrected for the number of drivers tried
    int columns = 0;
    double gain = 0.0;  ///< fall of the whitened squared sum
};
std::vector<DriverTest> test_drivers(const Replay& replay, const ReadingTable& table,
                                     const BaseModel& base, const Eigen::MatrixXd& known,
                                     const Eigen::VectorXd& left_mm,
                                     const Eigen::VectorXd& sigma_mm, const std::vector<bool>& used,
                                     const Whitener& whitener);

/// `left_mm` less what the significant drivers explain together, up to a third of the readings'
/// freedom; `lost` is the freedom they took.
Eigen::VectorXd without_drivers(const Replay& replay, const ReadingTable& table,
                                const BaseModel& base, const Eigen::MatrixXd& known,
                                const Eigen::VectorXd& left_mm, const Eigen::VectorXd& sigma_mm,
                                const std::vector<bool>& used, const Whitener& whitener,
                                double& lost);

}  // namespace trunnion
