// Readings that allow no comparison are refused, and files that stand for sessions.
#include <catch2/catch.hpp>

#include "base/alarm.h"
#include "diagnosis/changes.h"
#include "tests/support/campaign.h"

namespace trunnion {

TEST_CASE("held-out readings that cannot belong to the machine are refused", "[diagnosis]") {
    const setup::Setup setup = campaign::bc_setup();
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_sphere_map(table, setup, 10, 5);
    const records::ReadingTable readings = campaign::measured(setup, table, 1);
    const diagnosis::Prepared prepared = diagnosis::prepare(setup, readings);
    records::ReadingTable holdout = readings;
    CHECK_NOTHROW(diagnosis::refuse_poor_holdout(prepared, holdout));
    const auto refused = [&](const char* why) {
        CHECK_THROWS_AS(diagnosis::refuse_poor_holdout(prepared, holdout), InputError);
        CHECK_THROWS_WITH(diagnosis::refuse_poor_holdout(prepared, holdout), Catch::Contains(why));
    };
    double& value_mm = *holdout.rows.back().value_mm;
    for (const double off_mm : {-5.1, 5.1}) {
        value_mm += off_mm;
        refused("away from what the simulation reads");
        value_mm -= off_mm;
    }
    value_mm += 4.9;
    CHECK_NOTHROW(diagnosis::refuse_poor_holdout(prepared, holdout));
    holdout.rows.back().value_mm.reset();
    refused("without value_mm");
    std::erase_if(holdout.rows, [](const auto& r) { return r.device != records::Device::none; });
    refused("no held-out reading");
}

TEST_CASE("too few readings are refused with the number that it takes", "[diagnosis]") {
    const setup::Setup setup = campaign::bc_setup();
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_sphere_map(table, setup, 10, 5);
    records::ReadingTable readings = campaign::measured(setup, table, 1);
    readings.rows.resize(10);
    CHECK_THROWS_WITH(diagnosis::prepare(setup, readings), Catch::Contains("takes 12 or more"));
}

TEST_CASE("each file of a table is a session where no row names one", "[diagnosis][over]") {
    const setup::Setup setup = campaign::bc_setup();
    records::ReadingTable monday = campaign::empty_table(setup), friday = monday;
    campaign::add_sphere_map(monday, setup, 4, 5);
    campaign::add_sphere_map(friday, setup, 5, 6);
    monday.path = "a/monday.csv";
    friday.path = "b/friday.2.csv";
    CHECK_FALSE(diagnosis::files_as_sessions(monday));
    records::ReadingTable both = records::join_readings({monday, friday});
    const auto named = diagnosis::files_as_sessions(both);
    REQUIRE(named);
    for (std::size_t i = 0; i < named->rows.size(); ++i)
        CHECK(named->rows[i].session == (i < monday.rows.size() ? "monday" : "friday.2"));
    diagnosis::DiagnosisOptions options;
    options.plan_next = false;
    options.over_sessions = true;
    const auto read = campaign::measured(setup, both, 1);
    const diagnosis::Diagnosis d = diagnosis::diagnose(setup, read, options);
    REQUIRE(d.sessions.size() == 2);
    CHECK(d.sessions[0].readings == 12);
    CHECK(d.sessions[1].name == "friday.2");
    both.rows.back().session = "Tuesday";
    CHECK_FALSE(diagnosis::files_as_sessions(both));
}

}  // namespace trunnion
