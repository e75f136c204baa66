// diagnose --program: a log that this program wrote under another setup, judged through the file.
#include "tests/cli/control_gap_bench.h"

using namespace trunnion::control_gap_bench;  // NOLINT(google-build-using-namespace)

TEST_CASE("diagnose --program: the log of the same control is no gap") {
    const Bench bench;
    for (const std::string& program : {mill, five_axis})
        for (const char* samples : {"", " --trace-step 0.5"}) {
            const Json result = bench.asked(program, {}, {}, samples);
            CHECK(result["schema"] == "trunnion.diagnosis/1");
            CHECK(result["verdict"] == "no-gap");
            CHECK(result["causes"].empty());
            CHECK(result["gap"]["rms_um"].get<double>() < 0.2);
        }
}

TEST_CASE("diagnose --program: one choice of the other control is named, from ends and samples") {
    struct Case {
        std::string name, program;
        Control here, there;
    };
    Control metric, bare, shift, frame, type_b, no_length, radius;
    bare.parameters = "3401 = \"00000000\"\n";
    shift.parameters += "5006 = \"01000000\"\n";
    frame.keys = "tcp_frame = \"rotary_zero\"\n";
    const std::vector<Case> cases{{"3401#0=0", mill, metric, bare},
                                  {"3401#0=1", mill, bare, metric},
                                  {"5006#6=1", lengths, metric, shift},
                                  {"tcp_frame=rotary_zero", five_axis, metric, frame},
                                  {"tcp_frame=start", five_axis, frame, metric}};
    const Bench bench;
    for (const Case& c : cases)
        for (const char* samples : {"", " --trace-step 0.5"}) {
            INFO(c.name << samples);
            const Json result = bench.asked(c.program, c.here, c.there, samples);
            INFO(result.dump(1));
            CHECK((result["verdict"] == "explained" || result["verdict"] == "ambiguous"));
            CHECK(cause(result)["effect"] == c.name);
            CHECK(result["after"]["rms_um"].get<double>() < 0.2);
        }
}

TEST_CASE("diagnose --program: a stale store is named with its value") {
    const Bench bench;
    Control g54, h1, peck;
    g54.g54 = "X = 10.025, Y = -20.0, Z = 4.99";
    h1.h1 = "150.012";
    peck.parameters += "5114 = 0.3\n";
    for (const char* samples : {"", " --trace-step 0.5"}) {
        INFO(samples);
        Json result = bench.asked(mill, {}, g54, samples);
        INFO(result.dump(1));
        CHECK(cause(result)["effect"] == "G54");
        CHECK(value(cause(result), "G54.X") == Approx(10.025).margin(2e-4));
        CHECK(value(cause(result), "G54.Z") == Approx(4.99).margin(2e-4));
        CHECK(cause(result)["parameters"].size() == 2);
        result = bench.asked(mill, {}, h1, samples);
        CHECK(cause(result)["effect"] == "H1");
        CHECK(value(cause(result), "H1") == Approx(150.012).margin(2e-4));
    }
    const Json result = bench.asked(mill, {}, peck);
    CHECK(cause(result)["effect"] == "5114");
    CHECK(value(cause(result), "5114") == Approx(0.3).margin(2e-4));
    CHECK(cause(result)["first"]["line"] == 11);
}

TEST_CASE("diagnose --program: two causes beside each other, and the setup that has them") {
    const Bench bench;
    Control there;
    there.keys = "tcp_frame = \"rotary_zero\"\n";
    there.g54 = "X = 10.03, Y = -20.0, Z = 5.0";
    const Json result = bench.asked(five_axis, {}, there, " --trace-step 1");
    INFO(result.dump(1));
    REQUIRE(result["causes"].size() == 2);
    CHECK(result["causes"][0]["effect"] == "tcp_frame=rotary_zero");
    CHECK(result["causes"][1]["effect"] == "G54");
    CHECK(result["causes"][1]["rivals"][0] == "external");
    CHECK(result["verdict"] == "ambiguous");
    REQUIRE(bench.trunnion("diagnose " + bench.file("log.csv") + " --program " +
                           bench.file("part.nc") + " --setup " + bench.file("here.toml") +
                           " --out " + bench.file("learned.toml") + " --html " +
                           bench.file("gap.html")) == 0);
    CHECK_THAT(bench.read("gap.html"), Catch::Contains("tcp_frame=rotary_zero"));
    REQUIRE(bench.trunnion("diagnose " + bench.file("log.csv") + " --program " +
                           bench.file("part.nc") + " --setup " + bench.file("learned.toml")) == 0);
    CHECK_THAT(bench.read("out.txt"), Catch::Contains("verdict: no-gap"));
}

TEST_CASE("diagnose --program: another generation and Hurco's dialect, where this control stops") {
    const Bench bench;
    Control hurco;
    hurco.keys = "dialect = \"hurco\"\n";
    const std::string cycles =
        "N10 G90 G21 G17 G54\nN20 T1 M6\nN30 G0 X5. Y5.\nN40 G43 H1 Z60.\nN50 X40. Y12.\n"
        "N60 G1 Z10. F400.\nN70 M140 L20.\nN80 G0 X10. Y50.\nN90 G49\nN100 X0. Y3.\nM30\n";
    const Json result = bench.asked(cycles, {}, hurco, " --trace-step 0.5");
    INFO(result.dump(1));
    CHECK(result["causes"][0]["effect"] == "dialect=hurco");
    CHECK(result["after"]["explained"].get<double>() > 0.99);
    Control old;
    old.keys = "generation = \"16i\"\n";
    CHECK(bench.asked(mill, {}, old)["verdict"] == "no-gap");  // they read this program alike
}

TEST_CASE("diagnose --program: a control that only went on where this one stops is not known") {
    const Bench bench;
    Control hurco;
    hurco.keys = "dialect = \"hurco\"\n";
    const std::string feeds =
        "N10 G90 G21 G17 G54\nN20 G1 X5. F400.\nN30 Y5.\nN40 Z60.\nN50 G4 P0.5\n"
        "N60 G1 X10. Y50.\nN70 X0. Y3.\nN80 X20. Y9.\nM30\n";
    const Json result = bench.asked(feeds, {}, hurco, " --trace-step 0.5");
    INFO(result.dump(1));
    CHECK(result["verdict"] == "ambiguous");
    REQUIRE(!result["causes"].empty());
    CHECK(result["causes"][0]["probability"].get<double>() < 0.7);
    REQUIRE(!result["causes"][0]["rivals"].empty());
    CHECK(result["causes"][0]["rivals"].back() == "another meaning of the block that stops");
}

TEST_CASE("diagnose --program: noise of the log stays noise, and hides nothing larger") {
    const Bench bench;
    Control g54;
    g54.g54 = "X = 10.02, Y = -20.0, Z = 5.0";
    for (const bool stale : {false, true}) {
        bench.asked(mill, {}, stale ? g54 : Control{}, " --trace-step 1");
        std::istringstream lines(bench.read("log.csv"));
        std::string line, noisy = "line,x_mm,y_mm,z_mm\n";
        unsigned seed = 7;
        const auto noise = [&seed] {
            seed = seed * 1664525U + 1013904223U;
            return 0.004 * (static_cast<double>(seed >> 8U) / 16777216.0 - 0.5);
        };
        std::getline(lines, line);
        while (std::getline(lines, line)) {
            std::vector<std::string> cell;
            std::istringstream cells(line);
            for (std::string text; std::getline(cells, text, ',');) cell.push_back(text);
            noisy += cell[2];
            for (const std::size_t k : {6U, 7U, 8U})
                noisy += ',' + std::to_string(std::stod(cell[k]) + noise());
            noisy += '\n';
        }
        bench.write("log.csv", noisy);
        const Json result = bench.asked();
        INFO(result.dump(1));
        CHECK(result["noise_source"] == "repeats");
        if (!stale) CHECK(result["verdict"] == "no-gap");
        if (stale) CHECK(value(cause(result), "G54.X") == Approx(10.02).margin(5e-4));
    }
}

TEST_CASE("diagnose --program: what no table has stays unexplained") {
    const Bench bench;
    bench.write("here.toml", Control{}.text());
    bench.write("part.nc", mill);
    bench.write("there.toml", Control{}.text());
    std::string other = mill;
    other.replace(other.find("X40. Y10.\nN70"), 9, "X41. Y10.");
    other.replace(other.find("R3. Q5."), 7, "R3. Q7.");
    bench.write("other.nc", other);
    REQUIRE(bench.trunnion("run " + bench.file("other.nc") + " --setup " +
                           bench.file("there.toml") + " --trace " + bench.file("log.csv")) == 0);
    const Json result = bench.asked();
    INFO(result.dump(1));
    CHECK(result["verdict"] == "unexplained");
    CHECK(result["causes"].back()["effect"] == "unknown");
    for (const Json& claim : result["causes"])
        if (claim["effect"] != "unknown") CHECK(claim["probability"].get<double>() < 0.5);
    CHECK(result["gap"]["first"]["line"] == 6);
}

TEST_CASE("diagnose --program refuses with one message and writes nothing") {
    const Bench bench;
    bench.asked(mill, {}, {});
    struct Case {
        std::string log, words, message;
    };
    const std::string head = "line,motion,x_mm,y_mm,z_mm\n";
    const std::vector<Case> cases{
        {"line,motion\n3,G0\n", "", "log.csv:1:1: error: no column tells the position"},
        {"line,motion,x_mm,a_deg\n3,G0,1,2\n", "", "the machine's axes are"},
        {head, "", "log.csv"},
        {head + "3,G0,1,2\n", "", "log.csv:2"},
        {head + "3,G0,1,2,abc\n", "", "log.csv:2:"},
        {head + "3.5,G0,1,2,3\n", "", "log.csv:2:1: error: a block is a whole number"},
        {head + "812,G0,1,2,3\n", "", "log.csv:2: error: block 812: part.nc has 20 lines"},
        {head + "3,G0,1,2,3\n", " --holdout " + bench.file("log.csv"), "--program takes one log"},
    };
    for (const Case& c : cases) {
        bench.write("log.csv", c.log);
        CHECK(bench.trunnion("diagnose " + bench.file("log.csv") + " --program " +
                             bench.file("part.nc") + " --setup " + bench.file("here.toml") +
                             " --out " + bench.file("new.toml") + c.words) == 2);
        INFO(bench.read("err.txt"));
        CHECK_THAT(bench.read("err.txt"), Catch::Contains(c.message));
        CHECK(bench.read("out.txt").empty());
        CHECK_FALSE(std::filesystem::exists(bench.path / "new.toml"));
    }
    CHECK(bench.trunnion("diagnose " + bench.file("log.csv") + " --program " +
                         bench.file("part.nc")) == 2);
    CHECK_THAT(bench.read("err.txt"), Catch::Contains("--setup is missing"));
}
