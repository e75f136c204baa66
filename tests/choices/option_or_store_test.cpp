// An option beside a stale store, where another store would do what the option does.
#include "tests/choices/sampled_log.h"

namespace trunnion {

using choices::GapCause;
using log_bench::gap_of;
using log_bench::log_of;
using log_bench::mill_of;

namespace {

const std::string contour = R"(N10 G90 G21 G17 G40 G49 G80 G54
N20 G43 H1 Z50.
N30 G0 X0. Y0.
N40 G1 Z2. F500.
N50 G41 D1 X20. Y20.
N60 Y60.
N70 X70. Y75.
N80 X90. Y40.
N90 X55. Y10.
N100 X20. Y20.
N110 G40 X0. Y0.
N120 G0 Z40.
N130 X30. Y30.
N140 Z20.
N150 M30
)";

setup::Setup mill(double length, const char* diameters) {
    return mill_of("tools.1 = { length_mm = " + std::to_string(length) +
                   ", diameter_mm = 1.2 }\nparameters.5004 = \"" + diameters + "\"\n");
}

}  // namespace

TEST_CASE(
    "an option and a store that explain the same rows are rivals beside another stale store") {
    const auto gap =
        gap_of(mill(150.0, "00000000"), log_of(mill(159.5, "00000100"), contour), contour);
    bool option = false;
    for (const GapCause& cause : gap.causes) {
        INFO(cause.name << " " << cause.probability);
        const bool radius = cause.name == "D1" || cause.name == "5004#2=1";
        option =
            option || cause.name == "5004#2=1" ||
            std::find(cause.rivals.begin(), cause.rivals.end(), "5004#2=1") != cause.rivals.end();
        CHECK((!radius || cause.probability < 0.7));
    }
    CHECK(option);
}

}  // namespace trunnion
