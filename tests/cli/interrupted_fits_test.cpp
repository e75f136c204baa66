// Ctrl-C and --max-seconds in fits: what is found until then is printed, written and said.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <csignal>
#include <nlohmann/json.hpp>
#include <numbers>
#include <thread>

#include "setup/setup.h"
#include "tests/cli/command_bench.h"

using namespace trunnion;
using Json = nlohmann::json;

namespace {

struct Bench : CommandBench {
    std::string setup = TRUNNION_SOURCE_DIR "/machines/bc_table.toml";

    /// A sphere found at `rows` places of C, with backlash and a ripple.
    std::string table(int rows) const {
        std::string text =
            "# schema = trunnion.readings/1\nindex,time_s,test,device,feature,x_mm,y_mm,z_mm,b_deg,"
            "c_deg,dir_x,dir_y,dir_z,value_mm\n";
        double before_deg = 0.0;
        for (int k = 0; k < rows; ++k) {
            const double c_deg = std::fmod(k * 137.508, 600.0) - 300.0;
            const double c_rad = c_deg * std::numbers::pi / 180.0;
            const double value_mm =
                (c_deg > before_deg ? 0.004 : -0.004) + 0.003 * std::sin(7.0 * c_rad);
            before_deg = c_deg;
            text += fmt::format("{},{},t,sphere,S1,{},{},230,0,{},{},{},0,{}\n", k, k,
                                120.0 * std::cos(c_rad), -120.0 * std::sin(c_rad), c_deg,
                                int{k % 2 == 0}, int{k % 2 == 1}, value_mm);
        }
        return write("table.csv", text);
    }

    /// Exit code of the program when it gets the signal after so many seconds. Above 128: it died
    /// of a signal.
    int signalled(const std::string& words, int signal, double after_s) const {
        const std::string line = "exec " TRUNNION_BINARY_DIR "/bin/trunnion " + words + " >" +
                                 file("out.txt") + " 2>" + file("err.txt");
        const pid_t child = ::fork();
        if (child == 0) {
            std::signal(SIGINT, SIG_DFL);
            ::execl("/bin/sh", "sh", "-c", line.c_str(), nullptr);
            ::_exit(127);
        }
        std::this_thread::sleep_for(std::chrono::duration<double>(after_s));
        ::kill(child, signal);
        int status = 0;
        ::waitpid(child, &status, 0);
        return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    }

    std::string identify(int rows) const {
        return "identify " + table(rows) + " --setup " + setup +
               " --effects location,C.backlash,C.cyclic,X.cyclic,Y.cyclic --json --out " +
               file("x.toml");
    }
    std::string diagnose(int rows) const {
        return "diagnose " + table(rows) + " --setup " + setup + " --json --out " + file("x.toml");
    }
    /// A result that is whole, and a setup that can be read.
    void check_kept() const {
        INFO(read("err.txt"));
        CHECK(Json::parse(read("out.txt")).is_object());
        std::vector<std::string> notes;
        CHECK_NOTHROW(setup::load_setup(file("x.toml"), notes));
    }
};

}  // namespace

TEST_CASE("Ctrl-C in identify keeps what is fitted and names what is not") {
    const Bench bench;
    CHECK(bench.signalled(bench.identify(20000), SIGINT, 1.0) == 4);
    bench.check_kept();
    CHECK_THAT(bench.read("err.txt"), Catch::Contains("interrupted: the keys of") &&
                                          Catch::Contains("keep their usual values"));
}

TEST_CASE("Ctrl-C in diagnose gives the verdict on the best model until then") {
    const Bench bench;
    CHECK(bench.signalled(bench.diagnose(9900), SIGINT, 1.0) == 4);
    bench.check_kept();
    CHECK_THAT(bench.read("err.txt"), Catch::Contains("interrupted: "));
}

TEST_CASE("diagnose ends with a verdict whenever its time is up") {
    const Bench bench;
    const std::string words = bench.diagnose(3000) + " --max-seconds ";
    for (int k = 1; k <= 12; ++k) {
        const int code = bench.trunnion(words + fmt::format("{}", 0.04 * k));
        INFO(0.04 * k << " s: " << bench.read("err.txt"));
        CHECK((code == 4 || code == 0));
        bench.check_kept();
    }
}

TEST_CASE("a second signal ends a fit at once, and nothing is half written") {
    const Bench bench;
    const std::string job = "( exec " TRUNNION_BINARY_DIR "/bin/trunnion " + bench.identify(20000) +
                            " >" + bench.file("out.txt") + " 2>" + bench.file("err.txt") +
                            " ) & job=$!; sleep 0.3; kill -TERM $job; sleep 0.03; kill -TERM $job; "
                            "wait $job";
    CHECK(WEXITSTATUS(std::system(job.c_str())) == 128 + SIGTERM);
    CHECK_FALSE(std::filesystem::exists(bench.file("x.toml")));
    CHECK(bench.read("out.txt").empty());
}

TEST_CASE("max-seconds ends the search of identify and diagnose with what is found") {
    const Bench bench;
    for (const std::string& words : {bench.identify(2000), bench.diagnose(2000)}) {
        INFO(words);
        CHECK(bench.trunnion(words + " --max-seconds 0.001") == 4);
        bench.check_kept();
        CHECK_THAT(bench.read("err.txt"), Catch::Contains("--max-seconds: "));
        std::filesystem::remove(bench.file("x.toml"));
    }
    CHECK(Json::parse(bench.read("out.txt"))["unfinished"] == true);
    CHECK(bench.trunnion(bench.identify(200) + " --max-seconds 1000") == 0);
    CHECK(bench.trunnion(bench.diagnose(200) + " --max-seconds 0") == 0);
    CHECK_FALSE(Json::parse(bench.read("out.txt")).contains("unfinished"));
}

TEST_CASE("Ctrl-C in compare ends the runs in order, and no golden is written of half a run") {
    const Bench bench;
    const std::string loop = "O1\nG90 G21 G54\nN1 #100=1-#100\nG1 X#100 F500.\n";
    const std::string a = bench.write("a.nc", loop + "GOTO 1\nM30\n"),
                      b = bench.write("b.nc", loop + "X0\nGOTO 1\nM30\n");
    CHECK(bench.signalled("compare " + a + " " + b + " --max-blocks 0 --json", SIGINT, 1.0) == 4);
    CHECK(Json::parse(bench.read("out.txt"))["equal"] == false);
    CHECK_THAT(bench.read("err.txt"), Catch::Contains("interrupted"));
    bench.write("s.toml",
                "schema = \"trunnion.suite/1\"\ngoldens = \"goldens\"\n[[case]]\n"
                "name = \"a\"\nprogram = \"a.nc\"\n");
    CHECK(bench.trunnion("compare --suite " + bench.file("s.toml") +
                         " --max-blocks 1000 --update --reason first") == 2);
    CHECK_THAT(bench.read("err.txt"), Catch::Contains("no golden is written"));
    CHECK_FALSE(std::filesystem::exists(bench.file("goldens/a.csv")));
}
