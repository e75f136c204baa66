// Endless programs end by a limit, exit code 4, and say which.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <vector>

#include "tests/cli/command_bench.h"

using Json = nlohmann::json;

namespace {

struct Bench : CommandBench {
    std::string endless = write("endless.nc", "O1\nN1 DPRNT[ABCDEFGHIJ]\nGOTO 1\nM30\n");
    std::string limit_of(const std::string& words) const {
        CHECK(trunnion(words + " --json") == 4);
        return Json::parse(read("out.txt"))["limit"];
    }
};

}  // namespace

TEST_CASE("an endless program ends by blocks, print-outs or time") {
    const Bench bench;
    CHECK(bench.limit_of("run " + bench.endless + " --max-blocks 1000") == "blocks");
    CHECK_THAT(bench.read("err.txt"), Catch::Contains("stopped after 1000 blocks (--max-blocks)"));
    CHECK(bench.limit_of("run " + bench.endless + " --max-print 50000") == "printed_bytes");
    CHECK(bench.limit_of("run " + bench.endless + " --max-seconds 0.2") == "time");
    CHECK(bench.limit_of("run " + bench.endless) == "printed_bytes");
}

TEST_CASE("each limit of a run ends it when it is reached, and not before") {
    const Bench bench;
    const std::string five =
        bench.write("five.nc", "O1\nG90 G21 G54\nG0 X1.\nG0 X2.\nG0 X3.\nM30\n");
    const std::string prints = bench.write("prints.nc",
                                           "O1\nN1 #100=#100+1\nDPRNT[ABCDEFGHIJ]\n"
                                           "IF[#100LT20000]GOTO 1\nM30\n");
    const std::string reads = "O8002 --programs " TRUNNION_SOURCE_DIR
                              "/programs/pivot --programs " TRUNNION_SOURCE_DIR
                              "/programs --readings " +
                              bench.file("r.csv");
    struct Case {
        std::string words, option;
        std::vector<int> enough, too_small;
    };
    // Bytes and readings are looked at every few thousand blocks.
    for (const Case& c : {Case{five, "--max-blocks", {7, 8, 0}, {1, 3, 4}},
                          Case{prints, "--max-print", {220001, 300000, 0}, {1, 1000, 150000}},
                          Case{reads, "--max-readings", {10000, 100000, 0}, {1, 100}},
                          Case{prints, "--max-seconds", {100, 0}, {}}}) {
        for (const int limit : c.enough) {
            INFO(c.option << " " << limit);
            CHECK(bench.trunnion("run " + c.words + " " + c.option + " " + std::to_string(limit)) ==
                  0);
        }
        for (const int limit : c.too_small) {
            INFO(c.option << " " << limit);
            CHECK(bench.trunnion("run " + c.words + " " + c.option + " " + std::to_string(limit)) ==
                  4);
            CHECK_THAT(bench.read("err.txt"), Catch::Contains("(" + c.option + ")"));
        }
    }
}

TEST_CASE("max-seconds ends the runs of compare, of two programs and of folders") {
    const Bench bench;
    for (const char* folder : {"a", "b"}) {
        std::filesystem::create_directories(bench.path / folder);
        for (const char* name : {"p.nc", "q.nc"})
            bench.write(std::string(folder) + "/" + name,
                        "O1\nG90 G21 G54\nN1 #100=1-#100\nG1 X#100 F500.\nGOTO 1\n" +
                            std::string(folder == std::string("a") ? "" : "(B)\n") + "M30\n");
    }
    const std::string one = "compare " + bench.file("a/p.nc") + " " + bench.file("b/p.nc"),
                      all = "compare " + bench.file("a") + " " + bench.file("b");
    CHECK(bench.trunnion(one + " --by path --max-blocks 0 --max-seconds 0.3 --json") == 4);
    CHECK_THAT(bench.read("err.txt"), Catch::Contains("--max-seconds: the results so far"));
    CHECK(Json::parse(bench.read("out.txt"))["equal"] == false);
    CHECK(bench.trunnion(all + " --by path --max-blocks 0 --max-seconds 0.3 --threads 1 --json") ==
          4);
    CHECK_THAT(bench.read("out.txt"), Catch::Contains("not compared: --max-seconds"));
    const std::string part = bench.write("done.nc", "O1\nG90 G21 G54\nG0 X1.\nM30\n");
    CHECK(bench.trunnion("compare " + part + " " + part + " --max-seconds 100") == 0);
    CHECK(bench.trunnion("compare " + part + " " + part + " --max-seconds 0") == 0);
    CHECK(bench.trunnion("compare " + part + " " + part + " --max-seconds -1") == 2);
}

TEST_CASE("max-seconds ends check with the findings of the programs that it has read") {
    const Bench bench;
    std::filesystem::create_directories(bench.path / "two");
    bench.write("two/a.nc", "O1\nG90 G21 G54\nG77\nM30\n");
    bench.write("two/b.nc", "O2\nN1 #100=1-#100\nGOTO 1\nM30\n");
    const std::string two = "check " + bench.file("two") + " --run --max-blocks 0 --json";
    for (const char* also : {"", " --against tcp_frame=start"}) {
        CHECK(bench.trunnion(two + also + " --max-seconds 0.3") == 4);
        CHECK_THAT(bench.read("err.txt"),
                   Catch::Contains("stopped after 1 of 2 programs (--max-seconds)"));
        const Json report = Json::parse(bench.read("out.txt"));
        REQUIRE(report["findings"].size() == 1);
        CHECK(report["findings"][0]["line"] == 3);
    }
    const std::string one = "check " + bench.file("two/a.nc") + " --run";
    CHECK(bench.trunnion(one + " --max-seconds 100") == 1);
    CHECK(bench.trunnion(one + " --max-seconds 0") == 1);
    CHECK(bench.trunnion(one + " --max-seconds -1") == 2);
}

TEST_CASE("max-seconds ends a volumetric map with the poses so far") {
    const Bench bench;
    const std::string map = "volumetric --setup " TRUNNION_SOURCE_DIR
                            "/machines/bc_table.toml --csv " +
                            bench.file("m.csv");
    CHECK(bench.trunnion(map + " --grid 20 --rotary-grid 10 --max-seconds 0.05") == 4);
    CHECK_THAT(bench.read("err.txt"), Catch::Contains("--max-seconds: these are the first "));
    CHECK(bench.trunnion(map + " --grid 2 --max-seconds 100") == 0);
    CHECK(bench.trunnion(map + " --grid 2 --max-seconds -1") == 2);
}

TEST_CASE("max-memory ends a command that needs more, with one message and no output") {
    const Bench bench;
    std::string text =
        "# schema = trunnion.readings/1\nindex,time_s,test,device,feature,x_mm,y_mm,z_mm,b_deg,"
        "c_deg,dir_x,dir_y,dir_z,value_mm\n";
    for (int k = 0; k < 50000; ++k)
        text += std::to_string(k) + "," + std::to_string(k) + ",t,sphere,S1,120,0,230,0," +
                std::to_string(k % 360) + "," + (k % 2 ? "1,0" : "0,1") + ",0,0.001\n";
    const std::string table = bench.write("t.csv", text);
    const std::string words = "identify " + table +
                              " --setup " TRUNNION_SOURCE_DIR "/machines/bc_table.toml --out " +
                              bench.file("p.toml") + " --max-memory ";
    CHECK(bench.trunnion(words + "20") == 4);
    CHECK_THAT(bench.read("err.txt"), Catch::Contains("there is not enough memory (--max-memory"));
    CHECK_FALSE(std::filesystem::exists(bench.file("p.toml")));
    CHECK(bench.trunnion(words + "2000") == 0);
    CHECK(bench.trunnion(words + "0") == 0);
    CHECK(bench.trunnion(words + "-1") == 2);
    CHECK(bench.trunnion(words + "much") == 2);
}

TEST_CASE("compensate ends an endless program and writes nothing") {
    const Bench bench;
    const std::string loop = bench.write("loop.nc", "O1\nG91\nN1 G0 X.01\nX-.01\nGOTO 1\nM30\n");
    CHECK(bench.trunnion("compensate " + loop + " --max-blocks 20000 --out " +
                         bench.file("c.nc")) == 4);
    CHECK_FALSE(std::filesystem::exists(bench.file("c.nc")));
    CHECK(bench.interrupted("compensate " + loop + " --max-blocks 0 --out " + bench.file("c.nc")) ==
          4);
    CHECK_FALSE(std::filesystem::exists(bench.file("c.nc")));
}

TEST_CASE("a loop over many empty lines obeys the limit and the interruption") {
    const Bench bench;
    std::string text = "O1\n";
    for (int k = 0; k < 400000; ++k) text += "N1\n";
    const std::string loop = bench.write("empty.nc", text + "GOTO 1\nM30\n");
    CHECK(bench.trunnion("run " + loop + " --max-blocks 1000") == 4);
    CHECK(bench.interrupted("run " + loop + " --max-blocks 0") == 4);
    CHECK_THAT(bench.read("err.txt"), Catch::Contains("(interrupted)"));
}
