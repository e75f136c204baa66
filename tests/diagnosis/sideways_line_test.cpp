// A laser's straightness of one line: a bow of the guide and a bow of its roll, seen through the
// tool, are the same readings, and so are the slope of both. A line beside it tells.
#include <algorithm>
#include <catch2/catch.hpp>

#include "diagnosis/diagnosis.h"
#include "tests/support/campaign.h"
#include "tests/support/laser_lines.h"
#include "tests/support/said.h"

namespace trunnion {
namespace {

/// Y deviations along X, with Z at each of these heights.
records::ReadingTable sideways(const std::vector<double>& heights_mm) {
    records::ReadingTable table = laser_lines::empty_table();
    for (const double z_mm : heights_mm)
        laser_lines::add_runs(table, {"Z" + std::to_string(static_cast<int>(z_mm)), Axis::X, -200.0,
                                      20.0, 21, Vector3::UnitY(), z_mm});
    return table;
}

diagnosis::Diagnosis diagnosed(const std::string& truth, const std::vector<double>& heights_mm) {
    const setup::Setup known = laser_lines::mill("w Y b X Z t", 150.0, 0.3);
    return diagnosis::diagnose(
        known, campaign::measured(campaign::with_effect(known, truth), sideways(heights_mm), 5));
}

}  // namespace

TEST_CASE("a bow and a slope of one line are ascribed to no motion with certainty",
          "[diagnosis][sideways]") {
    for (const char* truth : {"X.angular: EAX_p2_rad=-3e-5", "X.straightness: EYX_p2_mm=0.005",
                              "X.angular: EAX_p1_rad=3e-5", "X.straightness: EYX_p1_mm=0.005"}) {
        const std::string right = std::string(truth).substr(0, std::string(truth).find(':'));
        const diagnosis::Diagnosis one = diagnosed(truth, {0.0});
        INFO(truth << '\n' << said(one));
        REQUIRE_FALSE(one.causes.empty());
        const diagnosis::Cause& cause = one.causes.front();
        const bool named = cause.effect == right ||
                           std::count(cause.rivals.begin(), cause.rivals.end(), right) == 1;
        CHECK(named);
        CHECK(cause.probability < 0.85);
        CHECK(one.verdict == diagnosis::Verdict::ambiguous);
        for (const diagnosis::NextMeasurement& n : one.next) UNSCOPED_INFO(n.text);
        CHECK(std::any_of(one.next.begin(), one.next.end(),
                          [](const diagnosis::NextMeasurement& n) { return n.settles; }));
    }
}

TEST_CASE("a second line through another height tells which it is", "[diagnosis][sideways]") {
    for (const char* truth : {"X.angular: EAX_p2_rad=-3e-5", "X.straightness: EYX_p2_mm=0.005"}) {
        const std::string right = std::string(truth).substr(0, std::string(truth).find(':'));
        const diagnosis::Diagnosis two = diagnosed(truth, {0.0, 200.0});
        INFO(truth << '\n' << said(two));
        REQUIRE_FALSE(two.causes.empty());
        CHECK(two.causes.front().effect == right);
        CHECK(two.causes.front().probability > 0.8);
    }
}

}  // namespace trunnion
