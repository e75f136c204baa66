#include "positioning/rotary_choice.h"

#include <array>
#include <cmath>

#include "base/units.h"

namespace trunnion::positioning {

namespace {

constexpr double same_rad = 1e-9;  ///< differences below this count as equal
constexpr double turn_rad = 2.0 * pi;

/// The criteria in order of priority; smaller is better.
using Merit = std::array<double, 4>;

double from_zero(double angle_rad) {
    return std::abs(std::remainder(angle_rad, turn_rad));
}

Merit merit_of(const RotarySolution& s, const RotarySolution& present, bool second_leads) {
    const double first_move = std::abs(s.first_rad - present.first_rad);
    const double second_move = std::abs(s.second_rad - present.second_rad);
    if (second_leads)
        return {second_move, first_move, from_zero(s.second_rad), from_zero(s.first_rad)};
    return {first_move, second_move, from_zero(s.first_rad), from_zero(s.second_rad)};
}

bool better(const Merit& a, const Merit& b) {
    for (std::size_t i = 0; i < a.size(); ++i)
        if (std::abs(a[i] - b[i]) > same_rad) return a[i] < b[i];
    return false;
}

bool on_branch(const RotarySolution& s, bool first_tilts, Branch branch) {
    const double tilt = std::remainder(first_tilts ? s.first_rad : s.second_rad, turn_rad);
    switch (branch) {
        case Branch::positive: return tilt > -same_rad;
        case Branch::negative: return tilt < same_rad || tilt > pi - same_rad;
        default: return true;
    }
}

}  // namespace

std::optional<double> nearest_turn(double angle_rad, double present_rad,
                                   const RotaryTravel::Range& range) {
    double turns = std::nearbyint((present_rad - angle_rad) / turn_rad);
    if (range.max_rad)
        turns = std::fmin(turns, std::floor((*range.max_rad + same_rad - angle_rad) / turn_rad));
    if (range.min_rad)
        turns = std::fmax(turns, std::ceil((*range.min_rad - same_rad - angle_rad) / turn_rad));
    const double found_rad = angle_rad + turns * turn_rad;
    if (range.max_rad && found_rad > *range.max_rad + same_rad) return std::nullopt;
    // Rounding must not move an axis that is already in position.
    return std::abs(found_rad - present_rad) < 1e-12 ? present_rad : found_rad;
}

RotaryChoice choose_rotaries(const RotaryTransform& transform, const Vector3& n_W,
                             const RotarySolution& present, const RotaryTravel& travel,
                             Branch branch) {
    RotaryChoice choice;
    const bool second_leads = transform.pivot().unit == offsets::MechanicalUnit::mixed;
    Merit best{};
    for (const RotarySolution& s : transform.orient(n_W, present)) {
        const auto first = nearest_turn(s.first_rad, present.first_rad, travel.first);
        const auto second = nearest_turn(s.second_rad, present.second_rad, travel.second);
        if (!first || !second) {
            choice.out_of_travel.push_back(s);
            continue;
        }
        const RotarySolution found{*first, *second};
        choice.all.push_back(found);
        if (!on_branch(found, transform.first_tilts(), branch)) continue;
        const Merit merit = merit_of(found, present, second_leads);
        if (choice.chosen && !better(merit, best)) continue;
        choice.chosen = found;
        best = merit;
    }
    return choice;
}

}  // namespace trunnion::positioning
