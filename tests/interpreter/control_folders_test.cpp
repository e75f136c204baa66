// Which of several programs of one number is called in a file with the folders of a control.
#include <catch2/catch.hpp>

#include "interpreter/program_files.h"

using namespace trunnion::interpreter;

namespace {

struct Bench {
    explicit Bench(const std::string& text) : text_(text), files(none_) {
        files.open({"ALL-PROG.TXT", text_, nullptr});
    }
    /// The first line of the program that a caller with this number gets, 0: none.
    int line_of(int number, int caller = 0) {
        Section* const near = caller ? files.find(caller, nullptr) : nullptr;
        const Section* const found = files.find(number, near);
        return found ? found->begin.line : 0;
    }
    int line_of(const std::string& name, int caller) {
        const Section* const found = files.find(name, *files.find(caller, nullptr));
        return found ? found->begin.line : 0;
    }

  private:
    std::string text_;
    ProgramsInMemory none_;

  public:
    ProgramFiles files;
};

}  // namespace

TEST_CASE("the folder of the caller comes first, then PATH1, LIBRARY, MTB2, MTB1, SYSTEM, others") {
    Bench bench(
        "%\n"                                                            // 1
        "&F=/OTHER/\nO3\nM99\nO8\nM99\n"                                 // 2: O3 3, O8 5
        "&F=/SYSTEM/\nO4\nM99\nO3\nM99\n"                                // 7: O4 8, O3 10
        "&F=/MTB1/\nO2\nM99\nO20\nM98P2\nM99\nO5\nM99\n"                 // 12: O2 13, O20 15, O5 18
        "&F=/MTB2/\nO2\nM99\nO5\nM99\nO4\nM99\n"                         // 20: O2 21, O5 23, O4 25
        "&F=/USER/LIBRARY/\nO6\nM99\nO5\nM99\n"                          // 27: O6 28, O5 30
        "&F=//CNC_MEM/USER/PATH1/ \nO1\nM98P2\nM30\nO2\nM99\nO6\nM99\n"  // 32: O1 33, O2 36, O6 38
        "%\n");
    CHECK(bench.line_of(2, 1) == 36);
    CHECK(bench.line_of(2, 20) == 13);
    CHECK(bench.line_of(2) == 36);
    CHECK(bench.line_of(6, 20) == 38);
    CHECK(bench.line_of(5, 1) == 30);
    CHECK(bench.line_of(4, 1) == 25);
    CHECK(bench.line_of(3, 1) == 10);
    CHECK(bench.line_of(8, 1) == 5);
    CHECK(bench.line_of(9, 1) == 0);
}

TEST_CASE("names follow the same order, and the first of one folder counts") {
    Bench bench(
        "&F=/MTB1/\n<A>\nM99\nO20\nM99\n"       // <A> 2
        "&F=/USER/PATH1/\nO1\nM99\n<A>\nM99\n"  // O1 7, <A> 9
        "<A>\nM99\n<O0005>\nM99\nO5\nM99\n");   // <A> 11, <O0005> 13, O5 15
    CHECK(bench.line_of("A", 1) == 9);
    CHECK(bench.line_of("A", 20) == 2);
    CHECK(bench.line_of("B", 1) == 0);
    CHECK(bench.line_of(5, 1) == 13);
    CHECK(bench.line_of("O5", 1) == 13);
    CHECK(bench.line_of("O20", 1) == 4);
}

TEST_CASE("without folders the first program of a number counts") {
    Bench bench("O1\nM30\nO2\nM99\nO2\nM99\n");
    CHECK(bench.line_of(2, 1) == 3);
}
