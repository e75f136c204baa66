#include "base/rounded.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "base/numbers.h"
#include "base/random.h"
#include "base/units.h"

using namespace trunnion;

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

int significant_digits(std::string text) {
    std::erase_if(text, [](char c) { return c == '.' || c == '-'; });
    text.erase(0, text.find_first_not_of('0'));
    return static_cast<int>(text.size());
}

}  // namespace

TEST_CASE("a value has the digits that its sigma allows") {
    CHECK(with_sigma(-8.35649, 0.0574) == "-8.356 ± 0.057");
    CHECK(with_sigma(40.1284, 0.6612) == "40.13 ± 0.66");
    CHECK(with_sigma(123.4, 12.3) == "123 ± 12");
    CHECK(with_sigma(51234.0, 1234.0) == "51200 ± 1200");
    CHECK(with_sigma(0.02, 6.6e-6) == "0.0200000 ± 0.0000066");
    CHECK(with_sigma(-0.0001, 0.5) == "0.00 ± 0.50");
    CHECK(with_sigma(1.0, 0.0996) == "1.00 ± 0.10");
    CHECK(with_sigma(1.0, 9.96) == "1 ± 10");
    CHECK(with_sigma(1.0, 0.0) == "1.000 ± 0.000");
    CHECK(with_sigma(0.0123456, none) == "0.0123");
    CHECK(rounded(none, none).value == "–");
    CHECK(rounded(1.0, none).sigma == "–");
}

TEST_CASE("tens and hundreds are rounded, halves away from zero") {
    CHECK(decimal(1250.0, -2) == "1300");
    CHECK(decimal(-1250.0, -2) == "-1300");
    CHECK(decimal(1249.0, -2) == "1200");
    CHECK(decimal(-1234.0, -2) == "-1200");
    CHECK(decimal(4.9, -1) == "0");
    CHECK(decimal(2.5, 0) == "2");  // fmt: halves to even, as printf
    CHECK(decimal(-0.4, 0) == "0");
}

TEST_CASE("without a sigma: three significant digits, no exponent") {
    CHECK(three_digits(4.155531e-05) == "0.0000416");
    CHECK(three_digits(421.72) == "422");
    CHECK(percent(-0.003) == "0");
    CHECK(percent(0.966) == "97");
    CHECK(percent(-0.75) == "-75");
    // What is not certain is not shown as certain.
    CHECK(probability_words(0.833) == "0.83");
    CHECK(probability_words(0.9949) == "0.99");
    CHECK(probability_words(0.9951) == "> 0.99");
    CHECK(probability_words(1.0) == "> 0.99");
    CHECK(probability_words(0.0051) == "0.01");
    CHECK(probability_words(0.0049) == "< 0.01");
    CHECK(three_digits(-12.345) == "-12.3");
    CHECK(three_digits(9.996) == "10.0");
    CHECK(three_digits(999.6) == "1000");
    CHECK(three_digits(743509.2) == "743509");
    CHECK(three_digits(0.0) == "0");
    CHECK(three_digits(-0.0) == "0");
    CHECK(three_digits(4e-5, 3) == "0");
    CHECK(three_digits(none) == "–");
}

TEST_CASE("what is printed is within half of its last digit, over twelve decades") {
    for (double value = 1.2345678e-8; value < 1e4; value *= 1.37)
        for (const double sign : {1.0, -1.0}) {
            const std::string text = three_digits(sign * value);
            INFO(value << " " << text);
            CHECK(text.find('e') == std::string::npos);
            if (value > 1.1e-7 && value < 999.0) CHECK(significant_digits(text) == 3);
            const double last = std::pow(10.0, std::floor(std::log10(value)) - 2.0);
            CHECK(std::abs(*parse_number(text) - sign * value) <=
                  0.5000001 * std::max(std::min(last, 1.0), 1e-9));
        }
}

TEST_CASE("sizes and units in words") {
    CHECK(length_words(0.5024) == "0.502 µm");
    CHECK(length_words(0.00004) == "0 µm");
    CHECK(length_words(421.72) == "422 µm");
    CHECK(length_words(32715.725) == "32.7 mm");
    CHECK(length_words(1000.0) == "1.00 mm");
    CHECK(angle_words(421.72) == "422 µrad");
    CHECK(angle_words(1000.0) == "1.00 mrad");
    CHECK(shown_unit("um") == "µm");
    CHECK(shown_unit("um/m") == "µm/m");
    CHECK(shown_unit("urad") == "µrad");
    CHECK(shown_unit("umbra") == "umbra");
    CHECK(shown_unit("ms") == "ms");
}

TEST_CASE("a number may have one sign and blanks around it") {
    CHECK(parse_number("+5") == 5.0);
    CHECK(parse_number(" -5.5\t") == -5.5);
    for (const char* text : {"", "+", "+-5", "-+5", "++5", "5 5", "5x"})
        CHECK_FALSE(parse_number(text));
}

TEST_CASE("an angle in degrees reads back as the same angle, in the fewest digits") {
    CHECK(shortest_degrees(rad_from_deg(12.5)) == "12.5");
    CHECK(shortest_degrees(rad_from_deg(-0.25)) == "-0.25");
    SeededNoise random(3);
    for (int k = 0; k < 400; ++k) {
        const double angle_rad = random.uniform();
        const std::string shown = shortest_degrees(angle_rad);
        const auto read = parse_number(shown);
        REQUIRE(read);
        CHECK(rad_from_deg(*read) == Approx(angle_rad).epsilon(1e-15));
        // Of texts of one length: that of the computed degrees, if it is one of them.
        const double plain = deg_from_rad(angle_rad);
        if (rad_from_deg(plain) == angle_rad && shown.size() == shortest(plain).size())
            CHECK(shown == shortest(plain));
        double other = plain * (1.0 - 1e-15);
        for (int ulp = 0; ulp < 20; ++ulp, other = std::nextafter(other, 1e3))
            if (rad_from_deg(other) == angle_rad) CHECK(shown.size() <= shortest(other).size());
    }
}
