// One line of a laser along an axis, the most common measurement there is: what it shows is the
// positioning of the axis by ISO 230-1, also where an angle makes it. A second line tells.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/support/campaign.h"
#include "tests/support/diagnosed.h"
#include "tests/support/laser_lines.h"
#include "tests/support/said.h"

namespace trunnion {
namespace {

/// X deviations along X, with Z at each of these heights.
records::ReadingTable lines(const std::vector<double>& heights_mm) {
    records::ReadingTable table = laser_lines::empty_table();
    for (const double z_mm : heights_mm)
        laser_lines::add_runs(table, {"Z" + std::to_string(static_cast<int>(z_mm)), Axis::X, -200.0,
                                      20.0, 21, Vector3::UnitX(), z_mm});
    return table;
}

/// A smooth curve with two bumps, um: no ripple, and no polynomial of low order.
double curve_um(double x_mm, int form) {
    const auto bump = [&](double at_mm, double width_mm) {
        return std::exp(-std::pow((x_mm - at_mm) / width_mm, 2));
    };
    return 9.0 * bump(-120.0 + 30.0 * form, 60.0) - 7.0 * bump(110.0 - 12.0 * form, 45.0);
}

/// Readings of a machine with this curve as positioning, or as pitch: seen through the target 150
/// mm below the spindle, and through the height of Z, which X carries.
records::ReadingTable measured(const setup::Setup& known, const std::vector<double>& heights_mm,
                               int form, bool pitch) {
    records::ReadingTable table =
        campaign::measured(known, lines(heights_mm), static_cast<std::uint64_t>(form));
    for (records::Reading& row : table.rows) {
        const double through = pitch ? (row.commanded[Axis::Z] - 150.0) / -150.0 : 1.0;
        row.value_mm = *row.value_mm + 1e-3 * through * curve_um(row.commanded[Axis::X], form);
    }
    return table;
}

const diagnosis::Cause* cause_of(const diagnosis::Diagnosis& d, const std::string& name) {
    const auto found = std::find_if(d.causes.begin(), d.causes.end(),
                                    [&](const diagnosis::Cause& c) { return c.effect == name; });
    return found == d.causes.end() ? nullptr : &*found;
}

}  // namespace

TEST_CASE("what one line shows is positioning, with the angle as its rival", "[diagnosis][line]") {
    const setup::Setup known = laser_lines::mill("w Y b X Z t", 150.0, 0.4);
    for (const bool pitch : {false, true})
        for (int form = 0; form < 6; ++form) {
            const diagnosis::Diagnosis d = diagnosed(known, measured(known, {0.0}, form, pitch));
            INFO(pitch << ' ' << form << ": " << said(d));
            CHECK_FALSE(claims(d, "X.angular"));
            const diagnosis::Cause* positioning = cause_of(d, "X.positioning");
            REQUIRE(positioning);
            CHECK(std::count(positioning->rivals.begin(), positioning->rivals.end(), "X.angular") ==
                  1);
            CHECK(positioning->probability > 0.5);
            CHECK(positioning->probability < 0.7);
            CHECK_FALSE(positioning->points.empty());
            CHECK(d.verdict == diagnosis::Verdict::ambiguous);
        }
}

// Y carries the work: the target is as far from the slide of X wherever Y rests.
TEST_CASE("a second line through the same arm does not tell positioning from the angle",
          "[diagnosis][line]") {
    const setup::Setup known = laser_lines::mill("w Y b X Z t", 150.0, 0.4);
    for (const bool pitch : {false, true})
        for (int form = 0; form < 3; ++form) {
            records::ReadingTable table = measured(known, {0.0, 1.0}, form, pitch);
            for (records::Reading& row : table.rows)
                if (row.test == "Z1") {
                    row.commanded[Axis::Y] = 200.0;
                    row.commanded[Axis::Z] = 0.0;
                }
            const diagnosis::Diagnosis d = diagnosed(known, table);
            INFO(pitch << ' ' << form << ": " << said(d));
            CHECK_FALSE(claims(d, "X.angular"));
            const diagnosis::Cause* positioning = cause_of(d, "X.positioning");
            REQUIRE(positioning);
            CHECK(std::count(positioning->rivals.begin(), positioning->rivals.end(), "X.angular") ==
                  1);
            CHECK(positioning->probability > 0.5);
            CHECK(positioning->probability < 0.7);
        }
}

TEST_CASE("a second line at another height tells positioning from the angle", "[diagnosis][line]") {
    const setup::Setup known = laser_lines::mill("w Y b X Z t", 150.0, 0.4);
    for (const bool pitch : {false, true})
        for (int form = 0; form < 3; ++form) {
            const diagnosis::Diagnosis d =
                diagnosed(known, measured(known, {0.0, 200.0}, form, pitch));
            INFO(pitch << ' ' << form << ": " << said(d));
            const diagnosis::Cause* right = cause_of(d, pitch ? "X.angular" : "X.positioning");
            REQUIRE(right);
            CHECK(right->probability > 0.8);
            CHECK_FALSE(claims(d, pitch ? "X.positioning" : "X.angular"));
        }
}

}  // namespace trunnion
