// From prints alone: which store is stale, what to type, and what prints are refused.
#include <catch2/catch.hpp>

#include "base/alarm.h"
#include "pivot_bench.h"

using namespace trunnion;
using namespace trunnion::pivot_bench;

namespace {

constexpr Vector3::Scalar length_mm = 150.0;
const Vector3 tip(0, 0, -length_mm);

struct Case {
    setup::Setup setup;
    pivot::PivotPlan plan;
    std::string printed;
};

/// A machine whose axes lie and lean a little elsewhere, one store wrong.
Case random_case(const std::string& file, SeededNoise& noise, pivot::PivotGroup wrong,
                 double size_mm) {
    setup::Setup setup = load(file);
    auto stores = *setup::rotary_stores(setup.machine.chain, setup.stores);
    for (const Axis axis : {stores.pivot.first.axis, stores.pivot.second.axis})
        for (std::size_t i = 0; i < 6; ++i)
            setup.machine.errors.axis[index_of(axis)].location[i] =
                noise.normal() * (i < 3 ? 0.02 : 1e-5);
    // A zero position of a head's axis reads as its pivot length: not part of this law.
    if (stores.pivot.unit != offsets::MechanicalUnit::table_table)
        for (const offsets::PivotAxis& axis : {stores.pivot.first, stores.pivot.second}) {
            Eigen::Index along = 0;
            axis.line.cwiseAbs().maxCoeff(&along);
            setup.machine.errors.axis[index_of(axis.axis)]
                .location[static_cast<std::size_t>(along) + 3] = 0.0;
        }
    // A head hangs otherwise under its axis than the setup says: its pivot length is off.
    if (stores.pivot.unit != offsets::MechanicalUnit::table_table)
        for (const std::size_t i : {0U, 1U, 2U})
            setup.machine.errors.spindle.location[i] = 0.02 * noise.normal();
    setup::RotaryStores right = setup::right_stores(setup.machine, stores);
    // The centre of DPP and G54.2 exists only where the axes meet.
    const Vector3 step = setup::step_between_axes_mm(right);
    for (int i = 0; i < 3; ++i)
        setup.machine.errors.axis[index_of(stores.pivot.second.axis)]
            .location[static_cast<std::size_t>(i)] -= step[i];
    right = setup::rounded(setup::right_stores(setup.machine, stores), 1e-3);
    for (const setup::StoreNumber& n : setup::store_numbers(right))
        if ((n.parameter == 0) == (wrong == pivot::PivotGroup::g54))
            setup::set_number(right, n, n.value_mm + size_mm * noise.normal());
    enter(setup::rounded(right, 1e-3), setup);
    Case out{setup, pivot::plan_pivot_test(setup), {}};
    out.printed = prints_of(out.plan, setup.machine, tip, 0.5, 1.0,
                            static_cast<std::uint64_t>(1e9 * noise.uniform()));
    return out;
}

pivot::PivotVerdict judge(const Case& c) {
    const pivot::PivotPrints prints =
        pivot::parse_pivot_prints({{"print.txt", c.printed}}, c.plan.first(), c.plan.second());
    kinematics::Machine nominal = c.setup.machine;
    nominal.errors = {};
    std::vector<std::string> notes;
    return pivot::judge_pivot({nominal, pivot::stores_in_force(prints, c.plan.stores, notes),
                               prints.sphere_mm(), tip, 1e-3, 3.0},
                              prints.maps);
}

/// Largest error over the maps that the store in force causes beside the right one, um.
double visible_um(const Case& c, pivot::PivotGroup group) {
    const pivot::PivotModel now(c.setup.machine, c.plan.stores, c.plan.sphere_mm, tip),
        right(c.setup.machine, setup::right_stores(c.setup.machine, c.plan.stores),
              c.plan.sphere_mm, tip);
    double worst = 0.0;
    for (const pivot::PlannedMap& map : c.plan.maps)
        for (int k = 0; k < map.count; ++k)
            if (group == pivot::PivotGroup::p1970x || map.turns_table_only)
                worst = std::max(
                    worst, um_from_mm((now.error_mm(group, map.first_deg(k), map.second_deg(k)) -
                                       right.error_mm(group, map.first_deg(k), map.second_deg(k)))
                                          .norm()));
    return worst;
}

/// Largest difference of two functions once the printed numbers are typed, um.
double apart_um(const Case& c, const setup::RotaryStores& typed) {
    const pivot::PivotModel model(c.setup.machine, typed, c.plan.sphere_mm, tip);
    double worst = 0.0;
    for (const pivot::PlannedMap& map : c.plan.maps)
        for (int k = 0; k < map.count; ++k)
            if (map.turns_table_only)
                worst = std::max(
                    worst, um_from_mm((model.error_mm(pivot::PivotGroup::g54, map.first_deg(k),
                                                      map.second_deg(k)) -
                                       model.error_mm(pivot::PivotGroup::p1970x, map.first_deg(k),
                                                      map.second_deg(k)))
                                          .norm()));
    return worst;
}

std::string refusal(const std::string& printed) {
    try {
        pivot::parse_pivot_prints({{"print.txt", printed}}, Axis::B, Axis::C);
    } catch (const InputError& error) {
        return fmt::format("{}:{}: {}", error.where.program, error.where.line, error.message);
    }
    return "accepted";
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    REQUIRE(text.find(from) != std::string::npos);
    return text.replace(text.find(from), from.size(), to);
}

}  // namespace

TEST_CASE("the stale store is named and the printed numbers mend it: five kinds of machine") {
    SeededNoise noise(2021);
    int cases = 0, named = 0, other = 0;
    double worst_apart_um = 0.0;
    for (const char* file : {"bc_table.toml", "ac_trunnion.toml", "head_table.toml",
                             "head_head.toml", "nutating_table.toml"}) {
        for (int k = 0; k < 40; ++k) {
            const bool table = std::string(file) != "head_head.toml";
            const pivot::PivotGroup wrong =
                table && k % 2 ? pivot::PivotGroup::g54 : pivot::PivotGroup::p1970x;
            const Case c = random_case(file, noise, wrong, k % 4 < 2 ? 0.03 : 0.15);
            if (visible_um(c, wrong) < 20.0) continue;
            CAPTURE(file, k, c.printed.size());
            const pivot::PivotVerdict v = judge(c);
            ++cases;
            named += v.find(wrong)->stale;
            const pivot::PivotGroup right = wrong == pivot::PivotGroup::g54
                                                ? pivot::PivotGroup::p1970x
                                                : pivot::PivotGroup::g54;
            other += v.find(right) && v.find(right)->stale;
            worst_apart_um = std::max(worst_apart_um, apart_um(c, v.typed));
            CHECK(v.unobservable.size() >= 3);
            CHECK(v.fit.noise_um == Approx(0.5).margin(0.15));
            CHECK(v.fit.zero_scatter_um < 2.5);
        }
    }
    INFO(cases << " cases, named " << named << ", the other one " << other << ", after typing "
               << worst_apart_um << " um");
    CHECK(cases > 150);
    CHECK(named >= cases * 99 / 100);
    CHECK(other == 0);
    CHECK(worst_apart_um < 3.0);
}

TEST_CASE("sigma is honest: the true numbers lie where it says") {
    SeededNoise noise(7);
    double square = 0.0;
    int count = 0;
    for (int k = 0; k < 30; ++k) {
        const Case c = random_case(k % 2 ? "bc_table.toml" : "head_table.toml", noise,
                                   pivot::PivotGroup::p1970x, 0.05);
        const pivot::PivotVerdict v = judge(c);
        const auto truth =
            setup::store_numbers(setup::right_stores(c.setup.machine, c.plan.stores));
        for (const pivot::StoreVerdict& s : v.stores)
            for (const setup::StoreNumber& n : truth)
                if (n.name == s.in_force.name && s.sigma_mm > 1e-6) {
                    square += std::pow((s.exact_mm - n.value_mm) / s.sigma_mm, 2);
                    ++count;
                }
    }
    CHECK(square / count > 0.6);
    CHECK(square / count < 1.6);
}

TEST_CASE("stores in force come from the prints, and a difference is said") {
    SeededNoise noise(9);
    const Case c = random_case("bc_table.toml", noise, pivot::PivotGroup::g54, 0.1);
    const pivot::PivotPrints prints =
        pivot::parse_pivot_prints({{"p", c.printed}}, Axis::B, Axis::C);
    setup::RotaryStores declared = c.plan.stores;
    declared.pivot.table_offset_mm.y() += 0.5;
    std::vector<std::string> notes;
    const setup::RotaryStores used = pivot::stores_in_force(prints, declared, notes);
    CHECK(used.pivot.table_offset_mm.y() ==
          Approx(c.plan.stores.pivot.table_offset_mm.y()).margin(1e-6));
    REQUIRE(notes.size() == 1);
    CHECK(notes[0].find("19704") != std::string::npos);
}

TEST_CASE("prints that do not suit are refused with their place") {
    SeededNoise noise(10);
    const std::string good =
        random_case("bc_table.toml", noise, pivot::PivotGroup::g54, 0.1).printed;
    const auto has = [](const std::string& text, const std::string& part) {
        CAPTURE(text);
        CHECK(text.find(part) != std::string::npos);
    };
    CHECK(refusal(good) == "accepted");
    has(refusal("nothing here\n"), "no prints of the pivot programs");
    has(refusal(replaced(good, "AXES B C", "AXES A C")), "prints of another machine");
    has(refusal(replaced(good, "RTCP END\n", "")), "RTCP has no END");
    has(refusal(good + good), "stands twice");
    has(refusal(replaced(good, "PIVOT TW AXES B C MAPS 1 TO 4\n", "")), "TW has no head");
    has(refusal(replaced(good, "MAPS 1 TO 4", "MAPS 1 TO 5")), "map 5 of DPP is missing");
    has(refusal(replaced(good, "N19704 V", "N19704 W")), "V is missing");
    has(refusal(replaced(good, "DPP MAP1 B-60.0000", "DPP MAP1 B-59.0000")), "indexation");
    std::string inch = good;
    const auto at = inch.find("DPP MAP1 B-60.0000");
    inch.replace(inch.find('X', at), 2, "X99.");
    has(refusal(inch), "another unit or another machine");
    CHECK(refusal(inch).find("print.txt:") == 0);
}
