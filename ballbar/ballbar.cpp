#include "ballbar/ballbar.h"

#include <cmath>

namespace trunnion::ballbar {

Vector3 cup_to_pivot_M(const kinematics::MachinePose& poses, const Ballbar& bar) {
    return poses.pose_MW * bar.pivot_W_mm - poses.pose_MS * bar.cup_S_mm;
}

double length_deviation_mm(const kinematics::MachinePose& poses, const Ballbar& bar) {
    return cup_to_pivot_M(poses, bar).norm() - bar.length_mm;
}

std::vector<double> sample_times(double start_s, double rate_hz, double from_s, double to_s) {
    std::vector<double> times;
    const double slack = 1e-9;  // in periods: the last sample of one move must not be taken again
    double k = std::ceil((from_s - start_s) * rate_hz - slack);
    for (; start_s + (k + slack) / rate_hz < to_s; k += 1.0) times.push_back(start_s + k / rate_hz);
    return times;
}

}  // namespace trunnion::ballbar
