// Errors in free form as tables, and as data of a pitch error compensation.
#include "report/error_table.h"

#include <catch2/catch.hpp>
#include <cmath>

namespace trunnion {
namespace {

diagnosis::Cause waved(bool travel) {
    diagnosis::Cause cause;
    cause.effect = "X.positioning";
    cause.probability = 0.5;
    for (int k = 0; k <= 20; ++k) {
        const double at = -200.0 + 20.0 * k;
        const double error_mm = 0.006 * std::sin(at / 40.0);
        cause.points.push_back({"EXX", at, error_mm, 2e-4, "mm", "mm"});
        if (travel) {
            cause.beyond.axis = "X";
            cause.beyond.at.push_back(at);
            cause.beyond.too_far.push_back(error_mm);
        }
    }
    return cause;
}

}  // namespace

TEST_CASE("pitch error data take the error away within half a unit at every place", "[report]") {
    const diagnosis::Cause cause = waved(true);
    const auto data = report::pitch_error_data(cause);
    REQUIRE(data);
    CHECK(data->first == -200.0);
    CHECK(data->interval == Approx(20.0));
    REQUIRE(data->value.size() == 20);
    double added = 0.0;
    for (std::size_t k = 0; k < data->value.size(); ++k) {
        added += data->unit * data->value[k];
        const double rest = cause.points[k + 1].value - cause.points[0].value + added;
        CHECK(std::abs(rest) <= 0.5 * data->unit + 1e-12);
    }
    CHECK_FALSE(report::pitch_error_data(waved(false)));
    CHECK_FALSE(report::pitch_error_data({}));
}

TEST_CASE("nothing is typed into a control for a cause that is not claimed", "[report]") {
    diagnosis::Cause cause = waved(true);
    cause.probability = 0.49;
    CHECK_FALSE(report::pitch_error_data(cause));
    CHECK(report::error_table(cause).find("no pitch error data: the cause is not claimed") !=
          std::string::npos);
}

TEST_CASE("a table of the measured places only is no data of a compensation", "[report]") {
    diagnosis::Cause cause = waved(true);
    cause.holds_between = false;
    CHECK_FALSE(report::pitch_error_data(cause));
    const std::string text = report::error_table(cause);
    CHECK(text.find("pitch error data, from") == std::string::npos);
    CHECK(text.find("no pitch error data: a control interpolates") != std::string::npos);
    cause = waved(false);  // of a straightness none are expected
    cause.holds_between = false;
    CHECK(report::error_table(cause).find("pitch") == std::string::npos);
}

TEST_CASE("a free form prints every place with its sigma", "[report]") {
    const std::string text = report::error_table(waved(true));
    CHECK(text.find("EXX: at mm, error µm, sigma") != std::string::npos);
    CHECK(text.find("-200.0000") != std::string::npos);
    CHECK(text.find("pitch error data") != std::string::npos);
    // In a figure: it scrolls by itself on a phone.
    CHECK(report::error_curves(waved(true)).find("<figure>\n<div class=\"scroll\"") == 0);
    CHECK(report::error_table({}).empty());
}

}  // namespace trunnion
