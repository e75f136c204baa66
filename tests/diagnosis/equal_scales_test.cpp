// A machine whose axes all stretch alike, and a laser that reads too long: the same readings on
// every line. Neither is certain; one axis alone has its scale.
#include <algorithm>
#include <catch2/catch.hpp>

#include "diagnosis/diagnosis.h"
#include "tests/support/campaign.h"
#include "tests/support/laser_lines.h"
#include "tests/support/said.h"

namespace trunnion {
namespace {

/// Three runs up and down along each of these axes.
records::ReadingTable lines_along(const std::vector<Axis>& axes) {
    records::ReadingTable table = laser_lines::empty_table();
    for (const Axis axis : axes)
        laser_lines::add_runs(table, {std::string(1, letter_of(axis)), axis, 0.0, 20.0, 16,
                                      Vector3::Unit(static_cast<Eigen::Index>(index_of(axis)))});
    return table;
}

setup::Setup mill() {
    return laser_lines::mill("w X Y b Z t", 100.0, 0.8);
}

setup::Setup with_two_lasers() {
    setup::Setup setup = mill();
    for (const char* name : {"old", "new"}) setup.instruments.emplace_back().name = name;
    return setup;
}

/// The lines once by each laser.
records::ReadingTable by_two_lasers(const std::vector<Axis>& axes) {
    records::ReadingTable table = lines_along(axes);
    const std::size_t count = table.rows.size();
    for (std::size_t i = 0; i < count; ++i) {
        records::Reading row = table.rows[i];
        row.index += static_cast<int>(count);
        row.time_s += 10.0 * static_cast<double>(count);
        row.test += " again";
        row.instrument = "new";
        table.rows.push_back(row);
    }
    return table;
}

diagnosis::Diagnosis diagnosed(const std::string& truth, const std::vector<Axis>& axes) {
    const setup::Setup known = mill();
    return diagnosis::diagnose(
        known, campaign::measured(campaign::with_effect(known, truth), lines_along(axes), 5));
}

}  // namespace

TEST_CASE("equal scales of three axes are the machine's stretch or the instrument's gain",
          "[diagnosis][equal_scales]") {
    for (const char* truth : {"machine.expansion: stretch_ppm=30", "sensor.gain: gain_ppm=30"}) {
        const diagnosis::Diagnosis d = diagnosed(truth, {Axis::X, Axis::Y, Axis::Z});
        INFO(truth << '\n' << said(d));
        REQUIRE(d.causes.size() == 1);
        const diagnosis::Cause& cause = d.causes.front();
        const std::string other =
            cause.effect == "sensor.gain" ? "machine.expansion" : "sensor.gain";
        CHECK((cause.effect == "machine.expansion" || cause.effect == "sensor.gain"));
        CHECK(cause.probability < 0.6);
        REQUIRE_FALSE(cause.rivals.empty());
        CHECK(cause.rivals.front() == other);
        CHECK(std::abs(cause.parameters.front().value) == Approx(30.0).epsilon(0.03));
        CHECK(d.verdict == diagnosis::Verdict::ambiguous);
        REQUIRE_FALSE(d.next.empty());
        CHECK(d.next.front().text.find("second instrument") != std::string::npos);
    }
}

TEST_CASE("a second laser tells the machine's stretch from the first one's gain",
          "[diagnosis][equal_scales]") {
    const setup::Setup known = with_two_lasers();
    const records::ReadingTable lines = by_two_lasers({Axis::X, Axis::Y, Axis::Z});
    for (const char* truth :
         {"machine.expansion: stretch_ppm=30", "sensor.gain: gain_old_ppm=30"}) {
        const diagnosis::Diagnosis d = diagnosis::diagnose(
            known, campaign::measured(campaign::with_effect(known, truth), lines, 5));
        INFO(truth << '\n' << said(d));
        REQUIRE(d.causes.size() == 1);
        CHECK(d.causes.front().effect == std::string(truth, std::string(truth).find(':')));
        CHECK(d.causes.front().probability > 0.9);
        CHECK(d.causes.front().rivals.empty());
        CHECK(d.verdict == diagnosis::Verdict::explained);
    }
}

TEST_CASE("one axis that stretches has a wrong scale", "[diagnosis][equal_scales]") {
    const diagnosis::Diagnosis alone = diagnosed("X.scale: scale_ppm=30", {Axis::X});
    INFO(said(alone));
    REQUIRE_FALSE(alone.causes.empty());
    CHECK(alone.causes.front().effect == "X.scale");
    CHECK(std::count(alone.causes.front().rivals.begin(), alone.causes.front().rivals.end(),
                     "machine.expansion") == 0);
    const diagnosis::Diagnosis among =
        diagnosed("X.scale: scale_ppm=30", {Axis::X, Axis::Y, Axis::Z});
    INFO(said(among));
    REQUIRE_FALSE(among.causes.empty());
    CHECK(among.causes.front().effect == "X.scale");
    CHECK(std::count(among.causes.front().rivals.begin(), among.causes.front().rivals.end(),
                     "machine.expansion") == 0);
}

}  // namespace trunnion
