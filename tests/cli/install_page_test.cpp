// docs/install.md: the steps of the workflow that call trunnion do what the page says.
#include <catch2/catch.hpp>
#include <vector>

#include "tests/cli/command_bench.h"

namespace {

namespace fs = std::filesystem;

const std::string source = TRUNNION_SOURCE_DIR;

/// The commands of the workflow that call trunnion, in their order.
std::vector<std::string> steps() {
    std::ifstream page(source + "/docs/install.md");
    std::vector<std::string> list;
    bool inside = false;
    for (std::string line; std::getline(page, line);) {
        if (line.starts_with("```")) inside = line == "```yaml";
        const std::size_t at = line.find("trunnion ");
        if (inside && at != std::string::npos && line.find_first_not_of(" -run:") == at)
            list.push_back(line.substr(at + 9));
    }
    return list;
}

void copy_program(const CommandBench& bench, const std::string& from, const std::string& to) {
    fs::create_directories((bench.path / to).parent_path());
    fs::copy_file(source + "/programs/examples/" + from, bench.path / to);
}

}  // namespace

TEST_CASE("the workflow: check speaks to GitHub, compare fills the summary of the step") {
    const CommandBench bench;
    copy_program(bench, "bracket_g43_4.nc", "old/programs/part.nc");
    copy_program(bench, "bracket_post.nc", "new/programs/part.nc");
    const std::string folder = bench.path.string(), summary = bench.file("summary.md");
    const std::string before =
        "cd " + folder + " && export GITHUB_STEP_SUMMARY=" + summary + " && ";
    const std::vector<std::string> list = steps();
    REQUIRE(list.size() == 2);
    const auto run = [&](const std::string& words) {
        const std::string program = std::string(TRUNNION_BINARY_DIR) + "/bin/trunnion ";
        return WEXITSTATUS(std::system((before + program + words + " 2> err.txt").c_str()));
    };
    CHECK(run(list[0] + " > check.txt") == 0);
    CHECK(run(list[1]) == 1);  // the pull request fails: a hole moved
    const std::string text = bench.read("summary.md");
    CHECK_THAT(text, Catch::Contains("differs") && Catch::Contains("part.nc") &&
                         Catch::Contains("0.0913"));
    CHECK(text.find('|') != std::string::npos);
    bench.write("new/programs/part.nc", "O1\nG999\nM30\n");
    CHECK(run(list[0] + " > check.txt") == 1);
    CHECK_THAT(bench.read("check.txt"),
               Catch::StartsWith("::error file=new/programs/part.nc,line=2"));
}
