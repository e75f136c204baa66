// The program at the edge of the operating system: full disks, closed streams, pipes, signals.
#include <sys/wait.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "base/sha256.h"
#include "tests/cli/command_bench.h"

namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

const std::string program =
    "O1\nG90 G21 G54\nG1 X10. F500.\nX20. Y5.\n#100=3\nDPRNT[A#100[30]]\nM30\n";

struct Bench : CommandBench {
    std::string nc = write("part.nc", program);

    /// Exit code of a line of the shell in which $T is the program.
    int shell(const std::string& line) const {
        const std::string with = "T=" + std::string(TRUNNION_BINARY_DIR) + "/bin/trunnion; cd " +
                                 path.string() + "; " + line;
        const int status = std::system(with.c_str());
        return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    }
    std::size_t count() const {
        return static_cast<std::size_t>(std::distance(fs::directory_iterator(path), {}));
    }
};

}  // namespace

TEST_CASE("a full disk is told by every command that writes") {
    const Bench bench;
    for (const char* words :
         {"run part.nc", "run part.nc --json", "run part.nc --vars 100", "check part.nc --json",
          "compare part.nc part.nc", "compensate part.nc", "pivot", "volumetric --grid 2", "--help",
          "--version", "run --help"})
        CHECK(bench.shell(std::string("$T ") + words + " > /dev/full 2> err.txt") == 2);
    CHECK_THAT(bench.read("err.txt"), Catch::Contains("No space left on device"));
    for (const char* words :
         {"run part.nc --trace /dev/full", "run part.nc --print /dev/full",
          "compensate part.nc --out /dev/full", "check part.nc --out /dev/full"})
        CHECK(bench.shell(std::string("$T ") + words + " > out.txt 2> err.txt") == 2);
}

TEST_CASE("a full disk under one output leaves none of the others") {
    const Bench bench;
    bench.write("machine.toml", "");
    fs::copy_file(TRUNNION_SOURCE_DIR "/machines/bc_table.toml", bench.file("machine.toml"),
                  fs::copy_options::overwrite_existing);
    fs::create_directories(bench.path / "backup");
    bench.write("backup/MACRO.TXT", "%\nG10L85P500(400C000000000000)\n%\n");
    bench.write("suite.toml", "schema = \"trunnion.suite/1\"\n[[case]]\nprogram = \"part.nc\"\n");
    const std::string table =
        "# schema = trunnion.readings/1\nindex,time_s,test,device,feature,"
        "x_mm,y_mm,z_mm,b_deg,c_deg,dir_x,dir_y,dir_z,value_mm\n";
    std::string rows;
    for (int k = 0; k < 36; ++k) {
        const double c_rad = k * std::numbers::pi / 18.0;
        rows += std::to_string(k) + "," + std::to_string(k) + ",t,sphere,S1," +
                std::to_string(120.0 * std::cos(c_rad)) + "," +
                std::to_string(-120.0 * std::sin(c_rad)) + ",230,0," + std::to_string(10 * k) +
                (k % 2 == 0 ? ",1,0,0,0.00" : ",0,1,0,0.00") + std::to_string(k % 7) + "\n";
    }
    bench.write("readings.csv", table + rows);
    bench.write("err.txt", "");
    const std::size_t before = bench.count();
    for (const char* words :
         {"volumetric --grid 2 --rotary-grid 1 --csv v.csv --svg pictures --html v.html",
          "volumetric --grid 2 --rotary-grid 1 --csv v.csv --json",
          "identify readings.csv --setup machine.toml --effects C.backlash --out s.toml --html "
          "s.html",
          "diagnose readings.csv --setup machine.toml --out s.toml --html s.html",
          "backup save backup copy --setup machine.toml",
          "compare --suite suite.toml --update --reason new"}) {
        INFO(words);
        CHECK(bench.shell(std::string("$T ") + words + " > /dev/full 2> err.txt") == 2);
        CHECK_THAT(bench.read("err.txt"), Catch::Contains("No space left on device"));
        CHECK(bench.count() == before);
    }
}

TEST_CASE("goldens that are written are told as JSON too") {
    const Bench bench;
    bench.write("suite.toml", "schema = \"trunnion.suite/1\"\n[[case]]\nprogram = \"part.nc\"\n");
    for (const std::size_t written : {1u, 0u}) {
        REQUIRE(bench.shell(
                    "$T compare --suite suite.toml --update --reason new --json > o.json") == 0);
        const Json json = Json::parse(bench.read("o.json"));
        CHECK(json.at("schema") == "trunnion.goldens/1");
        CHECK(json.at("written").size() == written);
    }
}

TEST_CASE("closed streams end in an exit code and write into no file of the user") {
    const Bench bench;
    CHECK(bench.shell("$T run part.nc --trace t.csv --json >&- 2> err.txt") == 2);
    CHECK_FALSE(fs::exists(bench.file("t.csv")));
    CHECK(bench.shell("$T run part.nc --trace t.csv --print p.txt > out.txt 2>&-") == 0);
    CHECK_THAT(bench.read("t.csv"), Catch::StartsWith("seq,program") && Catch::EndsWith("\n"));
    CHECK(bench.read("p.txt") == "A   3\n");
    CHECK(bench.shell("$T run part.nc --trace u.csv <&- >&- 2>&-") == 2);
    CHECK(bench.shell("$T run part.nc --trace u.csv > out.txt 2> /dev/full") == 0);
    CHECK(bench.read("u.csv") == bench.read("t.csv"));
    CHECK(bench.shell("$T run - <&- > out.txt 2> err.txt") == 2);
    CHECK(bench.shell("$T > out.txt 2> /dev/full") == 2);
}

TEST_CASE("a reader that goes away ends the run with a message and leaves nothing") {
    const Bench bench;
    bench.write("loop.nc", "O1\nN1 #100=#100+1\nDPRNT[N#100[80]]\nIF[#100LT200000]GOTO 1\nM30\n");
    const std::size_t before = bench.count();
    CHECK(bench.shell("($T run loop.nc --trace t.csv 2> ../err$$; echo $? > ../code$$) | head -1 "
                      "> /dev/null; mv ../err$$ err.txt; mv ../code$$ code.txt") == 0);
    CHECK(bench.read("code.txt") == "2\n");
    CHECK_THAT(bench.read("err.txt"), Catch::Contains("Broken pipe"));
    CHECK(bench.count() == before + 2);
}

TEST_CASE("programs and readings come from standard input and from pipes") {
    const Bench bench;
    CHECK(bench.shell("$T run part.nc --print a.txt 2> err.txt") == 0);
    CHECK(bench.shell("cat part.nc | $T run - --print b.txt 2> err.txt") == 0);
    CHECK(bench.shell("cat part.nc | $T run /dev/stdin --print c.txt 2> err.txt") == 0);
    CHECK(bench.shell("bash -c \"$T run <(cat part.nc) --print d.txt\" 2> err.txt") == 0);
    for (const char* name : {"b.txt", "c.txt", "d.txt"})
        CHECK(bench.read(name) == bench.read("a.txt"));
    CHECK(bench.shell("cat part.nc | $T compare - part.nc > out.txt 2> err.txt") == 0);
    CHECK(bench.shell("cat part.nc | $T compensate - > out.txt 2> err.txt") == 0);
}

TEST_CASE("the JSON of a run names the files that it read, with their hashes") {
    const Bench bench;
    bench.write("main.nc", "O2\nM98 P77\nM30\n");
    bench.write("O0077.nc", "O77\nM99\n");
    CHECK(bench.shell("$T run main.nc --json > out.txt 2> err.txt") == 0);
    const Json files = Json::parse(bench.read("out.txt"))["programs"];
    REQUIRE(files.size() == 2);
    CHECK(files[0]["path"] == "main.nc");
    CHECK(files[0]["sha256"] == trunnion::sha256("O2\nM98 P77\nM30\n"));
    CHECK(files[1]["sha256"] == trunnion::sha256("O77\nM99\n"));
}

TEST_CASE("a program that is posted again while it runs changes nothing") {
    const Bench bench;
    const std::string far(1000000, ' ');
    bench.write("long.nc", "O1\nN1 #101=#101+1\nIF[#101LT2000000]GOTO 9\nM30\n" + far +
                               "\nN9 X[#101-#101]\nGOTO 1\n" + far + "\nO9\nM99\n");
    CHECK(bench.shell("$T run long.nc --json > out.txt 2> err.txt & job=$!; sleep 0.4; echo O1 > "
                      "long.nc; wait $job") == 0);
    CHECK(Json::parse(bench.read("out.txt"))["variables"]["101"] == 2000000);
}

TEST_CASE("an input is safe from outputs named like temporary files") {
    const Bench bench;
    bench.write("r.csv.part", program);
    CHECK(bench.shell("$T run r.csv.part --trace r.csv > out.txt 2> err.txt") == 0);
    CHECK(bench.read("r.csv.part") == program);
}

TEST_CASE("a signal leaves no temporary file") {
    const Bench bench;
    bench.write("loop.nc", "O1\nG91\nN1 G0 X.01\nX-.01\nGOTO 1\nM30\n");
    const std::size_t before = bench.count();
    for (const auto& [signal, code] : {std::pair("HUP", 4), std::pair("KILL", 137)}) {
        CHECK(bench.shell(std::string("$T run loop.nc --trace t.csv > /dev/null 2>&1 & job=$!; "
                                      "sleep 0.7; kill -") +
                          signal + " $job; wait $job") == code);
        fs::remove(bench.file("t.csv"));
        CHECK(bench.count() == before);
    }
}

TEST_CASE("a program that is copied alone says where it looked for the machines") {
    const Bench bench;
    CHECK(bench.shell("cp $T alone; unset TRUNNION_HOME; ./alone run part.nc 2> err.txt") == 0);
    fs::create_directories(bench.path / "home/machines");
    CHECK(bench.shell("cp " TRUNNION_SOURCE_DIR "/machines/bc_table.toml home/machines/; "
                      "TRUNNION_HOME=home ./alone run part.nc 2> err.txt") == 0);
}

TEST_CASE("a pipe that nobody writes to or reads ends every command with a message") {
    const Bench bench;
    REQUIRE(bench.shell("mkfifo pipe") == 0);
    for (const char* words :
         {"run pipe", "check pipe --max-seconds 0.3", "compare pipe part.nc --max-seconds 0.3",
          "run part.nc --setup pipe --max-seconds 0.3",
          "run part.nc --trace pipe --max-seconds 0.3",
          "diagnose pipe --setup pipe --max-seconds 0.3"}) {
        INFO(words);
        CHECK(bench.shell(std::string("timeout 20 $T ") + words + " > out.txt 2> err.txt") == 2);
        CHECK_THAT(bench.read("err.txt"), Catch::Contains("this pipe (after "));
    }
    CHECK(bench.shell("$T run pipe --max-seconds 30 2> err.txt & job=$!; sleep 0.3; kill -TERM "
                      "$job; wait $job") != 0);
}

TEST_CASE("a program is read from a named pipe with a late writer") {
    const Bench bench;
    CHECK(bench.shell("$T run part.nc --print a.txt 2> err.txt; mkfifo pipe; (sleep 0.3; cat "
                      "part.nc > pipe) & $T run pipe --print b.txt 2> err.txt; code=$?; wait; exit "
                      "$code") == 0);
    CHECK(bench.read("b.txt") == bench.read("a.txt"));
    CHECK(bench.shell("sleep 3 | $T run - --max-seconds 0.3 2> err.txt") == 2);
    CHECK_THAT(bench.read("err.txt"), Catch::Contains("neither data nor an end (after 0.3"));
}

TEST_CASE("a folder that a command made goes again when the disk is full") {
    const Bench bench;
    CHECK(bench.shell("(ulimit -f 0; trap '' XFSZ; $T pivot --write-programs new/deep 2> "
                      "/dev/null)") == 2);
    CHECK_FALSE(fs::exists(bench.file("new")));
}
