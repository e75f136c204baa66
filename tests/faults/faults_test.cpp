// Every command while single calls of the system fail: the exit code says so, outputs are whole or
// absent, nothing crashes. TRUNNION_FAULTS=all (./dev assure) fails every call, not samples.
#include <fmt/format.h>
#include <sys/wait.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <set>
#include <sstream>

#include "tests/cli/command_bench.h"

namespace fs = std::filesystem;

namespace {

const std::string source = TRUNNION_SOURCE_DIR;

/// Words of a command; `out/` is an empty folder, `in/` holds part.nc, other.nc and readings.csv.
const std::vector<std::string> commands{
    "run in/part.nc --trace out/t.csv --readings out/r.csv --print out/p.txt --json",
    "run O77 --programs in --vars 100",
    "run - --programs in --json",
    "check in --run --out out/c.txt",
    "compare in/part.nc in/other.nc --json --out out/c.json",
    "compare --suite in/suite.toml --shard 1/1 --out out/part.json",
    "compare --suite in/suite.toml --update --reason faults",
    "compensate in/part.nc --out out/c.nc",
    "volumetric --grid 2 --rotary-grid 1 --csv out/v.csv --svg out",
    "backup save in/backup out --setup in/machine.toml",
    "predict in/readings.csv --setup in/machine.toml",
    "identify in/readings.csv --setup in/machine.toml --effects C.backlash --out out/s.toml",
    "diagnose in/readings.csv --setup in/machine.toml --json --out out/d.toml --html out/d.html",
    "pivot --setup in/machine.toml --json --svg out/p --print out/p.txt --html out/p.html",
    "pivot --setup in/machine.toml --write-programs out/programs",
    "diagnose in/log.csv --program in/part.nc --programs in --setup in/machine.toml --json --html "
    "out/d.html",
    "ballbar --setup in/machine.toml --program out/b.nc",
    "ballbar --setup in/machine.toml --kinematic-program out/k.nc",
    "ballbar in/bar.csv --setup in/bar.toml --json --csv out/b.csv --svg out/b --html "
    "out/b.html",
    "run in/part.nc --html out/run.html --setup in/machine.toml",
    "volumetric --grid 2 --rotary-grid 1 --html out/v.html --json",
    "compare in/part.nc in/other.nc --html out/c.html",
    "effects --json",
    "completion bash",
    "import iso230-2 in/laser.csv --setup in/machine.toml --with axis=X --out out/i.csv --svg "
    "out/i "
    "--html out/i.html",
    "merge in/p1.json in/p2.json --format json --out out/m.json",
    "merge in/c1.json --format markdown --out out/m.md",
};
const std::vector<std::string> functions{"open",   "read",    "write",   "close",  "fsync",
                                         "rename", "linkat",  "pread",   "pwrite", "fchmod",
                                         "mmap",   "unnamed", "readdir", "malloc", "poll"};

struct Outcome {
    int code = 0;  ///< above 128: a signal
    std::string out;
    std::map<std::string, std::string> files;
    bool operator==(const Outcome&) const = default;
};

class FaultBench : public CommandBench {
  public:
    FaultBench() {
        fs::create_directories(path / "in/backup");
        write("in/part.nc",
              "O1\nG90 G21 G54\nG0 X0 Y0 Z0\nG1 X10. F500.\nG2 X20. Y10. R10.\n"
              "#100=3\nDPRNT[A#100[30]]\nM98 P77\nM30\n");
        write("in/other.nc",
              "O1\nG90 G21 G54\nG0 X0 Y0 Z0\nG1 X10. F500.\nG2 X20. Y11. R10.\nM30\n");
        write("in/O0077.nc", "O77\n#100=7\nM99\n");
        write("in/suite.toml",
              "schema = \"trunnion.suite/1\"\ngoldens = \"../out\"\n[[case]]\n"
              "name = \"a\"\nprogram = \"part.nc\"\n");
        write("in/backup/MACRO.TXT", "%\nG10L85P500(400C000000000000)\n%\n");
        write("in/readings.csv", readings());
        write("in/machine.toml", read_whole(source + "/machines/bc_table.toml") +
                                     "\n[[artefact]]\nname = \"T1\"\nkind = \"target\"\n"
                                     "center_mm = [0, 0, 0]\n");
        write("in/laser.csv", "target [mm],1+ [um],1- [um]\n0,0,1\n90,2,3\n");
        for (const char* shard : {"1/2", "2/2"})
            make(
                "identify in/readings.csv --setup in/machine.toml --effects C.backlash "
                "--monte-carlo 4 --out in/p{i}.json --shard " +
                std::string(shard));
        make("run in/part.nc --programs in --setup in/machine.toml --trace in/log.csv");
        std::string seldom = read("in/machine.toml");
        const std::string noise = "noise_um  = 0.1";
        REQUIRE(seldom.find(noise) != std::string::npos);
        seldom.replace(seldom.find(noise), noise.size(), noise + "\nsample_hz = 1");
        write("in/bar.toml", seldom);
        make("ballbar --setup in/bar.toml --write-readings in/bar.csv");
        make("compare --suite in/suite.toml --out in/c{i}.json --shard 1/1");
    }

    /// A sphere found at turns of C to and fro, with some backlash.
    static std::string readings() {
        std::string text =
            "# schema = trunnion.readings/1\nindex,time_s,test,device,feature,x_mm,y_mm,z_mm,b_deg,"
            "c_deg,dir_x,dir_y,dir_z,value_mm\n";
        for (int k = 0; k < 36; ++k) {
            const double c_deg = k < 18 ? 20.0 * k : 360.0 - 20.0 * (k - 17);
            const double c_rad = c_deg * std::numbers::pi / 180.0;
            text += fmt::format("{},{},t,sphere,S1,{},{},230,0,{},{},{},{},{}\n", k, k,
                                120.0 * std::cos(c_rad), -120.0 * std::sin(c_rad), c_deg,
                                int{k % 3 == 0}, int{k % 3 == 1}, int{k % 3 == 2},
                                0.001 * (k % 7) + (k < 18 ? 0.004 : -0.004));
        }
        return text;
    }

    Outcome run(const std::string& words, const std::string& fault) const {
        fs::remove_all(path / "out");
        fs::create_directories(path / "out");
        const std::string line =
            "cd " + path.string() +
            " && cat in/part.nc | LD_PRELOAD=" TRUNNION_FAULT_LIBRARY " TRUNNION_FAULT=" + fault +
            " TRUNNION_FAULT_COUNT=count.txt " TRUNNION_BINARY_DIR "/bin/trunnion " + words +
            " > out.txt 2> err.txt";
        const int status = std::system(line.c_str());
        Outcome outcome{WIFEXITED(status) ? WEXITSTATUS(status) : 128, read("out.txt"), {}};
        for (const auto& entry : fs::recursive_directory_iterator(path / "out"))
            if (entry.is_regular_file())
                outcome.files[fs::relative(entry.path(), path).string()] =
                    read_whole(entry.path().string());
        return outcome;
    }
    /// An input that the program itself writes.
    void make(const std::string& words) const {
        const std::string line = "cd " + path.string() +
                                 " && " TRUNNION_BINARY_DIR "/bin/trunnion " + words +
                                 " > out.txt 2> err.txt";
        INFO(words << "\n" << read("err.txt"));
        REQUIRE(WEXITSTATUS(std::system(line.c_str())) < 2);
    }
    long calls() const { return std::atol(read("count.txt").c_str()); }

  private:
    static std::string read_whole(const std::string& name) {
        std::ostringstream text;
        text << std::ifstream(name).rdbuf();
        return text.str();
    }
};

/// Which of `count` calls fail one after the other.
std::set<long> chosen(long count) {
    const char* const wish = std::getenv("TRUNNION_FAULTS");
    const long most = wish && std::string(wish) == "all" ? 300 : 3;
    std::set<long> calls;
    for (long k = 0; k < most && count > 0; ++k)
        calls.insert(1 + k * (count - 1) / std::max(1L, most - 1));
    return calls;
}

/// The files are those of the run without a fault, or some of them are missing.
bool whole_or_absent(const Outcome& faulted, const Outcome& plain) {
    for (const auto& [name, text] : faulted.files)
        if (const auto it = plain.files.find(name); it == plain.files.end() || it->second != text)
            return false;
    return true;
}

bool all_or_none(const Outcome& faulted, const Outcome& plain) {
    return faulted.files.empty() || faulted.files == plain.files;
}

}  // namespace

// std::filesystem ends the program when it finds no memory for the next folder of a search.
TEST_CASE("no memory for any part of a search for programs ends no command in an abort") {
    const FaultBench bench;
    const std::string words = "run O77 --programs in --vars 100";
    bench.run(words, "malloc:0");
    const long count = bench.calls();
    for (long call = std::max(1L, count - 700); call < count; call += 4) {
        const Outcome faulted = bench.run(words, "malloc:" + std::to_string(call));
        INFO("malloc " << call << "\n" << bench.read("err.txt"));
        CHECK((faulted.code == 4 || faulted.code == 2 || faulted.code == 0));
    }
}

// Eigen frees a matrix before it has the memory for another size.
TEST_CASE("no memory for any matrix of a diagnosis ends it in an abort") {
    const FaultBench bench;
    const std::string words = "diagnose in/readings.csv --setup in/machine.toml --json";
    bench.run(words, "malloc:0");
    const long count = bench.calls();
    for (long call = count / 2; call < count; call += 103) {
        const Outcome faulted = bench.run(words, "malloc:" + std::to_string(call));
        INFO("malloc " << call << "\n" << bench.read("err.txt"));
        CHECK((faulted.code == 4 || faulted.code == 2 || faulted.code == 0));
    }
}

// A compiler may destroy what it has not made yet.
TEST_CASE("no memory for any part of a diagnosis of a log ends it in an abort") {
    const FaultBench bench;
    const std::string words =
        "diagnose in/log.csv --program in/part.nc --programs in --setup in/machine.toml --json";
    bench.run(words, "malloc:0");
    const long count = bench.calls();
    for (long call = 1; call < count; call += 11) {
        const Outcome faulted = bench.run(words, "malloc:" + std::to_string(call));
        INFO("malloc " << call << "\n" << bench.read("err.txt"));
        CHECK((faulted.code == 4 || faulted.code == 2 || faulted.code == 0));
    }
}

TEST_CASE("an output whose bytes may not have reached the disk is refused") {
    const FaultBench bench;
    const std::string words = "run in/part.nc --programs in --trace out/t.csv";
    REQUIRE(bench.run(words, "fsync:0").files.size() == 1);
    const Outcome faulted = bench.run(words, "fsync:1");
    CHECK(faulted.code == 2);
    CHECK(faulted.files.empty());
    CHECK(bench.read("err.txt").find("out/t.csv") != std::string::npos);
}

TEST_CASE("a device that takes no byte is refused, not asked for ever") {
    const FaultBench bench;
    const std::string words = "run in/part.nc --programs in --trace out/t.csv";
    REQUIRE(bench.run(words, "stall:0").files.size() == 1);
    const Outcome faulted = bench.run(words, "stall:1");
    CHECK(faulted.code == 2);
    CHECK(faulted.files.empty());
    CHECK(bench.read("err.txt").find("out/t.csv") != std::string::npos);
}

TEST_CASE("no command crashes, lies or leaves halves when a call of the system fails") {
    const FaultBench bench;
    for (const std::string& words : commands) {
        const Outcome plain = bench.run(words, "none:0");
        INFO(words << "\n" << bench.read("err.txt"));
        REQUIRE(plain.code < 2);
        for (const std::string& function : functions) {
            bench.run(words, function + ":0");
            for (const long call : chosen(bench.calls())) {
                const Outcome faulted = bench.run(words, function + ":" + std::to_string(call));
                INFO(function << " " << call << "\n" << bench.read("err.txt"));
                CHECK((faulted == plain || faulted.code == 2 || faulted.code == 4));
                CHECK(whole_or_absent(faulted, plain));
                if (function != "rename") CHECK(all_or_none(faulted, plain));
                if (faulted.code != plain.code && function != "write")
                    CHECK_FALSE(bench.read("err.txt").empty());
            }
        }
    }
}