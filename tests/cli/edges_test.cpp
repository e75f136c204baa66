// Suites, parts and processes at their edges: other versions, folders without a name, hostile
// parts, no place for temporary files, and the end of a process in the middle of its work.
#include <signal.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <string>
#include <thread>

#include "tests/cli/command_bench.h"

namespace fs = std::filesystem;

namespace {

struct Bench : CommandBench {
    const std::string program =
        write("part.nc", "O1\nG90 G21 G54\nG0 X0 Y0 Z0\nG1 X10. F500.\nM30\n");

    /// One message that has these words, nothing on stdout.
    void refuses(const std::string& words, const std::string& message) const {
        INFO(words << "\n" << read("err.txt"));
        CHECK(trunnion(words) == 2);
        CHECK(read("out.txt").empty());
        CHECK_THAT(read("err.txt"), Catch::Contains(message));
    }
    std::string part(const std::string& more) const {
        return write("part.json",
                     "{\"schema\":\"trunnion.compare-part/1\",\"suite\":\"s\","
                     "\"single\":false,\"expected\":[],\"cases\":[]," +
                         more + "}");
    }
    int here(const std::string& words) const {
        const std::string line = "cd " + path.string() +
                                 " && " TRUNNION_BINARY_DIR "/bin/trunnion " + words +
                                 " >out.txt 2>err.txt";
        return WEXITSTATUS(std::system(line.c_str()));
    }
    /// Names in the bench's folder.
    std::size_t files() const {
        std::size_t count = 0;
        for (const auto& entry : fs::directory_iterator(path)) count += entry.exists() ? 1 : 0;
        return count;
    }
    /// Exit code of an endless run with a growing trace that gets the signal; above 128: killed.
    int endless(int signal) const {
        const std::string line = "exec " TRUNNION_BINARY_DIR "/bin/trunnion run " + file("l.nc") +
                                 " --max-blocks 0 --trace " + file("t.csv") + " >" +
                                 file("out.txt") + " 2>" + file("err.txt");
        const pid_t child = ::fork();
        if (child == 0) {
            ::execl("/bin/sh", "sh", "-c", line.c_str(), nullptr);
            ::_exit(127);
        }
        std::this_thread::sleep_for(std::chrono::seconds(1));
        ::kill(child, signal);
        int status = 0;
        ::waitpid(child, &status, 0);
        return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    }
};

}  // namespace

TEST_CASE("suites and setups of another version are refused") {
    const Bench bench;
    bench.refuses("compare --suite " + bench.write("s.toml",
                                                   "schema = \"trunnion.suite/2\"\n[[case]]\n"
                                                   "name = \"a\"\nprogram = \"part.nc\"\n"),
                  "s.toml:1:");
    bench.refuses("run " + bench.program + " --setup " +
                      bench.write("m.toml", "schema = \"trunnion.setup/2\"\n"),
                  "trunnion.setup/1");
}

TEST_CASE("a pattern of a suite is looked for in the suite's folder, wherever it is called from") {
    const Bench bench;
    bench.write("s.toml",
                "schema = \"trunnion.suite/1\"\n[[case]]\nprogram = \"*.nc\"\n"
                "against = \"part.nc\"\n");
    CHECK(bench.here("compare --suite s.toml") == 0);
    CHECK(bench.here("compare --suite ./s.toml") == 0);
    CHECK(bench.trunnion("compare --suite " + bench.file("s.toml")) == 0);
    bench.write("none.toml", "schema = \"trunnion.suite/1\"\n[[case]]\nprogram = \"*.tap\"\n");
    CHECK(bench.here("compare --suite none.toml") == 2);
    CHECK_THAT(bench.read("err.txt"), Catch::Contains("no program matches"));
}

TEST_CASE("parts that lie about their size or their cases are refused at once") {
    const Bench bench;
    bench.refuses("merge " + bench.part("\"total\":1000000000000"), "are in no part");
    bench.refuses("merge " + bench.part("\"total\":-1"), "");
    bench.refuses("merge " + bench.part("\"total\":\"many\""), "not a part written");
    bench.refuses("merge " + bench.part("\"total\":0,\"inputs\":[{\"path\":7}]"),
                  "not a part written");
    bench.refuses("merge " + bench.write("deep.json", std::string(200000, '[')),
                  "not a part written");
    bench.refuses("merge " + bench.program, "not a part written");
}

TEST_CASE("a part that is not JSON is refused at its place, another form with what is wrong") {
    const Bench bench;
    const auto says = [&](const std::string& text, const std::string& message) {
        bench.refuses("merge " + bench.write("p.json", text), message);
    };
    const std::string head = "{\n\"schema\":\"trunnion.compare-part/1\",\n";
    says(head + " \"suite\" 7}\n", "p.json:3:10: error: not a part written by");
    CHECK_THAT(bench.read("err.txt"), Catch::Contains("\n     \"suite\" 7}\n             ^"));
    says(head + "\"suite\":",
         "p.json:3:9: error: not a part written by 'compare --shard' or "
         "'identify --shard': the file ends too early");
    says("", "the file is empty");
    says("\n", "the file is empty");
    says(head + "\"suite\":\"s\"}", "key 'single' not found");
    says("{\"schema\":\"trunnion.compare-part/2\"}", "another schema");
}

TEST_CASE("without a folder for temporary files programs are compared all the same") {
    const Bench bench;
    CHECK(WEXITSTATUS(
              std::system(("TMPDIR=/nowhere/at/all " TRUNNION_BINARY_DIR "/bin/trunnion compare " +
                           bench.program + " " + bench.program + " >/dev/null 2>&1")
                              .c_str())) == 0);
}

TEST_CASE("a killed run leaves nothing, one whose terminal went leaves what was done") {
    const Bench bench;
    bench.write("l.nc", "O1\nG90 G21 G54\nN1 #100=1-#100\nG1 X#100 F500.\nGOTO 1\nM30\n");
    bench.write("out.txt", "");
    bench.write("err.txt", "");
    const std::size_t before = bench.files();
    CHECK(bench.endless(SIGKILL) == 128 + SIGKILL);
    CHECK(bench.files() == before);
    CHECK(bench.endless(SIGHUP) == 4);
    CHECK(bench.files() == before + 1);
    CHECK_THAT(bench.read("err.txt"), Catch::Contains("(interrupted)"));
    CHECK(bench.read("t.csv").back() == '\n');
}
