// What is missing, empty or misspelled must not pass for good: exit code 2 and the reason.
#include <catch2/catch.hpp>

#include "tests/cli/command_bench.h"

namespace fs = std::filesystem;

namespace {

struct Bench : CommandBench {
    std::string nc = write("part.nc", "O1\nG0 X1.\nM30\n");

    void refuses(const std::string& words, const std::string& why) const {
        INFO(words);
        CHECK(trunnion(words) == 2);
        CHECK_THAT(read("err.txt"), Catch::Contains(why));
    }
    std::string suite(const std::string& text) const {
        return write("suite.toml", "schema = \"trunnion.suite/1\"\n" + text);
    }
};

}  // namespace

TEST_CASE("an empty name, an empty program and a folder without programs are refused") {
    const Bench bench;
    bench.refuses("run " + bench.nc + " --trace ''", "a file name is empty");
    bench.refuses("check " + bench.nc + " --out ''", "a file name is empty");
    const std::string empty = bench.write("empty.nc", "%\n\n%\n");
    for (const std::string words : {"run ", "check ", "compensate "})
        bench.refuses(words + empty, "the program is empty");
    bench.refuses("compare " + empty + " " + empty, "the program is empty");
    const std::string marked = bench.write("marked.nc", "\xEF\xBB\xBF%\n");
    for (const std::string words : {"run ", "check ", "compensate "})
        bench.refuses(words + marked, "the program is empty");
    fs::create_directories(bench.path / "none");
    bench.refuses("check " + bench.file("none"), "no NC program in this folder");
    bench.refuses("compare " + bench.file("none") + " " + bench.file("none"), "no NC programs");
    for (const std::string words : {"run ", "compensate "})
        bench.refuses(words + bench.file("none"), "none: error: is a folder, not a program");
    for (const std::string& words :
         {bench.nc + " " + bench.file("none"), bench.file("none") + " " + bench.nc})
        bench.refuses("compare " + words, ".nc: error: is a file, but " + bench.file("none"));
}

TEST_CASE("a suite with a misspelled key, without cases, or with a golden elsewhere is refused") {
    const Bench bench;
    bench.refuses("compare --suite " + bench.suite("[[cases]]\nprogram = \"part.nc\"\n"),
                  "no [[case]]");
    bench.refuses(
        "compare --suite " + bench.suite("[[case]]\nprogram = \"part.nc\"\ntol_lin = 1\n"),
        "suite.toml:4:11: error: key 'case.tol_lin' is not known");
    bench.refuses(
        "compare --suite " + bench.suite("[[case]]\nname = \"../../x\"\nprogram = \"part.nc\"\n"),
        "outside its folder");
}

TEST_CASE("a pattern of many stars and a link that leads to itself end at once") {
    const Bench bench;
    fs::create_directories(bench.path / "sub");
    fs::create_symlink("loop.nc", bench.path / "sub/loop.nc");
    bench.write("sub/" + std::string(60, 'a') + ".nc", "O1\nM30\n");
    std::string stars;
    for (int k = 0; k < 25; ++k) stars += "*a";
    bench.refuses(
        "compare --suite " + bench.suite("[[case]]\nprogram = \"sub/" + stars + "b.nc\"\n"),
        "no program matches");
    CHECK(bench.trunnion("check " + bench.file("sub")) < 2);
    bench.refuses("run " + bench.file("sub/loop.nc"), "Too many levels of symbolic links");
}

TEST_CASE("a key of 20,000 parts is refused before it fills the stack") {
    const Bench bench;
    std::string key = "a";
    for (int k = 0; k < 20000; ++k) key += ".a";
    bench.refuses("run " + bench.nc + " --setup " + bench.write("deep.toml", key + " = 1\n"),
                  "more than 64 parts");
    bench.refuses("run " + bench.nc + " --setup " + bench.write("deep.toml", "[" + key + "]\n"),
                  "more than 64 parts");
}

TEST_CASE("readings of another schema and positions beyond any machine are refused") {
    const Bench bench;
    const std::string head =
        "index,time_s,test,device,feature,x_mm,y_mm,z_mm,b_deg,c_deg,dir_x,"
        "dir_y,dir_z,value_mm\n";
    bench.refuses("predict --setup " TRUNNION_SOURCE_DIR "/machines/bc_table.toml " +
                      bench.write("r.csv", "# schema = trunnion.readings/2\n" + head +
                                               "0,0,t,sphere,S1,0,0,0,0,0,1,0,0,0\n"),
                  "trunnion.readings/1");
    bench.refuses("predict --setup " TRUNNION_SOURCE_DIR "/machines/bc_table.toml " +
                      bench.write("r.csv", head + "0,0,t,sphere,S1,1e200,0,0,0,0,1,0,0,0\n"),
                  "beyond 1e9");
}

TEST_CASE("a name with a quote stands in the trace as CSV says") {
    const Bench bench;
    const std::string odd = bench.write("a\"b,c.nc", "O1\nG0 X1.\nM30\n");
    CHECK(bench.trunnion("run '" + odd + "' --trace " + bench.file("t.csv")) == 0);
    CHECK_THAT(bench.read("t.csv"), Catch::Contains("a\"\"b,c.nc\",2,G0"));
}
