// diagnose --program: what must not be claimed, and what two stores do together.
#include "tests/cli/control_gap_bench.h"

using namespace trunnion::control_gap_bench;  // NOLINT(google-build-using-namespace)

TEST_CASE("diagnose --program: two stale stores are named, not two others that look alike") {
    struct Case {
        const char *g54, *h1;
    };
    const std::string tools = R"(N10 G90 G21 G54
N20 G0 X5. Y6. Z30.
N30 G43 H1 Z30.
N40 X20. Y10.
N50 G1 Z2. F300.
N60 X30.
N70 G0 Z30.
N80 G55 X10. Y10.
N90 G1 Z1.
N100 Y20.
N110 G54 X15. Y25. Z3.
N120 G49 G0 Z60.
N130 X0. Y0.
N140 M30
)";
    const Bench bench;
    for (const Case& c : {Case{"X = 10.3, Y = -20.0, Z = 5.0", "150.1"},
                          Case{"X = 10.0, Y = -20.0, Z = 5.3", "149.9"},
                          Case{"X = 10.0, Y = -20.05, Z = 5.0", "150.7"}}) {
        Control there;
        there.g54 = c.g54;
        there.h1 = c.h1;
        for (const char* samples : {"", " --trace-step 0.5"}) {
            INFO(c.g54 << ' ' << c.h1 << samples);
            const Json result = bench.asked(tools, {}, there, samples);
            INFO(result.dump(1));
            REQUIRE(result["causes"].size() == 2);
            const Json &a = result["causes"][0], &b = result["causes"][1];
            const Json &h1 = a["effect"] == "H1" ? a : b, &g54 = a["effect"] == "H1" ? b : a;
            CHECK(h1["effect"] == "H1");
            CHECK(value(h1, "H1") == Approx(std::stod(c.h1)).margin(2e-4));
            CHECK(g54["effect"] == "G54");
            CHECK(g54["parameters"].size() == 1);
            CHECK(result["after"]["rms_um"].get<double>() < 0.3);
        }
    }
}

TEST_CASE("diagnose --program: an edited program is not explained by a store that leaves a gap") {
    const Bench bench;
    bench.write("here.toml", Control{}.text());
    bench.write("part.nc", mill);
    struct Edit {
        const char *old, *now;
    };
    for (const Edit& edit :
         {Edit{"N60 X40. Y10.", "N60 X40. Y10.5"}, Edit{"N50 G1 Z2.", "N50 G1 Z1.5"},
          Edit{"Z-12. R3. Q5.", "Z-12.3 R3. Q5."}, Edit{"N170 G91 G1 X-5.", "N170 G91 G1 X5."}}) {
        INFO(edit.now);
        std::string other = mill;
        other.replace(other.find(edit.old), std::string(edit.old).size(), edit.now);
        bench.write("other.nc", other);
        REQUIRE(bench.trunnion("run " + bench.file("other.nc") + " --setup " +
                               bench.file("here.toml") + " --trace-step 0.5 --trace " +
                               bench.file("log.csv")) == 0);
        const Json result = bench.asked();
        INFO(result.dump(1));
        CHECK(result["verdict"] == "unexplained");
        for (const Json& claim : result["causes"])
            if (claim["effect"] != "unknown") CHECK(claim["probability"].get<double>() < 0.5);
    }
}

TEST_CASE("diagnose --program: positions in inches are no dialect") {
    const Bench bench;
    bench.asked(mill, {}, {}, " --trace-step 1");
    std::istringstream lines(bench.read("log.csv"));
    std::string line, inches = "line,x_mm,y_mm,z_mm\n";
    std::getline(lines, line);
    while (std::getline(lines, line)) {
        std::vector<std::string> cell;
        std::istringstream cells(line);
        for (std::string text; std::getline(cells, text, ',');) cell.push_back(text);
        inches += cell[2];
        for (const std::size_t k : {6U, 7U, 8U})
            inches += ',' + std::to_string(std::stod(cell[k]) / 25.4);
        inches += '\n';
    }
    bench.write("log.csv", inches);
    const Json result = bench.asked();
    INFO(result.dump(1));
    CHECK(result["verdict"] == "unexplained");
    CHECK_THAT(bench.read("err.txt"), Catch::Contains("agrees if its lengths are inches"));
}

TEST_CASE("diagnose --program: a coarse log hides neither a gap nor invents one") {
    // Every 40th of the dense samples: several moves between two rows.
    const Bench bench;
    Control deep;
    deep.g54 = "X = 10.0, Y = -20.0, Z = 8.0";
    for (const bool stale : {false, true}) {
        bench.asked(mill, {}, stale ? deep : Control{}, " --trace-step 0.5");
        std::istringstream lines(bench.read("log.csv"));
        std::string line, coarse = "line,x_mm,y_mm,z_mm\n";
        std::getline(lines, line);
        for (int row = 0; std::getline(lines, line); ++row) {
            if (row % 40 != 0) continue;
            std::vector<std::string> cell;
            std::istringstream cells(line);
            for (std::string text; std::getline(cells, text, ',');) cell.push_back(text);
            coarse += cell[2] + ',' + cell[6] + ',' + cell[7] + ',' + cell[8] + '\n';
        }
        bench.write("log.csv", coarse);
        const Json result = bench.asked();
        INFO(result.dump(1));
        CHECK((result["verdict"] == "no-gap") == !stale);
        if (stale) CHECK(result["causes"][0]["effect"] == "G54");
    }
}
