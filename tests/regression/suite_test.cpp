#include "regression/suite.h"

#include <fmt/format.h>
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
        {{{"JOB_COMPLETION_INDEX", "0"}}, "/1", 1, 1},
        {{{"OMPI_COMM_WORLD_RANK", "5"}, {"OMPI_COMM_WORLD_SIZE", "6"}}, "env", 6, 6},
        {{{"PMI_RANK", "1"}, {"PMI_SIZE", "2"}}, "env", 2, 2},
        {{}, "2/5", 2, 5},
        {{{"PMIX_RANK", "2"}, {"SLURM_NTASKS", "4"}}, "env", 3, 4},
        {{{"SLURM_ARRAY_TASK_ID", "4"}, {"SLURM_ARRAY_TASK_STEP", "0"}}, "/9", 4, 9},
        {{{"SLURM_ARRAY_TASK_ID", "x"}, {"PMI_RANK", "0"}, {"PMI_SIZE", "2"}}, "env", 1, 2},
    }));
    for (const auto& [name, value] : row.environment) ::setenv(name, value, 1);
    const regression::Shard shard = regression::parse_shard(row.text);
    for (const auto& [name, value] : row.environment) ::unsetenv(name);
    CHECK(shard.index == row.index);
    CHECK(shard.count == row.count);
    for (const char* bad : {"0/3", "4/3", "x", "1/", "env", "/0"})
        CHECK_THROWS_AS(regression::parse_shard(bad), InputError);
}

TEST_CASE("a shard of the environment counts only where that says how many", "[suite]") {
    using Variables = std::vector<std::pair<const char*, const char*>>;
    const auto with = [](const Variables& variables, const auto& asked) {
        for (const auto& [name, value] : variables) ::setenv(name, value, 1);
        const auto answer = asked();
        for (const auto& [name, value] : variables) ::unsetenv(name);
        return answer;
    };
    const auto found = [&](const Variables& variables) {
        return with(variables, [] {
            const auto shard = regression::shard_of_environment();
            return shard ? fmt::format("{}/{}", shard->index, shard->count) : "none";
        });
    };
    CHECK(found({}) == "none");
    CHECK(found({{"JOB_COMPLETION_INDEX", "0"}}) == "none");
    CHECK(found({{"PMI_RANK", "0"}, {"PMI_SIZE", "1"}}) == "none");
    CHECK(found({{"PMI_RANK", "0"}, {"PMI_SIZE", "2x"}}) == "none");
    CHECK(found({{"PMI_RANK", "1"}, {"PMI_SIZE", "3"}}) == "2/3");
    const auto refused = [&](const Variables& variables, const char* text) {
        return with(variables, [text]() -> std::string {
            try {
                regression::parse_shard(text);
            } catch (const InputError& error) {
                return error.what();
            }
            return "";
        });
    };
    CHECK_THAT(refused({{"JOB_COMPLETION_INDEX", "0"}}, "env"), Catch::Contains("how many"));
    CHECK_THAT(refused({{"PMI_RANK", "3"}, {"PMI_SIZE", "3"}}, "env"),
               Catch::Contains("4 of 3 is no shard"));
    CHECK_THAT(refused({}, "/3"), Catch::Contains("names no shard"));
    CHECK_THAT(refused({}, "1/2/3"), Catch::Contains("is no shard"));
}

TEST_CASE("a bad file, a missing side and an error outside of NC affect their own case",
          "[suite]") {
    const Folder folder;
    write_suite(folder);
    folder.write("old/only_a.nc", part_program);
    folder.write("new/only_b.nc", part_program);
    folder.write("goldens.csv", "no golden\n");
    regression::Suite suite = regression::suite_of_folders((folder.path / "old").string(),
                                                           (folder.path / "new").string(), {});
    REQUIRE(suite.cases.size() == 7);
    suite.cases[6].golden = (folder.path / "goldens.csv").string();
    suite.cases[6].b = suite.cases[5].b;
    const regression::SuiteRun run = regression::run_suite(suite, {}, load_default, 2);
    CHECK(run.report.cases[0].verdict.find("only in A: ") == 0);
    CHECK(run.report.cases[1].verdict.find("only in B: ") == 0);
    CHECK(run.report.cases[2].equal);
    CHECK(run.report.cases[6].status == regression::CompareStatus::bad_input);
    CHECK(run.report.cases[6].verdict.find("not a golden") != std::string::npos);
    CHECK(regression::exit_code(run.report) == 2);
    // What a progress display throws ends the run, from any thread.
    const regression::SuiteWatch watch{
        [](std::size_t, std::size_t) { throw std::runtime_error("no display"); }, {}};
    CHECK_THROWS_WITH(regression::run_suite(suite, {}, load_default, 2, watch), "no display");
}

TEST_CASE("all differences must be expected, in this case or in any, and none be left out",
          "[suite]") {
    const Folder folder;
    write_suite(folder);
    const std::string two = replaced(replaced(part_program, "F200.", "F210."), "X50.", "X50.1");
    folder.write("new/p3.nc", two);
    regression::Suite suite = regression::read_suite((folder.path / "suite.toml").string(), {});
    const auto run = [&] { return regression::run_suite(suite, {}, load_default, 1).report; };
    const regression::CompareReport before = run();
    std::vector<std::string> prints;
    for (const regression::Difference& d : before.cases[3].differences)
        prints.push_back(d.fingerprint);
    REQUIRE(prints.size() >= 2);
    suite.expected.push_back({"", prints[0], "anywhere"});
    CHECK_FALSE(run().cases[3].equal);
    for (std::size_t k = 1; k < prints.size(); ++k)
        suite.expected.push_back({"new/p3", prints[k], "here"});
    CHECK(run().cases[3].equal);
    CHECK(run().cases[3].verdict ==
          fmt::format("equal but for {} expected differences", prints.size()));
    suite.expected.back().case_name = "new/p2";
    CHECK_FALSE(run().cases[3].equal);
    suite.expected.back().case_name = "new/p3";
    suite.cases[3].options.most_differences = 1;
    CHECK_FALSE(run().cases[3].equal);
}

TEST_CASE("no golden is written of a program that stops, nor of a case without one", "[suite]") {
    const Folder folder;
    write_suite(folder);
    folder.write("new/p.nc", replaced(part_program, "X50.", "X5000."));
    const std::string head = "schema = \"trunnion.suite/1\"\n[[case]]\n";
    regression::Suite suite =
        regression::read_suite(folder.write("s.toml", head + "program = \"new/p.nc\"\n"), {});
    CHECK_THROWS_AS(regression::updated_goldens(suite, "r", load_default), Alarm);
    suite.cases[0].options.max_blocks = 5;
    CHECK_THROWS_AS(regression::updated_goldens(suite, "r", load_default), InputError);
    CHECK(regression::updated_goldens(
              regression::read_suite((folder.path / "suite.toml").string(), {}), "r", load_default)
              .empty());
}

TEST_CASE("the gravest of several cases is the verdict of all", "[suite]") {
    using regression::CompareStatus;
    regression::CompareReport report;
    report.single = false;
    const auto add = [&](CompareStatus status) {
        regression::Comparison c;
        c.status = status;
        c.equal = status == CompareStatus::equal;
        report.cases.push_back(c);
        return regression::exit_code(report);
    };
    CHECK(add(CompareStatus::equal) == 0);
    CHECK(verdict_of(report) == "equal: all 1 programs");
    CHECK(add(CompareStatus::differs) == 1);
    CHECK(add(CompareStatus::limit) == 4);
    CHECK(add(CompareStatus::alarm) == 3);
    CHECK(add(CompareStatus::bad_input) == 2);
    CHECK(verdict_of(report) == "differs: 4 of 5 programs");
    report.single = true;
    CHECK(verdict_of(report) == "differs: 4 of 5 programs");
    // What can no longer be seen is not called gone.
    report.expected = {{"", "print", "reason"}};
    CHECK(regression::no_longer_occurring(report).empty());
    report.cases.resize(2);
    CHECK(regression::no_longer_occurring(report).size() == 1);
    report.cases[1].differences.push_back({});
    report.cases[1].differences[0].fingerprint = "print";
    CHECK(regression::no_longer_occurring(report).size() == 1);  // it is not this suite's
    report.cases[1].differences[0].expected = true;
    CHECK(regression::no_longer_occurring(report).empty());
}

TEST_CASE("the order of gravity: not compared, alarm, missing, far, elsewhere, equal", "[suite]") {
    using regression::DifferenceKind;
    const auto gravity = [](DifferenceKind kind, double position_mm) {
        regression::Comparison c;
        c.equal = false;
        c.differences.push_back({});
        c.differences[0].kind = kind;
        c.differences[0].position_mm = position_mm;
        return regression::gravity_of(c);
    };
    regression::Comparison none;
    const double equal = regression::gravity_of(none);
    none.equal = false;
    const std::vector<double> falling{regression::gravity_of(none),
                                      gravity(DifferenceKind::alarm, 0.0),
                                      gravity(DifferenceKind::only_a, 5.0),
                                      gravity(DifferenceKind::only_b, 4.0),
                                      gravity(DifferenceKind::tool, 0.0),
                                      gravity(DifferenceKind::moved, 50.0),
                                      gravity(DifferenceKind::function, 0.0),
                                      gravity(DifferenceKind::path, 1.0),
                                      gravity(DifferenceKind::reordered, 0.0),
                                      equal};
    for (std::size_t k = 1; k < falling.size(); ++k) CHECK(falling[k - 1] > falling[k]);
}
