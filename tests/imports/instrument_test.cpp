// The instrument that took the readings, for files of every kind.
#include "tests/imports/import_bench.h"

using namespace trunnion;
using import_bench::Case;
using import_bench::imported;
using import_bench::read_rows;

namespace {

constexpr auto laser = imports::ImportKind::iso230_2;
constexpr auto servo = imports::ImportKind::axis_log;

const std::string targets = "Axis: X\nUnit: um\ntarget [mm];1+;2+\n0;0;1\n100;1;2\n200;2;3\n";
const std::string recorded = "time [s],X cmd [mm],X act [mm]\n0,0,0\n1,10,10.001\n2,20,20.001\n";

setup::Setup with_lasers() {
    setup::Setup setup = import_bench::setup("w b X Y Z t");
    for (const char* name : {"old", "new"}) setup.instruments.emplace_back().name = name;
    return setup;
}

}  // namespace

TEST_CASE("rows of a laser and of a log name the instrument that is told", "[imports]") {
    for (const Case& c : {Case{laser, targets, {"instrument=new"}, ""},
                          Case{servo, recorded, {"instrument=new"}, ""}}) {
        const auto rows = read_rows(with_lasers(), c);
        REQUIRE_FALSE(rows.empty());
        for (const records::Reading& row : rows) CHECK(row.instrument == "new");
    }
    for (const records::Reading& row : read_rows(with_lasers(), {laser, targets, {}, ""}))
        CHECK(row.instrument.empty());
}

TEST_CASE("an instrument above a table counts if the setup has it", "[imports]") {
    for (const records::Reading& row :
         read_rows(with_lasers(), {laser, "Instrument: old\n" + targets, {}, ""}))
        CHECK(row.instrument == "old");
    for (const records::Reading& row :
         read_rows(with_lasers(), {laser, "Instrument: model 80\n" + targets, {}, ""}))
        CHECK(row.instrument.empty());
}

TEST_CASE("an instrument that is told and not in the setup is refused", "[imports]") {
    for (const setup::Setup& setup : {with_lasers(), import_bench::setup("w b X Y Z t")})
        CHECK_THROWS_WITH(imported(setup, {laser, targets, {"instrument=third"}, ""}),
                          Catch::Contains("no [[instrument]] named 'third'"));
}
