#include "diagnosis/prepare/near_readings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace trunnion::diagnosis {
namespace {

constexpr std::size_t least_pairs = 20, most_pairs = 400;
constexpr double near = 0.25;  ///< of the ranges of the axes: further off is no neighbour (assumed)
constexpr double same_direction = 0.999;      ///< cosine
constexpr double counted = 0.75;              ///< of the squares: the smallest ones
constexpr double mean_of_counted = 0.368520;  ///< of squared standard normal deviates
/// Deviation of the mean of n counted squares, times root n: these are pairs with common readings
/// (simulated: 2.5 to 2.8).
constexpr double doubt_of_one = 2.5;

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

/// The direction of a reading seen from the bed, from the table and from the tool.
std::array<Vector3, 3> seen_directions(const emulator::Contact& contact) {
    return {contact.direction_M, contact.direction_W,
            contact.believed_WS.rotation.transpose() * contact.direction_W};
}

bool is_alike(const emulator::Contact& a, const emulator::Contact& b) {
    if (a.device != b.device) return false;
    const auto first = seen_directions(a), second = seen_directions(b);
    for (std::size_t k = 0; k < first.size(); ++k)
        if (first[k].dot(second[k]) > same_direction) return true;
    return false;
}

/// Mean of the smallest squares, as a variance.
double variance_of(std::vector<double> squares) {
    std::sort(squares.begin(), squares.end());
    const auto count = static_cast<std::size_t>(counted * static_cast<double>(squares.size()));
    double sum = 0.0;
    for (std::size_t k = 0; k < count; ++k) sum += squares[k];
    return sum / static_cast<double>(count) / mean_of_counted;
}

/// The residuals of a reading and its nearest neighbour, in their sigma.
struct Pair {
    std::size_t first, second;  ///< device rows, in order
    double a, b;
};

Pair pair_of(std::size_t i, std::size_t j, const Eigen::VectorXd& left_mm,
             const Eigen::VectorXd& sigma_mm) {
    const std::size_t first = std::min(i, j), second = std::max(i, j);
    const auto a = static_cast<Eigen::Index>(first), b = static_cast<Eigen::Index>(second);
    return {first, second, left_mm(a) / sigma_mm(a), left_mm(b) / sigma_mm(b)};
}

/// Square of the difference of two readings, relative to what their sigmas say.
double square_between(const Pair& pair, const Eigen::VectorXd& left_mm,
                      const Eigen::VectorXd& sigma_mm) {
    const auto a = static_cast<Eigen::Index>(pair.first),
               b = static_cast<Eigen::Index>(pair.second);
    const double difference = (left_mm(a) - left_mm(b)) / std::hypot(sigma_mm(a), sigma_mm(b));
    return difference * difference;
}

/// Mean product of neighbours in its deviations, were they independent; far residuals count as
/// three times the usual one, lest one pair of spoiled readings decides. Readings that are nearest
/// to each other are one pair.
double likeness_of(std::vector<Pair> pairs) {
    constexpr double far = 3.0;
    const auto rows = [](const Pair& p) { return std::pair(p.first, p.second); };
    std::sort(pairs.begin(), pairs.end(),
              [&](const Pair& x, const Pair& y) { return rows(x) < rows(y); });
    pairs.erase(std::unique(pairs.begin(), pairs.end(),
                            [&](const Pair& x, const Pair& y) { return rows(x) == rows(y); }),
                pairs.end());
    std::vector<double> squares;
    for (const Pair& p : pairs) squares.push_back(0.5 * (p.a * p.a + p.b * p.b));
    const double usual = std::sqrt(variance_of(squares)), most = far * usual;
    double product = 0.0, square = 0.0;
    for (const Pair& p : pairs) {
        const double a = std::clamp(p.a, -most, most), b = std::clamp(p.b, -most, most);
        product += a * b;
        square += 0.5 * (a * a + b * b);
    }
    return square > 0.0 ? product / square * std::sqrt(static_cast<double>(pairs.size())) : 0.0;
}

NeighbourNoise noise_of_pairs(std::vector<Pair> pairs, const Eigen::VectorXd& left_mm,
                              const Eigen::VectorXd& sigma_mm) {
    if (pairs.size() < least_pairs) return {};
    std::vector<double> squares;
    for (const Pair& pair : pairs) squares.push_back(square_between(pair, left_mm, sigma_mm));
    const double doubt = doubt_of_one / std::sqrt(static_cast<double>(squares.size()));
    return {variance_of(std::move(squares)), doubt, likeness_of(std::move(pairs))};
}

}  // namespace

NeighbourNoise noise_of_neighbours(const emulator::Replay& replay, const std::vector<bool>& used,
                                   const Eigen::VectorXd& left_mm,
                                   const Eigen::VectorXd& sigma_mm) {
    const std::vector<Eigen::VectorXd> places = relative_positions(replay);
    const auto counts = [&](std::size_t i) {
        const records::Device device = replay.contact(i).device;
        return used[i] && (device == records::Device::angle || device == records::Device::point);
    };
    std::vector<Pair> pairs;
    const std::size_t step = 1 + replay.size() / most_pairs;
    for (std::size_t i = 0; i < replay.size(); i += step) {
        if (!counts(i)) continue;
        double nearest = near * near;
        std::size_t neighbour = i;
        for (std::size_t j = 0; j < replay.size(); ++j) {
            if (j == i || !counts(j) || !is_alike(replay.contact(i), replay.contact(j))) continue;
            const double distance = (places[i] - places[j]).squaredNorm();
            if (distance >= nearest) continue;
            nearest = distance;
            neighbour = j;
        }
        if (neighbour != i) pairs.push_back(pair_of(i, neighbour, left_mm, sigma_mm));
    }
    return noise_of_pairs(std::move(pairs), left_mm, sigma_mm);
}

NeighbourNoise noise_of_successive(const emulator::Replay& replay,
                                   const std::vector<NoiseBlock>& blocks,
                                   const std::vector<bool>& used, const Eigen::VectorXd& left_mm,
                                   const Eigen::VectorXd& sigma_mm) {
    std::vector<Pair> pairs;
    for (const NoiseBlock& block : blocks) {
        if (block.device != records::Device::axis) continue;
        std::map<Axis, std::size_t> last;
        for (const Eigen::Index row : block.rows) {
            const auto i = static_cast<std::size_t>(row);
            if (!used[i]) continue;
            const auto [before, is_first] = last.try_emplace(replay.contact(i).axis, i);
            if (!is_first) pairs.push_back(pair_of(before->second, i, left_mm, sigma_mm));
            before->second = i;
        }
    }
    return noise_of_pairs(std::move(pairs), left_mm, sigma_mm);
}

}  // namespace trunnion::diagnosis
