// What is no number never becomes a Finite: not by a cell, a key, an operation or a comparison.
#include "base/finite.h"

#include <catch2/catch.hpp>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/alarm.h"
#include "base/numbers.h"

using namespace trunnion;

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

}  // namespace

TEST_CASE("a Finite takes finite numbers alone, and a comparison never meets NaN") {
    for (const double wrong : {not_a_number, infinite, -infinite, 1e200 * 1e200}) {
        CHECK_THROWS_AS(Finite(wrong), InputError);
        CHECK_THROWS_AS(shortest(wrong), InputError);
        CHECK_THROWS_AS(shortest_degrees(wrong), InputError);
        Finite kept = 1.5;
        CHECK_THROWS_AS(kept = wrong, InputError);
        CHECK(kept == 1.5);
    }
    const Finite largest = std::numeric_limits<double>::max();
    CHECK_THROWS_AS(Finite(2.0 * largest), InputError);
    CHECK_THROWS_AS(Finite(largest * largest - largest * largest), InputError);
    CHECK(Finite(2.0) > Finite(1.0));
    CHECK(Finite() == 0.0);
}

TEST_CASE("a Finite prints as the number that it is") {
    CHECK(fmt::format("{:.2f} {}", Finite(0.125), Finite(-3.0)) == "0.12 -3");
    CHECK(nlohmann::ordered_json{{"a", Finite(0.1)}}.dump() == "{\"a\":0.1}");
    CHECK(shortest(Finite(-0.0)) == "0");
}
