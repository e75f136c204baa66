// Law 6 at the command line: the same inputs give the same bytes, whatever surrounds the program.
#include <catch2/catch.hpp>

#include "tests/cli/command_bench.h"

namespace {

struct Bench : CommandBench {
    std::string nc = write("part.nc",
                           "O1\nG90 G21 G54\nG1 X10.5 F500.\nG2 X20. Y10. R10.\n#100=1/3\n"
                           "DPRNT[A#100[39]]\nM30\n");
    std::string other = write("other.nc", "O1\nG90 G21 G54\nG1 X10.6 F500.\nM30\n");

    std::string output(const std::string& surroundings, const std::string& words) const {
        const std::string line = surroundings + " " TRUNNION_BINARY_DIR "/bin/trunnion " + words +
                                 " > " + file("out.txt") + " 2> /dev/null";
        CHECK(WEXITSTATUS(std::system(line.c_str())) < 2);
        return read("out.txt");
    }
};

}  // namespace

TEST_CASE("language, time zone and threads change no byte") {
    const Bench bench;
    for (const std::string& words :
         {"run " + bench.nc + " --json --truth --trace /dev/stdout",
          "compare " + bench.nc + " " + bench.other + " --json", std::string("pivot --json"),
          std::string("volumetric --grid 2 --rotary-grid 2 --csv -"), "compensate " + bench.nc}) {
        INFO(words);
        const std::string plain = bench.output("LC_ALL=C TZ=UTC", words);
        CHECK_FALSE(plain.empty());
        for (const char* surroundings :
             {"LC_ALL=de_DE.UTF-8 LANG=de_DE.UTF-8", "TZ=Asia/Tokyo", "COLUMNS=20 TERM=dumb"})
            CHECK(bench.output(surroundings, words) == plain);
    }
    const std::string folder = bench.file("programs");  // without the outputs
    std::filesystem::create_directories(folder);
    for (const char* name : {"part.nc", "other.nc"})
        std::filesystem::rename(bench.file(name), folder + "/" + name);
    const std::string folders = "compare " + folder + " " + folder + " --json --threads ";
    CHECK(bench.output("", folders + "1") == bench.output("", folders + "4"));
}
