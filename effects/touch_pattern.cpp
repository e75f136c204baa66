#include "effects/touch_pattern.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>

#include "base/units.h"

namespace trunnion::effects {
namespace {

TouchPattern make_pattern(int touches) {
    TouchPattern pattern;
    pattern.outward_M.push_back(Vector3::UnitZ());
    const int rest = std::max(4, touches - 1), rings = (rest + 3) / 4;
    for (int k = 0; k < rest; ++k) {
        const int ring = k / 4, quarter = k % 4;
        const double up = pi / 2.0 * ring / rings, azimuth = pi / 2.0 * quarter;
        pattern.outward_M.emplace_back(std::cos(up) * std::cos(azimuth),
                                       std::cos(up) * std::sin(azimuth), std::sin(up));
    }
    const auto n = static_cast<Eigen::Index>(pattern.outward_M.size());
    Eigen::MatrixX4d design(n, 4);
    for (Eigen::Index k = 0; k < n; ++k)
        design.row(k) << pattern.outward_M[static_cast<std::size_t>(k)].transpose(), 1.0;
    const Eigen::Matrix4d normal = design.transpose() * design;
    pattern.response = normal.ldlt().solve(design.transpose()).topRows<3>();
    return pattern;
}

}  // namespace

Vector3 TouchPattern::center_shift(
    const std::function<double(const Vector3& outward_M)>& deviation_mm) const {
    Vector3 shift_mm = Vector3::Zero();
    for (std::size_t k = 0; k < outward_M.size(); ++k)
        shift_mm += response.col(static_cast<Eigen::Index>(k)) * deviation_mm(outward_M[k]);
    return shift_mm;
}

const TouchPattern& touch_pattern(int touches) {
    static std::mutex mutex;
    static std::map<int, TouchPattern> known;
    const std::lock_guard lock(mutex);
    const auto it = known.find(touches);
    return it != known.end() ? it->second
                             : known.emplace(touches, make_pattern(touches)).first->second;
}

}  // namespace trunnion::effects
