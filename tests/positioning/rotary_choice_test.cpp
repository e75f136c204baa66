// G53.1: which of the two solutions, and at which turn.
#include "positioning/rotary_choice.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "base/units.h"
#include "tests/support/tables.h"

namespace trunnion {

namespace {

constexpr double deg = pi / 180.0;

}  // namespace

TEST_CASE("G53.1 takes the least move of the master, then of the slave, then nearest 0") {
    const positioning::RotaryTransform belief(bc_table());
    AxisPositions q;
    q[Axis::B] = 30 * deg;
    q[Axis::C] = 50 * deg;
    const Vector3 n = belief.tool_direction_W(q);
    const auto chosen = [&](positioning::RotarySolution present,
                            positioning::RotaryTravel travel = {},
                            positioning::Branch branch = positioning::Branch::nearest) {
        const auto choice = positioning::choose_rotaries(belief, n, present, travel, branch);
        return choice.chosen.value_or(positioning::RotarySolution{99, 99});
    };
    const auto is = [](const positioning::RotarySolution& s, double b, double c) {
        return std::abs(s.first_rad - b * deg) < 1e-12 && std::abs(s.second_rad - c * deg) < 1e-11;
    };
    CHECK(is(chosen({0, 0}), 30, 50));                 // equal B, less C
    CHECK(is(chosen({0, -100 * deg}), -30, -130));     // equal B, less C
    CHECK(is(chosen({1 * deg, -100 * deg}), 30, 50));  // less B wins over less C
    CHECK(is(chosen({0, 0}, {}, positioning::Branch::negative), -30, -130));
    CHECK(is(chosen({-20 * deg, 0}, {}, positioning::Branch::positive), 30, 50));
    CHECK(is(chosen({0, 5000 * deg}), 30, 5090));  // nearest turn of C
    // Of two that are equal in everything the first one.
    q[Axis::C] = 90 * deg;
    const auto level = positioning::choose_rotaries(belief, belief.tool_direction_W(q), {0, 0}, {},
                                                    positioning::Branch::nearest);
    REQUIRE(level.all.size() == 2);
    REQUIRE(level.chosen);
    CHECK(*level.chosen == level.all.front());
    positioning::RotaryTravel narrow;
    narrow.first = {-5 * deg, 110 * deg};
    CHECK(is(chosen({-4 * deg, -130 * deg}, narrow), 30, 50));
    narrow.second = {60 * deg, 400 * deg};
    CHECK(is(chosen({0, 70 * deg}, narrow), 30, 410) == false);
    narrow.second = {60 * deg, 420 * deg};
    CHECK(is(chosen({0, 70 * deg}, narrow), 30, 410));  // rewound inside the travel
    narrow.first = {0.0, 20 * deg};
    CHECK(is(chosen({0, 0}, narrow), 99 / deg, 99 / deg));
    CHECK(positioning::choose_rotaries(belief, n, {0, 0}, {}).all.size() == 2);
}

TEST_CASE("a rotary that already stands right is not stirred, at any number of turns") {
    const positioning::RotaryTransform belief(bc_table());
    positioning::RotarySolution stands{-33.3 * deg, -145318.181 * deg};
    const auto n = belief.tool_direction_W(belief.with_rotaries({}, stands));
    const auto choice = positioning::choose_rotaries(belief, n, stands, {});
    REQUIRE(choice.chosen);
    CHECK(choice.chosen->first_rad == Approx(stands.first_rad).margin(1e-12));
    CHECK(std::abs(deg_from_rad(choice.chosen->second_rad) + 145318.181) < 1e-9);
}

TEST_CASE("an axis takes the turn nearest to where it stands that its travel allows") {
    const auto turn = [](double angle_deg, double present_deg, std::optional<double> min_deg,
                         std::optional<double> max_deg) -> std::optional<double> {
        positioning::RotaryTravel::Range range;
        if (min_deg) range.min_rad = rad_from_deg(*min_deg);
        if (max_deg) range.max_rad = rad_from_deg(*max_deg);
        const auto found_rad =
            positioning::nearest_turn(rad_from_deg(angle_deg), rad_from_deg(present_deg), range);
        if (!found_rad) return std::nullopt;
        return deg_from_rad(*found_rad);
    };
    const std::optional<double> none;
    CHECK(*turn(30, 400, none, none) == Approx(390));
    CHECK(*turn(30, -400, none, none) == Approx(-330));
    CHECK(*turn(30, 400, none, 360) == Approx(30));
    CHECK(*turn(30, 1000, none, 800) == Approx(750));
    CHECK(*turn(30, 1000, none, 740) == Approx(390));
    CHECK(*turn(-30, -400, -360, none) == Approx(-30));
    CHECK(*turn(-30, -1000, -740, none) == Approx(-390));
    CHECK(*turn(30, 400, none, 390) == Approx(390));  // at the limit
    CHECK(*turn(-30, -400, -390, none) == Approx(-390));
    CHECK_FALSE(turn(30, 0, 40, 380));  // no turn is inside
    CHECK_FALSE(turn(-30, 0, -20, 320));
}

}  // namespace trunnion
