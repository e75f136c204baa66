// diagnose --program: an exact cause reaches the noise, and what is beside it is told.
#include "tests/cli/control_gap_bench.h"

using namespace trunnion::control_gap_bench;  // NOLINT(google-build-using-namespace)

namespace {

const std::string pocket = R"(N10 G90 G21 G17 G54
N20 G0 X-30. Y-30.
N30 G43 H1 Z25.
N40 G1 Z-2. F400.
N50 X30.
N60 Y-24.
N70 G3 X20. Y20. R60.
N80 G1 X-10.
N90 G2 X-30. Y0. R20.
N100 G1 X-30. Y-30.
N110 X-18. Y-2.
N120 G0 Z25.
N130 M30
)";

/// The log of another program on another control.
Json judged(const Bench& bench, const std::string& program, const std::string& logged,
            const Control& there = {}) {
    bench.write("here.toml", Control{}.text());
    bench.write("there.toml", there.text());
    bench.write("part.nc", program);
    bench.write("other.nc", logged);
    REQUIRE(bench.trunnion("run " + bench.file("other.nc") + " --setup " +
                           bench.file("there.toml") + " --trace-step 0.5 --trace " +
                           bench.file("log.csv")) == 0);
    return bench.asked();
}

std::string edited(const std::string& old, const std::string& now) {
    std::string out = pocket;
    out.replace(out.find(old), old.size(), now);
    return out;
}

const Json& cause_named(const Json& result, const std::string& name) {
    for (const Json& cause : result["causes"])
        if (cause["effect"] == name) return cause;
    FAIL("no " << name);
    return result;
}

}  // namespace

TEST_CASE("diagnose --program: a foreign block does not take a true store away") {
    const Bench bench;
    Control there;
    there.g54 = "X = 15.0, Y = -17.0, Z = 5.0";
    const Json result = judged(bench, pocket, edited("N50 X30.", "N50 X30.2"), there);
    INFO(result.dump(1));
    CHECK(result["verdict"] == "partly-explained");
    const Json& g54 = cause_named(result, "G54");
    CHECK(g54["probability"].get<double>() > 0.4);  // the external offset does the same
    CHECK(value(g54, "G54.X") == Approx(15.0).margin(1e-4));
    CHECK(value(g54, "G54.Y") == Approx(-17.0).margin(1e-4));
    cause_named(result, "unknown");
    for (const Json& cause : result["causes"])
        if (cause["effect"] != "G54" && cause["effect"] != "unknown")
            CHECK(cause["probability"].get<double>() < 0.5);
}

TEST_CASE("diagnose --program: a depth that was edited is no store, as the clearance tells") {
    const Bench bench;
    const Json result = judged(bench, pocket, edited("N40 G1 Z-2.", "N40 G1 Z-2.5"));
    INFO(result.dump(1));
    const bool left = result["verdict"] == "unexplained" || result["verdict"] == "partly-explained";
    CHECK(left);
    cause_named(result, "unknown");
}

TEST_CASE("diagnose --program: a rule that leaves a hundredth is not the rule of the log") {
    // The other control counts a number without a point in hundredths of a millimetre.
    const std::string program = R"(N10 G21 G90 G17 G54
N20 G0 X10 Y10.
N30 Z30.
N40 G1 Z-2. F400
N50 X42.5
N60 Y25
N70 X7.5 Y31.
N80 Z-4
N90 X-20.
N100 M30
)";
    std::string centi = program;
    for (const auto& [old, now] :
         {std::pair{"X10 Y", "X0.1 Y"}, std::pair{"Y25", "Y0.25"}, std::pair{"Z-4", "Z-0.04"}})
        centi.replace(centi.find(old), std::string(old).size(), now);
    const Bench bench;
    const Json result = judged(bench, program, centi);
    INFO(result.dump(1));
    CHECK(result["verdict"] != "explained");
    CHECK(result["verdict"] != "ambiguous");
    for (const Json& cause : result["causes"])
        if (cause["effect"] == "3401#0=0") CHECK(cause["probability"].get<double>() < 0.5);
}
