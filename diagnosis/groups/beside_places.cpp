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

/// Of several turns of a rotary axis within one. Of one turn the ends stay apart: what winds up
/// behind a reversal is not the same at both.
std::vector<double> places_in_turn(const Prepared& p, Axis axis) {
    constexpr double one_turn_rad = 2.0 * pi + 0.01;
    std::vector<double> places;
    for (std::size_t i = 0; i < p.replay.size(); ++i)
        places.push_back(p.replay.sample(i).position[axis]);
    const auto [low, high] = std::minmax_element(places.begin(), places.end());
    if (!p.table.names.is_rotary(axis) || *high - *low < one_turn_rad) return places;
    for (double& place : places) place = std::remainder(place, 2.0 * pi);
    return places;
}

/// True where most places were read from both sides, twice from each.
bool repeats_both_sides(const Prepared& p, Axis axis, const std::vector<double>& places,
                        const std::vector<double>& knots) {
    std::vector<int> forward(knots.size(), 0), back(knots.size(), 0);
    for (std::size_t i = 0; i < places.size(); ++i) {
        const auto [k, w] = estimation::place_between(knots, places[i]);
        const auto nearest = static_cast<std::size_t>(k) + (w > 0.5 ? 1 : 0);
        const int travel = p.replay.sample(i).travel[index_of(axis)];
        if (travel != 0) ++(travel > 0 ? forward : back)[nearest];
    }
    std::size_t twice = 0;
    for (std::size_t k = 0; k < knots.size(); ++k)
        if (std::min(forward[k], back[k]) >= 2) ++twice;
    return 2 * twice >= knots.size();
}

/// All that depends on the position of an axis, or on position and side: rows x columns.
Eigen::MatrixXd functions_of_place(const Prepared& p, Axis axis, bool by_side) {
    const std::vector<double> places = places_in_turn(p, axis);
    // With a place for every two readings half of what they tell is left to time.
    const std::vector<double> knots =
        estimation::knots_of(places, std::min(most_places, places.size() / 2));
    if (knots.size() < 2) return {};
    const auto count = static_cast<Eigen::Index>(knots.size());
    const bool sides =
        by_side && 4 * knots.size() <= places.size() && repeats_both_sides(p, axis, places, knots);
    Eigen::MatrixXd hats =
        Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(places.size()), sides ? 2 * count : count);
    for (std::size_t i = 0; i < places.size(); ++i) {
        const auto [k, w] = estimation::place_between(knots, places[i]);
        const bool back = sides && p.replay.sample(i).travel[index_of(axis)] < 0;
        const Eigen::Index at = k + (back ? count : 0);
        hats(static_cast<Eigen::Index>(i), at) = 1.0 - w;
        hats(static_cast<Eigen::Index>(i), at + 1) = w;
    }
    return hats;
}

}  // namespace

Eigen::MatrixXd beside_places(const Prepared& prepared, const Whitener& whitener,
                              Eigen::MatrixXd white, bool by_side) {
    const std::optional<Axis> axis = measured_axis(prepared.replay, prepared.table);
    if (!axis || is_one_sweep(prepared.replay, prepared.table.axes)) return white;
    Eigen::MatrixXd hats = functions_of_place(prepared, *axis, by_side);
    if (hats.size() == 0) return white;
    whitener.apply(hats);
    return estimation::Projection(hats).beside(white);
}

}  // namespace trunnion::diagnosis
