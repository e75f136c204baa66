#include "estimation/pure_error.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "estimation/quantiles.h"

namespace trunnion::estimation {

double PureError::doubt() const {
    return freedom > 0.0 ? std::sqrt(2.0 / freedom) : 0.0;
}

PureError pure_error(const Eigen::VectorXd& values, const std::vector<int>& setting, double limit) {
    std::map<int, std::vector<double>> groups;
    for (std::size_t i = 0; i < setting.size(); ++i)
        if (setting[i] >= 0) groups[setting[i]].push_back(values(static_cast<Eigen::Index>(i)));
    PureError result;
    std::vector<double> off;  // deviations, each scaled to the variance of one reading
    for (const auto& [key, list] : groups) {
        if (list.size() < 2) continue;
        const auto count = static_cast<double>(list.size());
        double mean = 0.0;
        for (const double v : list) mean += v / count;
        for (const double v : list) off.push_back((v - mean) * std::sqrt(count / (count - 1.0)));
        result.freedom += count - 1.0;
    }
    if (off.empty()) return result;
    const double most = limit * robust_deviation(off);
    double sum = 0.0;
    for (const double d : off) sum += most > 0.0 ? std::min(d * d, most * most) : d * d;
    result.variance = sum / static_cast<double>(off.size());
    return result;
}

}  // namespace trunnion::estimation
