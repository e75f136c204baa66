// One block of a program is many blocks of the other, and one of these is off: the distance is that
// of the paths, not of the corners.
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/regression/programs.h"

using namespace trunnion;
using namespace trunnion::testing;

namespace {

std::string program_of(const std::string& cut) {
    return "O1\nG90 G54 G17 G21 G40\nT1 M6\nG0 G43 H1 Z50. S3000 M3\nX0. Y0.\nG1 Z-5. F200.\n"
           "F300.\n" +
           cut + "G0 Z50.\nM30\n";
}

/// A half circle of radius 10 about (10, 0) in 180 chords; the point at 90 degrees is `off_mm`
/// outside.
std::string chords(double off_mm) {
    std::string text;
    for (int k = 1; k <= 180; ++k) {
        const double angle = 3.14159265358979 * (1.0 - k / 180.0);
        const double radius_mm = 10.0 + (k == 90 ? off_mm : 0.0);
        text += "G1 X" + std::to_string(10.0 + radius_mm * std::cos(angle)) + " Y" +
                std::to_string(radius_mm * std::sin(angle)) + "\n";
    }
    return text;
}

}  // namespace

TEST_CASE("a point off one long line is as far away as it is", "[compare]") {
    const std::string whole = program_of("G1 X100.\n");
    for (const double off_mm : {0.02, 0.2}) {
        const std::string off = std::to_string(off_mm);
        for (const std::string& cut :
             {"G1 X25.\nX50. Y" + off + "\nX75. Y0.\nX100.\n", "G1 X50. Y" + off + "\nX100. Y0.\n",
              "G1 X50. Y" + off + "\nX75. Y0.\nX100.\n",
              "G1 X25.\nX50. Y" + off + "\nX100. Y0.\n"}) {
            INFO(cut);
            const auto ab = compare_texts(whole, program_of(cut), bc_table());
            CHECK_FALSE(ab.equal);
            CHECK(ab.position_mm == Approx(off_mm).margin(1e-6));
            CHECK(compare_texts(program_of(cut), whole, bc_table()).position_mm ==
                  Approx(off_mm).margin(1e-6));
        }
    }
}

TEST_CASE("a point off an arc in chords is as far away as it is", "[compare]") {
    const std::string arc = program_of("G2 X20. Y0. I10. J0.\n");
    CHECK(compare_texts(arc, program_of(chords(0.0)), bc_table()).equal);
    for (const double off_mm : {0.03, 0.2, 1.0}) {
        const auto r = compare_texts(arc, program_of(chords(off_mm)), bc_table());
        INFO(r.verdict);
        CHECK_FALSE(r.equal);
        CHECK(r.position_mm == Approx(off_mm).margin(0.002));
    }
}
