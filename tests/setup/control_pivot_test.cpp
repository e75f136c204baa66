// One line about the pivot in a control's stores; strokes that become those of the machine.
#include "setup/control_pivot.h"

#include <catch2/catch.hpp>

#include "base/alarm.h"
#include "base/units.h"
#include "setup/control_machine.h"

namespace trunnion {

namespace {

/// B carries C: B through X -12 Z -450, C through X 330, Y 205.
offsets::Stores table_stores() {
    offsets::Stores stores;
    for (const auto& [number, value] :
         {std::pair(19680, 12), {19681, 4}, {19682, 2}, {19686, 5}, {19687, 3}, {19697, 3}})
        stores.parameters.set(number, value);
    stores.parameters.set(19700, 330.25);
    stores.parameters.set(19701, 77.0);
    stores.parameters.set(19702, -450.0);
    stores.parameters.set(19703, -0.25);
    stores.parameters.set(19704, 128.0);
    stores.parameters.set(19705, 9.0);
    stores.work.standard[0][Axis::X] = 329.0;
    stores.work.external[Axis::X] = 1.0;
    stores.work.standard[0][Axis::Y] = 205.0;
    stores.work.standard[0][Axis::Z] = -450.0;
    stores.parameters.entry[1020].by_axis = {{1, 88}, {2, 89}, {3, 90}, {4, 66}, {5, 67}};
    return stores;
}

}  // namespace

TEST_CASE("G54 and 19700-19705 name the same pivot or not") {
    offsets::Stores stores = table_stores();
    const setup::PivotAgreement same = setup::compare_pivots(stores, std::nullopt, "stick");
    CHECK((same.parameters_mm - Vector3(330.0, 205.0, -450.0)).norm() < 1e-12);
    CHECK(same.agrees());
    CHECK(setup::text_of(same).find("they agree") != std::string::npos);
    stores.parameters.set(19702, -450.01);
    const setup::PivotAgreement other =
        setup::compare_pivots(stores, Vector3(330.0, 205.0, -450.0), "stick");
    CHECK_FALSE(other.agrees());
    CHECK(other.apart_mm() == Approx(0.01));
    CHECK(setup::text_of(other).find("measured X330.0000") != std::string::npos);
    stores.parameters.set(19680, 2);
    CHECK_THROWS_AS(setup::compare_pivots(stores, std::nullopt, "stick"), InputError);
}

TEST_CASE("strokes and rapid speeds of the parameters are those of the machine") {
    offsets::Stores stores = table_stores();
    stores.parameters.entry[1320].by_axis = {{1, 400.0}, {4, 110.0}, {5, -1.0}};
    stores.parameters.entry[1321].by_axis = {{1, -10.0}, {4, -30.0}, {5, 1.0}};
    stores.parameters.entry[1420].by_axis = {{1, 30000.0}, {4, 3600.0}};
    const setup::Setup s = setup::setup_of_control(stores, "stick");
    const auto* x = s.machine.chain.find(Axis::X);
    CHECK(x->max == 400.0);
    CHECK(x->min == -10.0);
    CHECK(x->max_speed == Approx(500.0));
    const auto* b = s.machine.chain.find(Axis::B);
    CHECK(b->max == Approx(rad_from_deg(110.0)));
    CHECK(b->max_speed == Approx(rad_from_deg(60.0)));
    const auto* c = s.machine.chain.find(Axis::C);
    CHECK_FALSE(c->max.has_value());
    std::vector<std::string> notes;
    const setup::Setup again = setup::parse_setup(setup::format_setup(s), "again.toml", notes);
    CHECK(again.machine.chain.find(Axis::X)->max == 400.0);
}

TEST_CASE("a backup of a mill without rotary axes makes a setup that loads and runs") {
    offsets::Stores stores;
    stores.parameters.entry[1020].by_axis = {{1, 88.0}, {2, 89.0}, {3, 90.0}, {4, 87.0}};
    stores.parameters.entry[1320].by_axis = {{1, 400.0}, {2, 200.0}, {3, 0.0}, {4, 900.0}};
    stores.parameters.entry[1321].by_axis = {{1, -400.0}, {2, -200.0}, {3, -500.0}, {4, 0.0}};
    stores.parameters.entry[1420].by_axis = {{1, 30000.0}, {2, 30000.0}, {3, 24000.0}};
    stores.parameters.entry[1851].by_axis = {{1, 12.0}, {2, 0.0}, {3, 3.0}};
    stores.work.standard[0][Axis::Z] = -300.0;
    stores.tools.tool[2].length_geometry_mm = 120.0;
    const setup::Setup s = setup::setup_of_control(stores, "stick");
    CHECK(s.chain_text == "w b X Y Z t");
    REQUIRE(s.auxiliary.size() == 1);  // 1022 does not say that W runs beside Z
    CHECK(s.auxiliary[0].max == 900.0);
    std::vector<std::string> notes;
    const setup::Setup again = setup::parse_setup(setup::format_setup(s), "again.toml", notes);
    for (const std::string& note : notes) CHECK(note.find("compensates") == std::string::npos);
    CHECK(again.machine.chain.find(Axis::Z)->min == -500.0);
    CHECK(again.stores.tools.tool[2].length_mm() == 120.0);
    CHECK(again.stores.work.standard[0][Axis::Z] == -300.0);
    CHECK(setup::format_setup(again) == setup::format_setup(s));
    // The errors that the control compensates are those of the machine: Y has none.
    REQUIRE(again.effects.size() == 2);
    CHECK(again.effects[0].name == "X.backlash");
    CHECK(again.effects[0].parameters.at("gap_mm")[0] == Approx(-0.012));
    CHECK(again.effects[1].parameters.at("gap_mm")[0] == Approx(-0.003));
}

TEST_CASE("1022 places W beside Z, and pitch data become an error of the machine") {
    offsets::Stores stores = table_stores();
    stores.parameters.entry[1020].by_axis = {{1, 88.0}, {2, 89.0}, {3, 90.0},
                                             {4, 66.0}, {5, 67.0}, {6, 87.0}};
    stores.parameters.entry[1022].by_axis = {{1, 1.0}, {2, 2.0}, {3, 3.0}, {6, 7.0}};
    for (const auto& [number, first] : {std::pair{2, 10.0}, std::pair{5, 50.0}}) {
        stores.parameters.entry[3620].by_axis[number] = first;
        stores.parameters.entry[3621].by_axis[number] = first;
        stores.parameters.entry[3622].by_axis[number] = first + 2.0;
        stores.parameters.entry[3624].by_axis[number] = number == 2 ? 100.0 : 180.0;
    }
    stores.parameters.set(10011, 3.0);
    stores.parameters.set(10051, 4.0);
    stores.parameters.set(10052, -4.0);
    const setup::Setup s = setup::setup_of_control(stores, "stick");
    CHECK(s.chain_text == "w C B b W X Y Z t");
    CHECK(s.machine.chain.find(Axis::W)->direction == Vector3::UnitZ());
    const auto& errors = s.machine.errors.axis;
    CHECK(errors[index_of(Axis::Y)].motion[1](100.0) == Approx(-0.003));
    // A + command turns the table about -Z: the error about + Z is the datum itself.
    const double at_half = errors[index_of(Axis::C)].motion[5](rad_from_deg(180.0));
    CHECK(at_half == Approx(s.machine.chain.find(Axis::C)->direction.z() < 0.0
                                ? rad_from_deg(0.004)
                                : -rad_from_deg(0.004)));
    std::vector<std::string> notes;
    const setup::Setup again = setup::parse_setup(setup::format_setup(s), "again.toml", notes);
    // What the file left out is derived once: then it stays as it is.
    const setup::Setup twice = setup::parse_setup(setup::format_setup(again), "t.toml", notes);
    CHECK(setup::format_setup(twice) == setup::format_setup(again));
    CHECK(again.machine.errors.axis[index_of(Axis::Y)].motion[1](100.0) == Approx(-0.003));
}

TEST_CASE("a setup of a backup with spindles, paths and no stroke can be read again", "[setup]") {
    offsets::Stores stores = table_stores();
    stores.parameters.entry[982].by_axis = {{101, 0.0}, {201, 3.0}};
    stores.parameters.entry[1320].by_axis = {{1, 0.0}, {2, 300.0}};
    stores.parameters.entry[1321].by_axis = {{1, 0.0}, {2, -300.0}};
    std::vector<std::string> notes;
    const setup::Setup again = setup::parse_setup(
        setup::format_setup(setup::setup_of_control(stores, "stick")), "again.toml", notes);
    CHECK(again.stores.parameters.entry.at(982).by_axis ==
          std::map<int, double>{{101, 0.0}, {201, 3.0}});
    CHECK(again.stores.parameters.entry.at(1320).by_axis.at(1) == 0.0);
    CHECK(again.machine.chain.find(Axis::Y)->max == 300.0);
}

}  // namespace trunnion
