#include "base/screen.h"

#include <catch2/catch.hpp>

using namespace trunnion;

TEST_CASE("a terminal without UTF-8 gets units in ASCII") {
    const std::string text = "0.5 ± 0.1 µm at 90° – 3 µrad";
    CHECK(for_screen(text, {true, false}) == text);
    CHECK(for_screen(text, {false, false}) == "0.5 +- 0.1 um at 90 deg - 3 urad");
}

TEST_CASE("colour marks the words of errors, and only these") {
    CHECK(for_screen("a.nc:2:1: error: bad\nverdict: no_gap\n", {true, true}) ==
          "a.nc:2:1: \033[31merror:\033[0m bad\n\033[1mverdict:\033[0m no_gap\n");
    CHECK(for_screen("a.nc:2:1: error: bad\n", {true, false}) == "a.nc:2:1: error: bad\n");
}
