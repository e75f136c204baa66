#include "regression/suite.h"

#include <unistd.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "base/alarm.h"
#include "regression/golden.h"
#include "report/comparison_report.h"
#include "tests/regression/programs.h"

using namespace trunnion;
using namespace trunnion::testing;

namespace fs = std::filesystem;

namespace {

const std::string part_program =
    "%\nO1\nG90 G21 G17 G94 G54\nT1 M6\nS500 M3\nG43 H1 Z10.\nG0 X0. Y0.\nZ2.\n"
    "G1 Z-1. F200.\nX50.\nG3 X60. Y10. I0. J10.\nG0 Z10.\nM30\n%\n";

setup::Setup load_default(const std::string&) {
    return bc_table();
}

class Folder {
  public:
    Folder() {
        path = fs::temp_directory_path() / ("trunnion_suite_" + std::to_string(::getpid()));
        fs::create_directories(path / "old");
        fs::create_directories(path / "new");
    }
    ~Folder() { fs::remove_all(path); }
    std::string write(const std::string& name, const std::string& text) const {
        std::ofstream(path / name, std::ios::binary) << text;
        return (path / name).string();
    }
    fs::path path;
};

/// Five programs, two of which changed, and a suite of them.
std::string write_suite(const Folder& folder) {
    for (int k = 0; k < 5; ++k) {
        const std::string name = "p" + std::to_string(k) + ".nc";
        folder.write("old/" + name, part_program);
        folder.write("new/" + name, k == 1   ? replaced(part_program, "Z10.\nM30", "Z9.9\nM30")
                                    : k == 3 ? replaced(part_program, "F200.", "F210.")
                                             : "(NEW)\n" + part_program);
    }
    return folder.write("suite.toml",
                        "schema = \"trunnion.suite/1\"\n[[case]]\n"
                        "program = \"new/*.nc\"\nagainst = \"old\"\n");
}

}  // namespace

TEST_CASE("a suite gives the same bytes whatever the shards and threads", "[suite]") {
    const Folder folder;
    const regression::Suite suite = regression::read_suite(write_suite(folder), {});
    REQUIRE(suite.cases.size() == 5);
    const regression::SuiteRun whole = regression::run_suite(suite, {}, load_default, 1);
    CHECK(regression::exit_code(whole.report) == 1);
    CHECK(verdict_of(whole.report) == "differs: 2 of 5 programs");
    for (const int count : {1, 2, 3, 5, 6, 7, 40}) {
        std::vector<report::ComparePart> parts;
        for (int index = count; index >= 1; --index) {
            regression::SuiteRun run =
                regression::run_suite(suite, {index, count}, load_default, 2);
            const report::ComparePart part{run.report, run.places, suite.cases.size()};
            parts.push_back(report::parse_part(report::format_part(part), "part.json"));
        }
        const regression::CompareReport merged = report::merge_parts(parts);
        for (const char* format : {"text", "json", "junit", "sarif", "github", "html"})
            CHECK(report::format_comparison(merged, report::report_format(format)) ==
                  report::format_comparison(whole.report, report::report_format(format)));
        if (count > 1) {
            parts.pop_back();
            CHECK_THROWS_AS(report::merge_parts(parts), InputError);
        }
    }
}

TEST_CASE("a difference that is expected by fingerprint does not fail, others do", "[suite]") {
    const Folder folder;
    const std::string path = write_suite(folder);
    regression::Suite suite = regression::read_suite(path, {});
    const regression::SuiteRun before = regression::run_suite(suite, {}, load_default, 1);
    const std::string fingerprint = before.report.cases[3].differences.front().fingerprint;
    suite.expected.push_back({"new/p3", fingerprint, "faster on purpose"});
    const regression::SuiteRun after = regression::run_suite(suite, {}, load_default, 1);
    CHECK(after.report.cases[3].equal);
    CHECK(after.report.cases[3].differences.front().reason == "faster on purpose");
    CHECK_FALSE(after.report.cases[1].equal);
    CHECK(regression::no_longer_occurring(after.report).empty());
    CHECK(report::comparison_text(after.report).find("no longer present") == std::string::npos);
    // Lines added elsewhere leave the fingerprint as it is.
    folder.write("new/p3.nc", "(A)\n(B)\n" + replaced(part_program, "F200.", "F210."));
    const regression::SuiteRun moved = regression::run_suite(suite, {}, load_default, 1);
    CHECK(moved.report.cases[3].equal);
    // When the difference is gone the suite is told so; in a merged report as well.
    folder.write("new/p3.nc", part_program);
    const regression::SuiteRun gone = regression::run_suite(suite, {}, load_default, 1);
    REQUIRE(regression::no_longer_occurring(gone.report).size() == 1);
    CHECK(regression::no_longer_occurring(gone.report)[0].reason == "faster on purpose");
    for (const char* format : {"text", "json", "sarif", "github", "html"}) {
        const std::string whole =
            report::format_comparison(gone.report, report::report_format(format));
        CHECK(whole.find("faster on purpose") != std::string::npos);
        std::vector<report::ComparePart> parts;
        for (const int index : {2, 1}) {
            regression::SuiteRun run = regression::run_suite(suite, {index, 2}, load_default, 1);
            parts.push_back(report::parse_part(
                report::format_part({run.report, run.places, suite.cases.size()}), "part.json"));
        }
        CHECK(report::format_comparison(report::merge_parts(parts),
                                        report::report_format(format)) == whole);
    }
}

TEST_CASE("an interrupted suite keeps what is finished and says what is not", "[suite]") {
    const Folder folder;
    const regression::Suite suite = regression::read_suite(write_suite(folder), {});
    std::size_t finished = 0;
    const regression::SuiteWatch watch{[&](std::size_t done, std::size_t total) {
                                           finished = done;
                                           CHECK(total == 5);
                                       },
                                       [&] { return finished >= 2 ? "interrupted" : ""; }};
    const regression::SuiteRun run = regression::run_suite(suite, {}, load_default, 1, watch);
    CHECK(run.report.cases[0].equal);
    CHECK(run.report.cases[1].status == regression::CompareStatus::differs);
    CHECK(run.report.cases[2].verdict == "not compared: interrupted");
    CHECK(run.report.cases[4].status == regression::CompareStatus::limit);
    CHECK(regression::exit_code(run.report) == 4);
}

TEST_CASE("a golden holds a path as numbers and finds what moved", "[suite]") {
    const Folder folder;
    folder.write("new/p.nc", part_program);
    const std::string path = folder.write(
        "suite.toml",
        "schema = \"trunnion.suite/1\"\n[[case]]\nname = \"p\"\nprogram = \"new/p.nc\"\n");
    const regression::Suite suite = regression::read_suite(path, {});
    CHECK(regression::exit_code(regression::run_suite(suite, {}, load_default, 1).report) ==
          1);  // none yet
    const auto written = regression::updated_goldens(suite, "first", load_default);
    REQUIRE(written.size() == 1);
    const std::string& text = written.begin()->second;
    fs::create_directories(folder.path / "goldens");
    std::ofstream(written.begin()->first) << text;
    CHECK(regression::exit_code(regression::run_suite(suite, {}, load_default, 1).report) == 0);
    CHECK(regression::updated_goldens(suite, "again", load_default).empty());
    CHECK(regression::format_golden(regression::parse_golden(text, "g").path, {"first"}) ==
          text);  // a fixpoint
    folder.write("new/p.nc", replaced(part_program, "Z-1. ", "Z-1.02 "));
    const regression::SuiteRun run = regression::run_suite(suite, {}, load_default, 1);
    CHECK(regression::exit_code(run.report) == 1);
    REQUIRE_FALSE(run.report.cases[0].differences.empty());
    CHECK(run.report.cases[0].differences.front().b.line == line_with(part_program, "Z-1."));
    const auto again = regression::updated_goldens(suite, "second", load_default);
    REQUIRE(again.size() == 1);
    CHECK(again.begin()->second.find("# reason = second\n# reason = first\n") != std::string::npos);
}

TEST_CASE("the environment of arrays, indexed jobs and MPI names the shard", "[suite]") {
    struct Row {
        std::vector<std::pair<const char*, const char*>> environment;
        const char* text;
        int index, count;
    };
    const Row row = GENERATE(values<Row>({
        {{{"SLURM_ARRAY_TASK_ID", "7"},
          {"SLURM_ARRAY_TASK_MIN", "3"},
          {"SLURM_ARRAY_TASK_STEP", "2"},
          {"SLURM_ARRAY_TASK_COUNT", "4"}},
         "env",
         3,
         4},
        {{{"JOB_COMPLETION_INDEX", "0"}}, "/8", 1, 8},
        {{{"OMPI_COMM_WORLD_RANK", "5"}, {"OMPI_COMM_WORLD_SIZE", "6"}}, "env", 6, 6},
        {{{"PMI_RANK", "1"}, {"PMI_SIZE", "2"}}, "env", 2, 2},
        {{}, "2/5", 2, 5},
    }));
    for (const auto& [name, value] : row.environment) ::setenv(name, value, 1);
    const regression::Shard shard = regression::parse_shard(row.text);
    for (const auto& [name, value] : row.environment) ::unsetenv(name);
    CHECK(shard.index == row.index);
    CHECK(shard.count == row.count);
    for (const char* bad : {"0/3", "4/3", "x", "1/", "env", "/0"})
        CHECK_THROWS_AS(regression::parse_shard(bad), InputError);
}
