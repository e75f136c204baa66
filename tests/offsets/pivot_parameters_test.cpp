// Parameters 19680-19714 read as A-79348E says, and written back.
#include "offsets/pivot_parameters.h"

#include <catch2/catch.hpp>
#include <limits>

#include "base/alarm.h"
#include "base/random.h"
#include "base/units.h"
#include "offsets/axis_numbers.h"
#include "tests/support/table_parameters.h"

namespace trunnion {

namespace {

offsets::Parameters bc_table() {
    offsets::Parameters p;
    testing::set_two_table_axes(p, 2);
    p.set(19697, 3);
    p.set(19700, 10);
    p.set(19701, 20);
    p.set(19702, 30);
    p.set(19705, -50.5);
    return p;
}

const std::vector<Axis> bc_order{Axis::X, Axis::Y, Axis::Z, Axis::B, Axis::C};

int alarm_of(const offsets::Parameters& p) {
    try {
        offsets::decode_pivot(p, bc_order);
    } catch (const Alarm& alarm) {
        return alarm.number;
    }
    return 0;
}

}  // namespace

TEST_CASE("pivot parameters of a BC table") {
    const auto pivot = offsets::decode_pivot(bc_table(), bc_order);
    REQUIRE(pivot);
    CHECK(pivot->unit == offsets::MechanicalUnit::table_table);
    CHECK(pivot->first.axis == Axis::B);
    CHECK(pivot->first.direction() == Vector3(0, -1, 0));
    CHECK(pivot->second.axis == Axis::C);
    CHECK(pivot->second.direction() == Vector3(0, 0, -1));
    CHECK(pivot->table_point_mm == Vector3(10, 20, 30));
    CHECK(pivot->table_offset_mm == Vector3(0, 0, -50.5));
    CHECK(pivot->tool_direction == Vector3(0, 0, 1));
    CHECK_FALSE(pivot->first.max_rad);
}

TEST_CASE("axis numbers follow 1020, then the control's order, then the letters") {
    offsets::Parameters p = bc_table();
    CHECK(offsets::decode_pivot(p)->first.axis == Axis::A);
    p.entry[1020].by_axis[4] = 'B';
    p.entry[1020].by_axis[5] = 'A';
    CHECK(offsets::decode_pivot(p, bc_order)->second.axis == Axis::A);
}

TEST_CASE("an axis number without a name counts from 1 to the last axis") {
    const offsets::Parameters none;
    CHECK_FALSE(offsets::axis_of_number(none, 0, bc_order));
    CHECK_FALSE(offsets::axis_of_number(none, -1, bc_order));
    CHECK(offsets::axis_of_number(none, 1, bc_order) == bc_order.front());
    const int last = static_cast<int>(bc_order.size());
    CHECK(offsets::axis_of_number(none, last, bc_order) == bc_order.back());
    CHECK_FALSE(offsets::axis_of_number(none, last + 1, bc_order));
}

TEST_CASE("inclined axes, limits, hypothetical axis, reference tool direction") {
    offsets::Parameters p = bc_table();
    p.set(19682, 5);  // YZ plane
    p.set(19683, -45.0);
    p.set(19741, 180.0);
    p.set(19742, -30.0);
    p.set_bit(19696, 1, true);
    p.set_bit(19696, 5, true);
    p.set(19686, 0);
    p.set(19690, 15.0);
    p.set(19697, 1);
    p.set(19698, 90.0);  // about Y
    const auto pivot = offsets::decode_pivot(p, bc_order);
    CHECK((pivot->first.direction() - Vector3(0, -std::sqrt(0.5), std::sqrt(0.5))).norm() < 1e-15);
    CHECK(*pivot->first.max_rad == Approx(pi));
    CHECK(*pivot->first.min_rad == Approx(-pi / 6));
    CHECK(pivot->second.hypothetical);
    CHECK(pivot->second.hypothetical_rad == Approx(rad_from_deg(15)));
    CHECK(pivot->frame_follows_work);
    CHECK((pivot->tool_direction - Vector3(0, 0, -1)).norm() < 1e-15);
}

TEST_CASE("values that cannot be are alarm 5459") {
    CHECK(alarm_of(bc_table()) == 0);
    const auto with = [](int number, double value) {
        offsets::Parameters p = bc_table();
        p.set(number, value);
        return alarm_of(p);
    };
    CHECK(with(19680, 3) == 5459);
    CHECK(with(19681, 0) == 5459);
    CHECK(with(19681, 1) == 5459);  // X does not turn
    CHECK(with(19681, 5) == 5459);  // the same axis twice
    CHECK(with(19681, 9) == 5459);
    CHECK(with(19682, 0) == 5459);
    CHECK(with(19682, 7) == 5459);
    CHECK(with(19682, 2.5) == 5459);
    CHECK(with(19684, 2) == 5459);
    CHECK(with(19697, -1) == 5459);
    CHECK(with(19697, 0) == 0);  // the reference direction is Z then
    CHECK(with(19697, 3) == 0);
    CHECK(with(19697, 4) == 5459);
    CHECK(with(19681, 1e30) == 5459);
    CHECK(with(19700, std::numeric_limits<double>::infinity()) == 5459);
    CHECK(with(19742, 10) == 5459);          // lower limit above the upper one
    offsets::Parameters still = bc_table();  // both limits at one place: the axis does not turn
    still.set(19741, 10);
    still.set(19742, 10);
    CHECK(alarm_of(still) == 0);
    CHECK(with(19696, 3) == 5459);  // both axes hypothetical
    offsets::Parameters none = bc_table();
    none.set(19680, 0);
    CHECK_FALSE(offsets::decode_pivot(none, bc_order));
    CHECK_FALSE(offsets::decode_pivot(offsets::Parameters{}));
}

TEST_CASE("encode and decode give the same geometry") {
    SeededNoise noise(4);
    for (int k = 0; k < 300; ++k) {
        offsets::PivotParameters pivot;
        pivot.unit =
            std::array{offsets::MechanicalUnit::tool_tool, offsets::MechanicalUnit::table_table,
                       offsets::MechanicalUnit::mixed}[static_cast<std::size_t>(k % 3)];
        const double angle = 2 * pi * noise.uniform();
        Vector3 inclined = Vector3::Zero();
        inclined[k % 3] = std::cos(angle);
        inclined[(k + 1) % 3] = std::sin(angle);
        pivot.first.line = k % 2 == 0 ? inclined : Vector3(-Vector3::UnitY());
        pivot.second.axis = Axis::C;
        pivot.second.sign = k % 4 < 2 ? 1.0 : -1.0;
        const auto vector = [&] { return Vector3(noise.normal(), noise.normal(), noise.normal()); };
        pivot.table_point_mm = vector();
        pivot.table_offset_mm = vector();
        pivot.tool_offset_mm = vector();
        pivot.tool_second_offset_mm = vector();
        pivot.holder_offset_mm = noise.normal();
        offsets::Parameters p;
        offsets::encode_pivot(pivot, p, bc_order);
        const auto back = offsets::decode_pivot(p, bc_order);
        REQUIRE(back);
        CHECK(back->unit == pivot.unit);
        CHECK((back->first.direction() - pivot.first.direction()).norm() < 1e-14);
        CHECK((back->second.direction() - pivot.second.direction()).norm() < 1e-14);
        CHECK(back->table_point_mm == pivot.table_point_mm);
        CHECK(back->table_offset_mm == pivot.table_offset_mm);
        CHECK(back->tool_offset_mm == pivot.tool_offset_mm);
        CHECK(back->tool_second_offset_mm == pivot.tool_second_offset_mm);
        CHECK(back->holder_offset_mm == pivot.holder_offset_mm);
    }
    offsets::PivotParameters askew;
    askew.unit = offsets::MechanicalUnit::table_table;
    askew.first.line = Vector3(1, 1, 1).normalized();
    offsets::Parameters p;
    CHECK_THROWS_AS(offsets::encode_pivot(askew, p), InputError);
}

TEST_CASE("encode keeps the limits of an axis, a hypothetical first axis, and a machine without") {
    offsets::PivotParameters pivot;
    pivot.unit = offsets::MechanicalUnit::table_table;
    pivot.first.hypothetical = true;
    pivot.first.hypothetical_rad = rad_from_deg(15);
    pivot.second.axis = Axis::C;
    pivot.second.min_rad = rad_from_deg(-90);
    for (const bool both : {false, true}) {
        if (both) pivot.second.max_rad = rad_from_deg(120);
        offsets::Parameters p;
        offsets::encode_pivot(pivot, p, bc_order);
        const auto back = offsets::decode_pivot(p, bc_order);
        REQUIRE(back);
        CHECK(back->first.hypothetical);
        CHECK(back->first.hypothetical_rad == Approx(rad_from_deg(15)));
        CHECK_FALSE(back->second.hypothetical);
        CHECK(back->second.min_rad.has_value() == both);  // one limit alone cannot be written
        if (both) CHECK(*back->second.max_rad == Approx(rad_from_deg(120)));
    }
    offsets::Parameters none;
    offsets::encode_pivot({}, none, bc_order);
    CHECK(none.get(19680) == 0.0);
    CHECK_FALSE(offsets::decode_pivot(none, bc_order));
    pivot.tool_direction = Vector3(0, 0, -1);
    CHECK_THROWS_AS(offsets::encode_pivot(pivot, none, bc_order), InputError);
}

TEST_CASE("19698 and 19699 tilt the reference direction of the tool, each alone") {
    offsets::Parameters p = bc_table();
    p.set(19697, 3);
    p.set(19699, 90);
    CHECK((offsets::decode_pivot(p, bc_order)->tool_direction - Vector3(1, 0, 0)).norm() < 1e-15);
    p.set(19699, 0);
    p.set(19698, 90);
    CHECK((offsets::decode_pivot(p, bc_order)->tool_direction - Vector3(0, -1, 0)).norm() < 1e-15);
}

}  // namespace trunnion
