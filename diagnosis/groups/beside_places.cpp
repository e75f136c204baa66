#include "diagnosis/groups/beside_places.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "base/units.h"
#include "diagnosis/prepare/cycles.h"
#include "estimation/free_form.h"
#include "estimation/projection.h"

namespace trunnion::diagnosis {
namespace {

constexpr std::size_t most_places = 40;  ///< as a free form has

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

Eigen::MatrixXd beside_places(const Prepared& prepared, const Whitener& whitener,
                              Eigen::MatrixXd white) {
    const std::optional<Axis> axis = measured_axis(prepared.replay, prepared.table);
    if (!axis || is_one_sweep(prepared.replay, prepared.table.axes)) return white;
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
