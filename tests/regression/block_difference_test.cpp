#include "regression/block_difference.h"

#include <catch2/catch.hpp>

using namespace trunnion;

namespace {

std::string words(const std::string& a, const std::string& b) {
    return regression::block_difference(a, b, {}).words;
}

}  // namespace

TEST_CASE("what stands in a comment is no word of a block") {
    CHECK(words("G1 X45. (X1 Y2)", "G1 X54.").find("X54. instead of X45.") == 0);
    CHECK(words("G1 X45. (X1 Y2)", "G1 X45. (X9)").empty());
    CHECK(words("(T3 FACE) G1 X45.", "(T4 BORE) G1 X54.").find("X54. instead of X45.") == 0);
    CHECK(words("G1 X45. Y1.", "G1 X45. Y1.").empty());
}
