// What a suite file and two folders are read as, and what is refused.
#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "base/alarm.h"
#include "base/units.h"
#include "regression/suite.h"

namespace trunnion {
namespace {

namespace fs = std::filesystem;

class Folder {
  public:
    Folder() {
        for (const char* part : {"a/sub", "b", "empty"}) fs::create_directories(path / part);
        for (const char* program :
             {"a/p1.nc", "a/p2.NC", "a/p10.txt", "a/O1234", "a/O12x", "a/O", "a/O-1", "a/o79",
              "a/P77", "a/sub/q.tap", "a/note.md", "b/p1.nc", "b/new.cnc"})
            std::ofstream(path / program) << "M30\n";
    }
    ~Folder() { fs::remove_all(path); }
    std::string at(const std::string& name) const { return (path / name).generic_string(); }

    regression::Suite read(const std::string& body) const {
        const std::string file = at("suite.toml");
        std::ofstream(file) << "schema = \"trunnion.suite/1\"\n" + body;
        return regression::read_suite(file, {});
    }
    /// What the message of the refusal says.
    std::string refusal(const std::string& body) const {
        try {
            read(body);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    }

    fs::path path =
        fs::temp_directory_path() / ("trunnion_suite_file_" + std::to_string(::getpid()));
};

std::vector<std::string> names_of(const regression::Suite& suite) {
    std::vector<std::string> names;
    for (const regression::SuiteCase& c : suite.cases) names.push_back(c.name);
    return names;
}

using Names = std::vector<std::string>;

}  // namespace

TEST_CASE("a case is compared with a program or with a golden", "[suite]") {
    const Folder folder;
    const std::string common = "goldens = \"g\"\n", against = "against = \"b/p1.nc\"\n",
                      one = "[[case]]\nprogram = \"a/p1.nc\"\n";
    CHECK(folder.read(common + one + against).cases.front().golden.empty());
    CHECK(folder.read(common + one).cases.front().golden == folder.at("g/a/p1.csv"));
    CHECK(folder.read(common + one + "goldens = \"h\"\n").cases.front().golden ==
          folder.at("h/a/p1.csv"));
    CHECK_THAT(folder.refusal(one + against + "goldens = \"h\"\n"),
               Catch::Contains("either against or goldens"));
}

TEST_CASE("programs of a folder: known endings in any case, and O with digits", "[suite]") {
    const Folder folder;
    CHECK(regression::programs_below(folder.at("a")) ==
          std::set<std::string>{"O1234", "o79", "p1.nc", "p10.txt", "p2.NC", "sub/q.tap"});
    CHECK(regression::programs_below(folder.at("empty")).empty());
    CHECK_THROWS_AS(regression::programs_below(folder.at("none")), InputError);
}

TEST_CASE("two folders are a suite of all their programs, on one side or both", "[suite]") {
    const Folder folder;
    const regression::Suite suite =
        regression::suite_of_folders(folder.at("a"), folder.at("b"), {});
    CHECK(names_of(suite) ==
          Names{"O1234", "new.cnc", "o79", "p1.nc", "p10.txt", "p2.NC", "sub/q.tap"});
    CHECK(suite.cases[1].a.empty());
    CHECK(suite.cases[1].b == folder.at("b/new.cnc"));
    CHECK(suite.cases[3].a == folder.at("a/p1.nc"));
    CHECK(suite.cases[4].b.empty());
    CHECK_THROWS_AS(regression::suite_of_folders(folder.at("empty"), folder.at("empty"), {}),
                    InputError);
}

TEST_CASE("patterns of a suite match names of one folder", "[suite]") {
    const Folder folder;
    const auto matched = [&](const std::string& pattern) {
        return names_of(folder.read("[[case]]\nprogram = \"" + pattern + "\"\n"));
    };
    CHECK(matched("a/p?.nc") == Names{"a/p1"});
    CHECK(matched("a/p*.*") == Names{"a/p1", "a/p10", "a/p2"});
    CHECK(matched("a/*1*0*t") == Names{"a/p10"});
    CHECK(matched("a/O*") == Names{"a/O", "a/O-1", "a/O1234", "a/O12x"});
    CHECK(matched("a/gone.nc") == Names{"a/gone"});
    for (const char* none : {"a/x*", "a/p1.nc?", "gone/*.nc", "*/p1.nc"})
        CHECK_THAT(folder.refusal(std::string("[[case]]\nprogram = \"") + none + "\"\n"),
                   Catch::Contains("no program matches"));
}

TEST_CASE("a suite in the working folder finds programs beside it", "[suite]") {
    const Folder folder;
    std::ofstream(folder.at("suite.toml"))
        << "schema = \"trunnion.suite/1\"\n[[case]]\nprogram = [\"*.txt\", \"a/p1.nc\"]\n";
    std::ofstream(folder.at("beside.txt")) << "M30\n";
    std::ofstream(folder.at("[x].txt")) << "M30\n";
    const fs::path before = fs::current_path();
    fs::current_path(folder.path);
    const regression::Suite suite = regression::read_suite("suite.toml", {});
    fs::current_path(before);
    CHECK(names_of(suite) == Names{"[x]", "beside", "a/p1"});
    CHECK(suite.cases[1].b == "beside.txt");
}

TEST_CASE("options stand at the top for all cases and in a case for it alone", "[suite]") {
    const Folder folder;
    const regression::Suite suite = folder.read(
        "tol_lin_mm = 0.02\ntol_ang_deg = 1.0\ntol_feed = 0.2\ntol_time = 0.3\n"
        "goldens = \"gold\"\nprograms_folders = \"lib\"\nsetups = [\"s/m1.toml\", \"s/m2.toml\"]\n"
        "[[case]]\nprogram = [\"a/p1.nc\", \"a/p2.NC\"]\n"
        "[[case]]\nprogram = \"a/p10.txt\"\nname = \"ten\"\nsetups = \"s/m3.toml\"\n"
        "setup_b = \"s/m4.toml\"\ntol_lin_mm = 0.5\ndevices = true\ncall = \"O1\"\n"
        "against = \"b\"\n[[case]]\nprogram = \"a/O1234\"\nagainst = \"b/p1.nc\"\n");
    CHECK(names_of(suite) ==
          Names{"a/p1@m1", "a/p1@m2", "a/p2@m1", "a/p2@m2", "ten", "a/O1234@m1", "a/O1234@m2"});
    const regression::SuiteCase &first = suite.cases[0], &ten = suite.cases[4];
    CHECK(first.options.tolerances.position_mm == 0.02);
    CHECK(first.options.tolerances.direction_rad == Approx(rad_from_deg(1.0)));
    CHECK(first.options.tolerances.feed_ratio == 0.2);
    CHECK(first.options.tolerances.time_ratio == 0.3);
    CHECK(first.options.program_folders == Names{folder.at("lib")});
    CHECK(first.golden == folder.at("gold/a/p1@m1.csv"));
    CHECK(first.setup == folder.at("s/m1.toml"));
    CHECK(first.setup_b == first.setup);
    CHECK_FALSE(first.options.devices);
    CHECK(ten.options.tolerances.position_mm == 0.5);
    CHECK(ten.options.tolerances.feed_ratio == 0.2);
    CHECK(ten.setup_b == folder.at("s/m4.toml"));
    CHECK(ten.options.devices);
    CHECK(ten.options.call == "O1");
    CHECK(ten.a == folder.at("b/p10.txt"));  // a folder: the program of the same name
    CHECK(ten.golden.empty());
    CHECK(suite.cases[5].a == folder.at("b/p1.nc"));
}

TEST_CASE("what a suite may not say is refused and named", "[suite]") {
    const Folder folder;
    const std::string one = "[[case]]\nprogram = \"a/p1.nc\"\n";
    const std::vector<std::pair<std::string, std::string>> refused{
        {"", "no [[case]]"},
        {"[[case]]\nname = \"x\"\n", "a case needs program"},
        {"tol_lin_mm = 0\n" + one, "tolerances are above 0"},
        {"tol_ang_deg = -1\n" + one, "tolerances are above 0"},
        {"by = \"taste\"\n" + one, "no such layer"},
        {"devices = 1\n" + one, "true or false"},
        {one + one, "two cases have the name 'a/p1'"},
        {one + "name = \"../x\"\n", "would lie outside its folder"},
        {one + "name = \"/x\"\n", "would lie outside its folder"},
        {one + "name = \"\"\n", "would lie outside its folder"},
        {one + "[[expected]]\ncase = \"a/p1\"\nreason = \"r\"\n", "needs its fingerprint"},
        {one + "[[expected]]\ncase = \"a/p1\"\nfingerprint = \"f\"\n", "needs a reason"},
        {one + "against = \"b\"\ngoldens = \"x\"\n", "goldens"},
        {one + "colour = 1\n", "colour"}};
    for (const auto& [body, message] : refused) {
        INFO(body);
        CHECK_THAT(folder.refusal(body), Catch::Contains(message));
    }
    try {
        folder.read(one + one);
    } catch (const InputError& error) {
        CHECK(error.where.line > 3);
        CHECK(error.line_text == "[[case]]");
    }
    for (const char* schema : {"", "schema = \"trunnion.suite/2\"\n"}) {
        std::ofstream(folder.at("other.toml")) << schema << one;
        CHECK_THROWS_AS(regression::read_suite(folder.at("other.toml"), {}), InputError);
    }
}

}  // namespace trunnion
