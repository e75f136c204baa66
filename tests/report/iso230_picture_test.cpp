// The picture of a positioning test shows every reading and the figures that the readings give.
#include "report/iso230_picture.h"

#include <catch2/catch.hpp>

namespace trunnion {
namespace {

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t n = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
        ++n;
    return n;
}

std::vector<records::DeviationPoint> runs(int number, bool both) {
    std::vector<records::DeviationPoint> points;
    for (int run = 0; run < number; ++run)
        for (int k = 0; k <= 5; ++k) {
            points.push_back({40.0 * k, 1, 1e-3 * (k + 0.2 * run)});
            if (both) points.push_back({40.0 * k, -1, 1e-3 * (k - 4.0 + 0.2 * run)});
        }
    return points;
}

}  // namespace

TEST_CASE("both ways with repeats: B, M, E and A stand in the picture", "[report]") {
    const std::string svg = report::iso230_2_picture("X", runs(3, true), false);
    for (const char* name : {">B<", ">M<", ">E<", ">A<"}) CHECK_THAT(svg, Catch::Contains(name));
    CHECK_THAT(svg, Catch::Contains("ISO 230-2: B 4.00") && Catch::Contains("deviation / µm"));
    CHECK(count(svg, "<polyline") >= 3);
    CHECK(count(svg, "nan") == 0);
}

TEST_CASE("one run one way: what it cannot give is not drawn", "[report]") {
    const std::string svg = report::iso230_2_picture("C", runs(1, false), true);
    for (const char* name : {">B<", ">M<", ">A<"}) CHECK_THAT(svg, !Catch::Contains(name));
    CHECK_THAT(svg, Catch::Contains("deviation / arcsec") && Catch::Contains("target / deg"));
    CHECK(count(svg, "nan") == 0);
    CHECK(count(svg, "inf") == 0);
}

}  // namespace trunnion
