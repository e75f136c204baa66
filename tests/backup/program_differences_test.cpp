// Where two versions of a program differ: the count is the fewest lines out and in.
#include "backup/program_differences.h"

#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>

#include "base/random.h"

using namespace trunnion;

namespace {

using Lines = std::vector<backup::ProgramLine>;

Lines random_lines(SeededNoise& random, std::size_t most) {
    Lines out(random.bits() % most);
    for (backup::ProgramLine& line : out)
        line.text = line.key = "G" + std::to_string(random.bits() % 4);
    return out;
}

/// Longest common subsequence by its definition.
std::size_t common(const Lines& a, const Lines& b) {
    std::vector<std::vector<std::size_t>> best(a.size() + 1,
                                               std::vector<std::size_t>(b.size() + 1));
    for (std::size_t i = 1; i <= a.size(); ++i)
        for (std::size_t j = 1; j <= b.size(); ++j)
            best[i][j] = a[i - 1] == b[j - 1] ? best[i - 1][j - 1] + 1
                                              : std::max(best[i - 1][j], best[i][j - 1]);
    return best[a.size()][b.size()];
}

}  // namespace

TEST_CASE("the count of a difference is that of the longest common lines") {
    SeededNoise random(5);
    int differ = 0;
    for (int round = 0; round < 500; ++round) {
        const Lines a = random_lines(random, 40), b = random_lines(random, 40);
        if (a == b) continue;
        ++differ;
        const std::size_t same = common(a, b), out = a.size() - same;
        CHECK_THAT(backup::line_difference(a, b),
                   Catch::StartsWith(fmt::format("{} line{} out, {} in; first at line ", out,
                                                 out == 1 ? "" : "s", b.size() - same)));
    }
    CHECK(differ > 400);
}

TEST_CASE("programs are known by their number, however it is written, and no line is lost") {
    backup::ControlBackup b;
    b.files["ALL-PROG.TXT"] = "%(ID)\nG4\nO1(A)\nG0\n:0002\nG1\n<CUP>\nG2\n:12345\nG3\n%";
    b.files["ALL-FLDR.TXT"] = "%\n&F=/MTB1/\nO0001\nM99\nO0\nM98\n%";
    std::string names;
    std::size_t lines = 0;
    for (const auto& [key, program] : backup::programs_of(b)) {
        names += key.second + " ";
        lines += program.size();
    }
    CHECK(names == "/MTB1/O0000 /MTB1/O0001  <CUP> O0001 O0002 O12345 ");
    CHECK(lines == 13);
}

TEST_CASE("a difference shows its first line short and without control characters") {
    const auto text = [](const std::string& a, const std::string& b) {
        return backup::line_difference(backup::lines_of(a), backup::lines_of(b));
    };
    CHECK(text("A\nB", "A\nB\nC\nD") == "0 lines out, 2 in; first at line 3: (end) | C");
    CHECK(text("A\tB\r\n", "AB\n") == "blanks or line ends alone");
    CHECK(text("A\x1b[31m", std::string(70, 'B')) ==
          "1 line out, 1 in; first at line 1: A [31m | " + std::string(60, 'B') + "...");
    std::string a, b;
    for (int i = 0; i < 3000; ++i) a += fmt::format("A{}\n", i), b += fmt::format("B{}\n", i);
    CHECK(text(a, b) == "more than 2000 lines; first at line 1: A0 | B0");
}
