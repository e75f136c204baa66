// Logs as others write them: names of servos, sessions, axes that only carry, no clock.
#include "base/units.h"
#include "tests/imports/import_bench.h"

using namespace trunnion;
using import_bench::Case;
using import_bench::read_rows;

TEST_CASE("a servo has goal and present positions; a session column names the sessions") {
    const setup::Setup setup = import_bench::setup();
    const auto rows =
        read_rows(setup, {imports::ImportKind::axis_log,
                          "time [s],session,X goal [mm],X present [mm]\n0,a,1,1.5\n1,b,2,2.25\n",
                          {},
                          ""});
    REQUIRE(rows.size() == 2);
    CHECK(*rows[0].value_mm == Approx(0.5));
    CHECK(rows[1].commanded[Axis::X] == 2.0);
    CHECK(rows[0].session == "a");
    CHECK(rows[1].session == "b");
}

TEST_CASE(
    "an axis that is not read carries the others at its position; without times that is told") {
    std::vector<std::string> notes;
    const setup::Setup mount = setup::parse_setup(
        "[machine]\nname = \"m\"\nchain = \"w b AZ EL t\"\n"
        "[machine.axis.AZ]\ndirection = [0, 0, -1]\npoint_mm = [0, 0, 0]\n"
        "[machine.axis.EL]\ndirection = [0, -1, 0]\npoint_mm = [0, 0, 0]\n"
        "[[artefact]]\nname = \"sky\"\nkind = \"target\"\ntool_mm = [1000, 0, 0]\n",
        "s.toml", notes);
    const Case pointing{imports::ImportKind::pointing,
                        "AZ [deg],EL [deg],EL error [deg]\n95,32,0.01\n40,55,0.02\n",
                        {},
                        ""};
    const std::string text = import_bench::imported(mount, pointing).readings;
    const records::ReadingTable table =
        records::parse_readings(text, "r.csv", notes, mount.machine.chain.names());
    REQUIRE(table.rows.size() == 2);
    CHECK(table.rows[0].commanded[mount.machine.chain.tool[0].axis] == Approx(rad_from_deg(95.0)));
    CHECK(table.rows[1].commanded[mount.machine.chain.tool[0].axis] == Approx(rad_from_deg(40.0)));
    CHECK_FALSE(records::has_times(table));
    const Case timed{imports::ImportKind::pointing,
                     "time [s],AZ [deg],EL [deg],EL error [deg]\n0,95,32,0.01\n9,40,55,0.02\n",
                     {},
                     ""};
    CHECK(records::has_times(records::parse_readings(import_bench::imported(mount, timed).readings,
                                                     "r.csv", notes, mount.machine.chain.names())));
}
