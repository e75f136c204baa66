#include "base/budget.h"

#include <catch2/catch.hpp>

using namespace trunnion;

TEST_CASE("a budget ends the work by the first limit reached, and without limits never") {
    BudgetMeter free(Budget{});
    CHECK(free.allows({1'000'000'000, 1'000'000'000, 1'000'000'000}));
    Budget budget;
    budget.blocks = 10;
    budget.printed_bytes = 100;
    budget.rows = 5;
    BudgetMeter meter(budget);
    CHECK(meter.allows({9, 99, 4}));
    CHECK(meter.reached() == BudgetLimit::none);
    CHECK_FALSE(meter.allows({9, 100, 4}));
    CHECK(std::string(name_of(meter.reached())) == "printed_bytes");
    CHECK_FALSE(meter.allows({9, 99, 5}));
    CHECK(meter.reached() == BudgetLimit::rows);
    CHECK_FALSE(meter.allows({10, 0, 0}));
    CHECK(meter.reached() == BudgetLimit::blocks);
}

TEST_CASE("time and an interruption end the work") {
    Budget budget;
    budget.time_s = 1e-9;
    BudgetMeter late(budget);
    CHECK_FALSE(late.allows({}));
    CHECK(late.reached() == BudgetLimit::time);
    Budget stopped;
    stopped.interrupted = [] { return true; };
    BudgetMeter meter(stopped);
    CHECK_FALSE(meter.allows({}));
    CHECK(meter.reached() == BudgetLimit::interruption);
}
