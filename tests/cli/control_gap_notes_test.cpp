// diagnose --program: what it says of a log's columns, on the terminal and on the page.
#include "tests/cli/control_gap_bench.h"

using namespace trunnion::control_gap_bench;  // NOLINT(google-build-using-namespace)

namespace {

/// Straight lines with the positions by hand: every 0.5 mm, in machine coordinates of G54 at 0.
const std::string square = R"(N10 G90 G21 G17 G54
N20 G1 X30. Y0. Z0. F500.
N30 X30. Y20.
N40 X12. Y20.
N50 X12. Y4. Z-6.
N60 X0. Y0. Z0.
N70 M30
)";
const double corners[6][3] = {{0, 0, 0},   {30, 0, 0},  {30, 20, 0},
                              {12, 20, 0}, {12, 4, -6}, {0, 0, 0}};

/// Samples with the block number of each, in the given order of the columns' values.
std::string square_log(const std::string& head, const std::array<int, 3>& order) {
    std::string out = head;
    for (int k = 1; k < 6; ++k)
        for (int part = 1; part <= 40; ++part) {
            out += "N" + std::to_string(10 * (k + 1));
            for (const int axis : order)
                out += "," + std::to_string(corners[k - 1][axis] +
                                            (corners[k][axis] - corners[k - 1][axis]) * part / 40);
            out += "\n";
        }
    return out;
}

void ask(const Bench& bench, const std::string& log) {
    Control here;
    here.g54 = "X = 0.0";
    bench.write("here.toml", here.text());
    bench.write("part.nc", square);
    bench.write("log.csv", log);
    REQUIRE(bench.trunnion("diagnose " + bench.file("log.csv") + " --program " +
                           bench.file("part.nc") + " --setup " + bench.file("here.toml") +
                           " --html " + bench.file("gap.html")) == 0);
}

}  // namespace

TEST_CASE("diagnose --program: exchanged columns are told, on the terminal and on the page") {
    const Bench bench;
    ask(bench, square_log("N,y_mm,x_mm,z_mm\n", {1, 0, 2}));
    CHECK_THAT(bench.read("out.txt"), Catch::Contains("verdict: no-gap"));
    CHECK_THAT(bench.read("err.txt"), !Catch::Contains("exchanged"));
    ask(bench, square_log("N,x_mm,y_mm,z_mm\n", {1, 0, 2}));
    for (const char* out : {"err.txt", "gap.html"})
        CHECK_THAT(bench.read(out), Catch::Contains("the log agrees if X and Y are exchanged"));
    CHECK_THAT(bench.read("out.txt"), !Catch::Contains("verdict: explained"));
    ask(bench, square_log("N,x_mm,y_mm,z_mm\n", {0, 2, 1}));
    CHECK_THAT(bench.read("err.txt"), Catch::Contains("the log agrees if Y and Z are exchanged"));
}

TEST_CASE("diagnose --program: the page has the notes on sampling and numbers of blocks") {
    const Bench bench;
    ask(bench, square_log("N,x_mm,y_mm,z_mm\n", {0, 1, 2}));
    const std::string page = bench.read("gap.html");
    CHECK_THAT(page, Catch::Contains("Notes") &&
                         Catch::Contains("the numbers of blocks are N numbers of the program") &&
                         Catch::Contains("out and back between two samples"));
}

TEST_CASE("diagnose --program: a column that nobody reads is told, those of a trace are not") {
    const Bench bench;
    const std::string plain = square_log("N,x_mm,y_mm,z_mm\n", {0, 1, 2});
    std::string more = "N,x_mm,y_mm,z_mm,quill\n";
    std::istringstream lines(plain);
    std::string line;
    std::getline(lines, line);
    while (std::getline(lines, line)) more += line + ",1.25\n";
    ask(bench, more);
    CHECK_THAT(bench.read("err.txt"), Catch::Contains("columns that are not read: quill"));
    ask(bench, plain);
    CHECK_THAT(bench.read("err.txt"), !Catch::Contains("not read"));
    bench.asked(mill, {}, {}, " --trace-step 1");
    CHECK_THAT(bench.read("err.txt"), !Catch::Contains("not read"));
}

TEST_CASE("diagnose --program refuses a file that is no program") {
    const Bench bench;
    bench.asked(mill, {}, {});
    const std::string bytes("MZ\0\1\2\3", 6);
    for (const std::string& file : {bench.read("log.csv"), bench.read("here.toml"), bytes}) {
        bench.write("part.nc", file);
        CHECK(bench.trunnion("diagnose " + bench.file("log.csv") + " --program " +
                             bench.file("part.nc") + " --setup " + bench.file("here.toml")) == 2);
        CHECK_THAT(bench.read("err.txt"), Catch::Contains("is no NC program"));
        CHECK(bench.read("out.txt").empty());
    }
}
