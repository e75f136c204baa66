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

}  // namespace trunnion
