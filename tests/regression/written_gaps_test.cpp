// Which written difference is named for a place in two programs.
#include "regression/written_gaps.h"

#include <catch2/catch.hpp>

#include "tests/support/campaign.h"

namespace trunnion {

TEST_CASE("of several changed blocks side by side, that of the place is named", "[regression]") {
    const setup::Setup setup = campaign::bc_setup();
    const interpreter::ProgramText a{"A", "O1\nG1 X1. F100.\nX2.\nX3.\nX9.\nM30\n", {}},
        b{"B", "O1\nG1 X1. F100.\nX2.1\nX3.2\nX9.\nM30\n", {}};
    regression::WrittenGaps gaps(a, setup, b, setup);
    const auto line = [&](int at_a, int at_b) {
        const auto cause = gaps.before(at_a, at_b);
        REQUIRE(cause);
        CHECK(cause->line_a == cause->line_b);
        return cause->line_a;
    };
    CHECK(line(3, 3) == 3);
    CHECK(line(4, 4) == 4);
    CHECK(line(5, 5) == 3);  // behind the gap: its first difference
    CHECK_FALSE(gaps.before(2, 2));
    CHECK(gaps.at(4, 0)->line_b == 4);
    CHECK(gaps.at(0, 3)->line_a == 3);
    CHECK_FALSE(gaps.at(5, 0));
}

}  // namespace trunnion
