#include "diagnosis/prepare/near_readings.h"

#include <algorithm>
#include <cmath>

#include "estimation/quantiles.h"

namespace trunnion::diagnosis {
namespace {

constexpr std::size_t least_pairs = 20, most_pairs = 400;
constexpr double near = 0.25;  ///< of the ranges of the axes: further off is no neighbour (assumed)
constexpr double same_direction = 0.999;             ///< cosine
constexpr double median_of_square = 0.454936423119;  ///< of a squared standard normal deviate

/// Positions of all rows, each axis in parts of its range.
std::vector<Eigen::VectorXd> relative_positions(const emulator::Replay& replay) {
    std::vector<Eigen::VectorXd> places;
    for (std::size_t i = 0; i < replay.size(); ++i) {
        places.emplace_back(Eigen::Map<const Eigen::VectorXd>(
            replay.sample(i).position.value.data(), static_cast<Eigen::Index>(axis_count)));
    }
    if (places.empty()) return places;
    Eigen::VectorXd low = places.front(), high = low;
    for (const Eigen::VectorXd& place : places) {
        low = low.cwiseMin(place);
        high = high.cwiseMax(place);
    }
    const Eigen::ArrayXd range = (high - low).array();
    const Eigen::ArrayXd scale = (range > 0.0).select(range.max(1e-300).inverse(), 0.0);
    for (Eigen::VectorXd& place : places) place = (place.array() * scale).matrix();
    return places;
}

}  // namespace

double variance_of_neighbours(const emulator::Replay& replay, const std::vector<bool>& used,
                              const Eigen::VectorXd& white) {
    const std::vector<Eigen::VectorXd> places = relative_positions(replay);
    const auto counts = [&](std::size_t i) {
        const records::Device device = replay.contact(i).device;
        return used[i] && (device == records::Device::angle || device == records::Device::point);
    };
    const auto is_alike = [&](std::size_t i, std::size_t j) {
        const emulator::Contact &a = replay.contact(i), &b = replay.contact(j);
        return a.device == b.device && a.direction_M.dot(b.direction_M) > same_direction;
    };
    std::vector<double> squares;
    const std::size_t step = 1 + replay.size() / most_pairs;
    for (std::size_t i = 0; i < replay.size(); i += step) {
        if (!counts(i)) continue;
        double nearest = near * near, difference = 0.0;
        for (std::size_t j = 0; j < replay.size(); ++j) {
            if (j == i || !counts(j) || !is_alike(i, j)) continue;
            const double distance = (places[i] - places[j]).squaredNorm();
            if (distance >= nearest) continue;
            nearest = distance;
            difference = white(static_cast<Eigen::Index>(i)) - white(static_cast<Eigen::Index>(j));
        }
        if (nearest < near * near) squares.push_back(0.5 * difference * difference);
    }
    if (squares.size() < least_pairs) return 0.0;
    return estimation::quantile(squares, 0.5) / median_of_square;
}

}  // namespace trunnion::diagnosis
