#include "diagnosis/prepare/outliers.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "diagnosis/prepare/agreeing_visits.h"
#include "diagnosis/rules/rules.h"
#include "estimation/distributions.h"
#include "estimation/projection.h"
#include "estimation/quantiles.h"

namespace trunnion::diagnosis {
namespace {

constexpr double wild_sigma = 4.5;
constexpr double least_deviation = 0.5;  ///< minimum scale, relative to the noise

/// Residuals of the set-up fit to the rows of `used`, divided by their own standard deviation.
Eigen::VectorXd studentised(const identification::BaseModel& base, const std::vector<bool>& used) {
    Eigen::VectorXd weight = base.sigma_mm.cwiseInverse();
    for (Eigen::Index i = 0; i < weight.size(); ++i)
        if (!used[static_cast<std::size_t>(i)]) weight(i) = 0.0;
    const estimation::Projection set_up(weight.asDiagonal() * base.columns);
    const Eigen::VectorXd left = set_up.beside(weight.cwiseProduct(base.residual_mm));
    const Eigen::ArrayXd own = 1.0 - set_up.basis().rowwise().squaredNorm().array();
    return left.array() / own.max(0.05).sqrt();
}

/// A value that the maximum of n normal deviates rarely exceeds.
double largest_by_chance(double n) {
    return std::sqrt(2.0 * std::log(std::max(2.0, n))) + 1.0;
}

/// Rows in ascending order, numbered among all of their kind.
struct Hit {
    std::vector<std::size_t> numbers;
    std::size_t all = 0;  ///< of the kind
};

/// The kinds are told apart: probe readings beside many of a ballbar stand close to each other in
/// the table, however they are spread over the visits.
std::map<records::Device, Hit> by_device(const std::vector<std::size_t>& rows,
                                         const std::vector<records::Device>& devices) {
    std::map<records::Device, Hit> kinds;
    std::size_t next = 0;
    for (std::size_t i = 0; i < devices.size(); ++i) {
        Hit& hit = kinds[devices[i]];
        if (next < rows.size() && rows[next] == i) {
            hit.numbers.push_back(hit.all);
            ++next;
        }
        ++hit.all;
    }
    return kinds;
}

/// True when the rows are in three or more neighbouring blocks (poses, passes). One bad pose may
/// spoil all its readings; random blocks rarely are neighbours.
bool crowded(const std::vector<std::size_t>& rows, const std::vector<NoiseBlock>& blocks) {
    std::map<records::Device, std::size_t> count;
    std::map<std::size_t, std::pair<records::Device, std::size_t>> block_of;  // by row
    for (const NoiseBlock& block : blocks) {
        for (const Eigen::Index row : block.rows)
            block_of[static_cast<std::size_t>(row)] = {block.device, count[block.device]};
        ++count[block.device];
    }
    std::map<records::Device, std::set<std::size_t>> hits;
    for (const std::size_t row : rows) hits[block_of[row].first].insert(block_of[row].second);
    for (const auto& [device, hit] : hits) {
        if (hit.size() < 3) continue;
        const auto close = std::max<std::size_t>(1, count[device] / (5 * hit.size()));
        std::size_t pairs = 0;
        for (auto it = std::next(hit.begin()); it != hit.end(); ++it)
            pairs += *it - *std::prev(it) <= close ? 1 : 0;
        if (10 * pairs > 4 * hit.size()) return true;
    }
    return false;
}

/// The same within one pass, whose readings are one block. With random rows 18 of 100 neighbours
/// are closer than a fifth of the mean distance.
bool crowded(const Hit& hit) {
    const std::vector<std::size_t>& rows = hit.numbers;
    if (rows.size() <= 8) return false;
    const std::size_t close = std::max<std::size_t>(2, hit.all / (5 * rows.size()));
    std::size_t pairs = 0;
    for (std::size_t k = 1; k < rows.size(); ++k) pairs += rows[k] - rows[k - 1] <= close ? 1 : 0;
    return 10 * pairs > 4 * rows.size();
}

bool crowded(const std::vector<std::size_t>& rows, const std::vector<records::Device>& devices) {
    const auto kinds = by_device(rows, devices);
    return std::any_of(kinds.begin(), kinds.end(),
                       [](const auto& kind) { return crowded(kind.second); });
}

/// True where each visit of a position is read along several directions.
bool reads_several_ways(records::Device device) {
    return device == records::Device::sphere || device == records::Device::touch ||
           device == records::Device::point;
}

/// +-1, 2 or 3 of a reading along X, Y or Z of M; 0 between them.
int direction_of(const emulator::Contact& contact) {
    constexpr double along = 0.9;  // cosine
    for (int d = 0; d < 3; ++d)
        if (std::abs(contact.direction_M(d)) > along)
            return contact.direction_M(d) > 0.0 ? d + 1 : -d - 1;
    return 0;
}

/// Readings of one device along each direction.
struct Counts {
    std::map<int, double> along;
    double all = 0.0;
};

bool too_many(std::size_t count, std::size_t all) {
    return static_cast<double>(count) > rules::most_outliers * static_cast<double>(all);
}

}  // namespace

std::vector<records::Device> devices_of(const emulator::Replay& replay) {
    std::vector<records::Device> devices;
    for (std::size_t i = 0; i < replay.size(); ++i) devices.push_back(replay.contact(i).device);
    return devices;
}

std::vector<std::size_t> lone_probe_readings(const Prepared& prepared,
                                             const std::vector<bool>& used) {
    std::vector<bool> kept = used;
    std::vector<std::size_t> lone;
    const Eigen::ArrayXd digit = last_digit(prepared.rounding_mm, prepared.base.sigma_mm);
    const auto is_probe_row = [&](std::size_t i) {
        const records::Device device = prepared.replay.contact(i).device;
        return device == records::Device::sphere || device == records::Device::touch;
    };
    for (int pass = 0; pass < 40; ++pass) {
        const Eigen::ArrayXd all = studentised(prepared.base, kept).cwiseAbs();
        const Eigen::ArrayXd z = all - digit;
        std::vector<double> size;
        double worst = 0.0;
        for (std::size_t i = 0; i < kept.size(); ++i) {
            if (!kept[i] || !is_probe_row(i)) continue;
            size.push_back(all(static_cast<Eigen::Index>(i)));
            worst = std::max(worst, z(static_cast<Eigen::Index>(i)));
        }
        const double limit = largest_by_chance(static_cast<double>(used.size())) *
                             std::max(least_deviation, estimation::robust_deviation(size));
        if (size.empty() || worst < limit) break;
        for (std::size_t i = 0; i < kept.size(); ++i) {
            if (!kept[i] || !is_probe_row(i)) continue;
            if (z(static_cast<Eigen::Index>(i)) < std::max(limit, 0.7 * worst)) continue;
            kept[i] = false;
            lone.push_back(i);
        }
        if (too_many(lone.size(), used.size())) return {};
    }
    std::sort(lone.begin(), lone.end());
    if (crowded(lone, devices_of(prepared.replay)) || crowded(lone, prepared.blocks)) return {};
    return without_agreeing(prepared, used, std::move(lone),
                            prepared.base.residual_mm.cwiseQuotient(prepared.base.sigma_mm));
}

Eigen::VectorXd last_digit(const Eigen::VectorXd& rounding_mm, const Eigen::VectorXd& sigma_mm) {
    return std::sqrt(12.0) * rounding_mm.cwiseQuotient(sigma_mm);
}

double most_by_chance(std::size_t readings) {
    constexpr double deviations = 2.0;  // of the number of rare events
    const double expected = rules::most_outliers * static_cast<double>(readings);
    return expected + deviations * std::sqrt(expected);
}

std::vector<std::size_t> wild_readings(const NoisyResiduals& rows, const std::vector<bool>& used,
                                       double most) {
    const auto size_of = [&](std::size_t i) {
        return std::abs(rows.left(static_cast<Eigen::Index>(i)));
    };
    std::vector<double> size;
    for (std::size_t i = 0; i < used.size(); ++i)
        if (used[i]) size.push_back(size_of(i));
    const double limit = std::max(wild_sigma, largest_by_chance(static_cast<double>(size.size()))) *
                         std::max(least_deviation, estimation::robust_deviation(size));
    std::vector<std::size_t> wild;
    for (std::size_t i = 0; i < used.size(); ++i)
        if (used[i] && size_of(i) > limit + rows.digit(static_cast<Eigen::Index>(i)))
            wild.push_back(i);
    const bool keep = static_cast<double>(wild.size()) > most || crowded(wild, rows.devices);
    return keep ? std::vector<std::size_t>{} : wild;
}

bool are_spoiled(const std::vector<bool>& used) {
    const auto count = static_cast<double>(std::count(used.begin(), used.end(), false));
    return count > most_by_chance(used.size());
}

bool are_along_one(const std::vector<bool>& used, const emulator::Replay& replay) {
    constexpr double rare = 1e-3;  // (assumed)
    std::map<records::Device, Counts> present, aside;
    for (std::size_t i = 0; i < used.size(); ++i) {
        const emulator::Contact& contact = replay.contact(i);
        if (!reads_several_ways(contact.device)) continue;
        const int direction = direction_of(contact);
        for (auto* counts : {&present, &aside}) {
            if (counts == &aside && used[i]) continue;
            (*counts)[contact.device].along[direction] += 1.0;
            (*counts)[contact.device].all += 1.0;
        }
    }
    for (const auto& [device, hits] : aside)
        for (const auto& [direction, count] : hits.along) {
            const Counts& all = present.at(device);
            const double part = all.along.at(direction) / all.all;
            if (estimation::binomial_tail(count, hits.all, part) *
                    static_cast<double>(all.along.size()) <
                rare)
                return true;
        }
    return false;
}

bool are_spoiled(const std::vector<bool>& used, const emulator::Replay& replay) {
    return are_spoiled(used) || are_along_one(used, replay);
}

}  // namespace trunnion::diagnosis
