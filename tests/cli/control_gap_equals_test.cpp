// diagnose --program: causes that a log cannot tell apart share the probability and are named.
#include "tests/cli/control_gap_bench.h"

using namespace trunnion::control_gap_bench;  // NOLINT(google-build-using-namespace)

namespace {

const std::string two_tools = R"(N10 G90 G21 G17 G54
N20 G0 X-30. Y-30.
N30 G43 H1 Z25.
N40 G1 Z-2. F400.
N50 X30.
N60 Y10.
N70 G3 X20. Y20. I-10. J0.
N80 G0 Z25.
N90 G91 G28 Z0.
N100 G90 G55 X5. Y7.
N110 G43 H2 Z20.
N120 G1 Z-3.5 F300.
N130 X25. Y15.
N140 G0 Z40.
N150 G91 G28 Z0.
N160 M30
)";

std::string mill_with(const std::string& h1, const std::string& h2, const std::string& d1) {
    return "[machine]\nname = \"k\"\nchain = \"w b X Y Z t\"\n[control.work_offsets]\n"
           "G54 = { X = -100.0, Y = 20.0, Z = -250.0 }\n"
           "G55 = { X = -60.0, Y = 35.0, Z = -240.0 }\n[control.tools]\n1 = { length_mm = " +
           h1 + ", diameter_mm = " + d1 + " }\n2 = { length_mm = " + h2 +
           ", diameter_mm = 6.0 }\n[control.parameters]\n3401 = \"00000001\"\n5001 = "
           "\"00000000\"\n";
}

/// A log under one setup, judged with another.
Json judged(const Bench& bench, const std::string& program, const std::string& here,
            const std::string& there) {
    bench.write("here.toml", here);
    bench.write("there.toml", there);
    bench.write("part.nc", program);
    REQUIRE(bench.trunnion("run " + bench.file("part.nc") + " --setup " + bench.file("there.toml") +
                           " --trace-step 0.5 --trace " + bench.file("log.csv")) == 0);
    return bench.asked();
}

/// The cause or one of its rivals.
std::set<std::string> named(const Json& cause) {
    std::set<std::string> out{cause["effect"]};
    for (const Json& rival : cause["rivals"]) out.insert(rival.get<std::string>());
    return out;
}

}  // namespace

TEST_CASE("diagnose --program: a store that explains as much stays a rival of any size") {
    const Bench bench;
    const std::string here = mill_with("85.5", "62.25", "6.0");
    for (const char* h1 : {"86.0", "97.5", "105.5", "0.0", "285.5"}) {
        INFO(h1);
        const Json result = judged(bench, two_tools, here, mill_with(h1, "62.25", "6.0"));
        INFO(result.dump(1));
        REQUIRE(result["causes"].size() == 1);
        CHECK(result["verdict"] == "ambiguous");
        CHECK(result["causes"][0]["probability"].get<double>() < 0.51);
        CHECK(named(result["causes"][0]).contains("G54"));
        CHECK(named(result["causes"][0]).contains("H1"));
    }
}

TEST_CASE("diagnose --program: two exchanged lengths are rivals of two work offsets") {
    const Bench bench;
    for (const auto& [h1, h2] : {std::pair{"62.25", "85.5"}, std::pair{"0.0", "0.0"}}) {
        INFO(h1 << ' ' << h2);
        const Json result =
            judged(bench, two_tools, mill_with("85.5", "62.25", "6.0"), mill_with(h1, h2, "6.0"));
        INFO(result.dump(1));
        CHECK(result["verdict"] == "ambiguous");
        REQUIRE(result["causes"].size() == 2);
        std::set<std::string> all;
        for (const Json& cause : result["causes"]) {
            CHECK(cause["probability"].get<double>() < 0.51);
            all.merge(named(cause));
        }
        for (const char* store : {"G54", "G55", "H1", "H2"}) CHECK(all.contains(store));
    }
}

TEST_CASE("diagnose --program: a store has no smaller share than an option for its number") {
    const std::string contour = R"(N10 G21 G90 G17 G40 G54
N20 G0 X-20. Y-20.
N30 G43 H1 Z30.
N40 G1 Z-2. F300.
N50 G41 D1 G1 X0. Y-10.
N60 Y20.
N70 X30.
N80 Y-5.
N90 X-10.
N100 G40 X-20. Y-20.
N110 G0 Z30.
N120 M30
)";
    const Bench bench;
    const std::string here = mill_with("85.5", "62.25", "6.0");
    std::string there = here;
    there += "5004 = \"00000100\"\n";  // D holds diameters: half the radius
    const Json result = judged(bench, contour, here, there);
    INFO(result.dump(1));
    CHECK(result["verdict"] == "ambiguous");
    REQUIRE(result["causes"].size() == 1);
    CHECK(named(result["causes"][0]) == std::set<std::string>{"5004#2=1", "D1"});
    // Both have the same share, and together less than 1: it may be none of them.
    const auto blocks = result["causes"][0]["blocks"].get<double>();
    CHECK(result["causes"][0]["probability"].get<double>() ==
          Approx(0.5 * (blocks + 1.0) / (blocks + 2.0)).margin(0.01));
}

TEST_CASE("diagnose --program: a cause is no surer than the one without which it does nothing") {
    const std::string drill = R"(N10 G21 G90 G17 G40 G49 G80 G94 G54
N20 G0 X5. Y6. Z30.
N30 G98 G81 X10. Y10. Z-9. R3. F200
N40 X25. Y12.
N50 G82 X28. Y3. Z-7. R2. P0.5
N60 G80
N70 G99 G85 X30. Y-5. Z-8. R3.
N80 X33. Y-9.
N90 G98 G89 X1. Y-2. Z-4. R2. P0.1
N100 G80
N110 G91 G81 X4. Y3. Z-6. R-10.
N120 X3.
N130 G80
N140 G90 G0 Z33.
N150 X0. Y0.
N160 M2
)";
    const auto control = [](const std::string& keys) {
        return "[machine]\nname = \"k\"\nchain = \"w b X Y Z t\"\n[control]\n" + keys +
               "[control.work_offsets]\nG54 = { X = -12.5, Y = 8.0, Z = -3.25 }\n"
               "[control.parameters]\n3401 = \"00000001\"\n";
    };
    const Bench bench;
    const Json result =
        judged(bench, drill, control("dialect = \"fanuc\"\n"),
               control("dialect = \"hurco\"\n[control.hurco]\nrapids_are_interpolated = true\n"));
    INFO(result.dump(1));
    REQUIRE(result["causes"].size() == 2);
    double dialect = 0.0, other = 1.0;
    for (const Json& cause : result["causes"])
        (cause["effect"] == "dialect=hurco" ? dialect : other) = cause["probability"];
    CHECK(dialect > 0.5);
    CHECK(other <= dialect);
}
