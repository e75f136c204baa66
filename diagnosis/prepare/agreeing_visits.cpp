#include "diagnosis/prepare/agreeing_visits.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "estimation/quantiles.h"

namespace trunnion::diagnosis {
namespace {

/// What is read: device, artefact, direction in thousandths, position of the axes in steps of 1 um
/// or 1 urad.
using ReadAt = std::tuple<records::Device, int, std::vector<long>>;

ReadAt read_at(const Prepared& prepared, std::size_t row) {
    constexpr double steps = 1e3, steps_rad = 1e6;
    const emulator::Contact& contact = prepared.replay.contact(row);
    std::vector<long> at;
    for (const Axis axis : all_axes)
        at.push_back(std::lround(prepared.replay.sample(row).position[axis] *
                                 (prepared.table.names.is_rotary(axis) ? steps_rad : steps)));
    if (contact.device != records::Device::ballbar)
        for (int d = 0; d < 3; ++d) at.push_back(std::lround(contact.direction_M(d) * steps));
    return {contact.device, contact.artefact, std::move(at)};
}

/// True for values that lie close to each other beside their distance from zero.
bool are_alike(const std::vector<double>& values) {
    constexpr double alike = 0.5;  // assumed
    const double middle = estimation::median(values);
    return std::all_of(values.begin(), values.end(),
                       [&](double v) { return std::abs(v - middle) <= alike * std::abs(middle); });
}

}  // namespace

std::vector<std::size_t> visits_of(const emulator::Replay& replay) {
    std::vector<std::size_t> visit(replay.size(), 0);
    for (std::size_t i = 1; i < replay.size(); ++i) {
        const AxisPositions &now = replay.sample(i).position,
                            &before = replay.sample(i - 1).position;
        const bool moved = std::any_of(all_axes.begin(), all_axes.end(),
                                       [&](Axis axis) { return now[axis] != before[axis]; });
        visit[i] = visit[i - 1] + (moved ? 1 : 0);
    }
    return visit;
}

std::vector<std::size_t> without_agreeing(const Prepared& prepared, const std::vector<bool>& used,
                                          std::vector<std::size_t> rows,
                                          const Eigen::VectorXd& left) {
    if (rows.size() < 2) return rows;
    const std::vector<std::size_t> visit = visits_of(prepared.replay);
    struct Visits {
        std::set<std::size_t> all, far_off;
        std::vector<double> left;
    };
    std::map<ReadAt, Visits> places;
    for (const std::size_t i : rows) {
        Visits& own = places[read_at(prepared, i)];
        own.far_off.insert(visit[i]);
        own.left.push_back(left(static_cast<Eigen::Index>(i)));
    }
    for (std::size_t i = 0; i < used.size(); ++i)
        if (const auto place = places.find(read_at(prepared, i)); used[i] && place != places.end())
            place->second.all.insert(visit[i]);
    std::erase_if(rows, [&](std::size_t i) {
        const Visits& own = places.at(read_at(prepared, i));
        return own.far_off.size() >= 2 && 2 * own.far_off.size() > own.all.size() &&
               are_alike(own.left);
    });
    return rows;
}

}  // namespace trunnion::diagnosis
