#include "diagnosis/groups/beside_places.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "base/units.h"
#include "estimation/free_form.h"
#include "estimation/projection.h"

namespace trunnion::diagnosis {
namespace {

constexpr std::size_t most_places = 40;  ///< as a free form has

/// The only axis that moves; empty for none or several.
std::optional<Axis> only_moving(const Prepared& p) {
    std::optional<Axis> only;
    for (const Axis axis : p.table.axes) {
        const double first = p.replay.sample(0).position[axis];
        bool moves = false;
        for (std::size_t i = 1; i < p.replay.size() && !moves; ++i)
            moves = p.replay.sample(i).position[axis] != first;
        if (!moves) continue;
        if (only) return std::nullopt;
        only = axis;
    }
    return only;
}

/// Of a rotary axis within its turn.
std::vector<double> places_in_turn(const Prepared& p, Axis axis) {
    std::vector<double> places;
    for (std::size_t i = 0; i < p.replay.size(); ++i) {
        const double at = p.replay.sample(i).position[axis];
        places.push_back(p.table.names.is_rotary(axis) ? std::remainder(at, 2.0 * pi) : at);
    }
    return places;
}

}  // namespace

bool have_one_direction(const emulator::Replay& replay) {
    for (std::size_t i = 0; i < replay.size(); ++i) {
        const records::Device device = replay.contact(i).device;
        if (device != records::Device::linear && device != records::Device::angle) return false;
    }
    return true;
}

Eigen::MatrixXd beside_places(const Prepared& prepared, const Whitener& whitener,
                              Eigen::MatrixXd white) {
    if (!have_one_direction(prepared.replay) || is_one_sweep(prepared.replay, prepared.table.axes))
        return white;
    const std::optional<Axis> axis = only_moving(prepared);
    if (!axis) return white;
    const std::vector<double> places = places_in_turn(prepared, *axis);
    // With a place for every two readings half of what they tell is left to time.
    const std::vector<double> knots =
        estimation::knots_of(places, std::min(most_places, places.size() / 2));
    if (knots.size() < 2) return white;
    Eigen::MatrixXd hats =
        Eigen::MatrixXd::Zero(white.rows(), static_cast<Eigen::Index>(knots.size()));
    for (std::size_t i = 0; i < places.size(); ++i) {
        const auto [k, w] = estimation::place_between(knots, places[i]);
        hats(static_cast<Eigen::Index>(i), k) = 1.0 - w;
        hats(static_cast<Eigen::Index>(i), k + 1) = w;
    }
    whitener.apply(hats);
    return estimation::Projection(hats).beside(white);
}

}  // namespace trunnion::diagnosis
