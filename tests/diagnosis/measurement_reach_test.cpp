// The next measurements on machines with little room, without a device, with clamps of their own.
#include <catch2/catch.hpp>
#include <set>

#include "diagnosis/advice/measurements.h"
#include "emulator/run.h"
#include "interpreter/program_folders.h"
#include "tests/support/campaign.h"

namespace trunnion {
namespace {

using Measurements = std::vector<diagnosis::Measurement>;

setup::Setup true_setup() {
    setup::Setup setup = campaign::bc_setup();
    setup.probe->repeatability_um = setup.ballbar->noise_um = 0.0;
    return setup;
}

kinematics::AxisGeometry& axis_of(setup::Setup& setup, Axis axis) {
    for (auto* list : {&setup.machine.chain.work, &setup.machine.chain.tool})
        for (kinematics::AxisGeometry& geometry : *list)
            if (geometry.axis == axis) return geometry;
    throw std::logic_error("no such axis");
}

std::set<std::string> names_of(const Measurements& list) {
    std::set<std::string> names;
    for (const diagnosis::Measurement& m : list) names.insert(m.name);
    return names;
}

std::size_t readings_of(const Measurements& list, const std::string& name) {
    for (const diagnosis::Measurement& m : list)
        if (m.name == name)
            return static_cast<std::size_t>(
                std::count_if(m.table.rows.begin(), m.table.rows.end(),
                              [](const auto& row) { return row.device != records::Device::none; }));
    return 0;
}

void require_within_travel(const setup::Setup& setup, const Measurements& list) {
    for (const diagnosis::Measurement& m : list)
        for (const records::Reading& row : m.table.rows)
            for (const kinematics::AxisGeometry& axis : setup.machine.chain.axes()) {
                INFO(m.name << " " << axis.name << " " << row.commanded[axis.axis]);
                if (axis.min) REQUIRE(row.commanded[axis.axis] >= *axis.min - 1e-9);
                if (axis.max) REQUIRE(row.commanded[axis.axis] <= *axis.max + 1e-9);
            }
}

/// The alarm that a program ends with on the emulated control; empty: none.
std::string alarm_of(const setup::Setup& setup, const diagnosis::Measurement& m) {
    interpreter::ProgramFolders folders({std::string(TRUNNION_SOURCE_DIR) + "/programs"});
    const interpreter::ProgramText text{"O8900", m.program, {}};
    const emulator::RunLog log = emulator::run_program(setup, folders, text, {});
    return log.result.alarm ? log.result.alarm->text + " in " + log.result.alarm->block : "";
}

}  // namespace

TEST_CASE("a machine with little room is asked only what it reaches, and its programs run",
          "[diagnosis][next]") {
    const Measurements wide = diagnosis::ready_measurements(true_setup(), 0.0);
    setup::Setup setup = true_setup();
    const auto limit = [&](Axis axis, double low, double high) {
        axis_of(setup, axis).min = low;
        axis_of(setup, axis).max = high;
    };
    limit(Axis::X, -260.0, 200.0);
    limit(Axis::Y, -200.0, 200.0);
    limit(Axis::Z, -50.0, 480.0);
    SECTION("of the linear axes") {}
    SECTION("of the tilt") {
        limit(Axis::B, rad_from_deg(-15.0), rad_from_deg(30.0));
    }
    SECTION("of a table that turns less than once") {
        limit(Axis::C, rad_from_deg(-10.0), rad_from_deg(190.0));
    }
    SECTION("of a tilt that begins at zero") {
        limit(Axis::B, 0.0, rad_from_deg(95.0));
    }
    const Measurements list = diagnosis::ready_measurements(setup, 0.0);
    REQUIRE_FALSE(list.empty());
    require_within_travel(setup, list);
    std::size_t fewer = 0;
    for (const diagnosis::Measurement& m : wide) {
        CHECK(readings_of(list, m.name) <= readings_of(wide, m.name));
        fewer += readings_of(list, m.name) < readings_of(wide, m.name) ? 1 : 0;
    }
    CHECK(fewer >= 3);
    for (const diagnosis::Measurement& m : list) {
        INFO(m.name);
        CHECK(alarm_of(setup, m) == "");
    }
}

TEST_CASE("without room, a device, an artefact or a second rotary axis nothing is asked",
          "[diagnosis][next]") {
    setup::Setup setup = true_setup();
    const auto names = [&] { return names_of(diagnosis::ready_measurements(setup, 0.0)); };
    const std::set<std::string> bar{"ballbar_planes", "long_cup", "ballbar_turns"};
    CHECK(names().size() == 14);
    SECTION("no probe") {
        setup.probe.reset();
        CHECK(names() == bar);
        for (const diagnosis::Measurement& m : diagnosis::ready_measurements(setup, 0.0))
            CHECK(alarm_of(setup, m) == "");
    }
    SECTION("no sphere") {
        std::erase_if(setup.artefacts, [](const auto& a) { return a.name != "P1"; });
        CHECK(names() == bar);
    }
    SECTION("no ballbar") {
        setup.ballbar.reset();
        CHECK(names().size() == 11);
        for (const std::string& name : bar) CHECK_FALSE(names().contains(name));
    }
    SECTION("no pivot") {
        std::erase_if(setup.artefacts, [](const auto& a) { return a.name == "P1"; });
        CHECK(names().size() == 11);
    }
    SECTION("no room for a sphere anywhere") {
        axis_of(setup, Axis::X).min = -1.0;
        axis_of(setup, Axis::X).max = 1.0;
        for (const std::string& name : names()) CHECK(bar.contains(name));
    }
    SECTION("one rotary axis") {
        std::erase_if(setup.machine.chain.work, [](const auto& a) { return a.axis == Axis::C; });
        CHECK(names().empty());
    }
    SECTION("a tilt without limits is turned by 80 degrees at most") {
        axis_of(setup, Axis::B).min.reset();
        axis_of(setup, Axis::B).max.reset();
        double most = 0.0;
        for (const diagnosis::Measurement& m : diagnosis::ready_measurements(setup, 0.0))
            for (const records::Reading& row : m.table.rows)
                if (row.device != records::Device::none)
                    most = std::max(most, std::abs(deg_from_rad(row.commanded[Axis::B])));
        CHECK(most <= 80.0 + 1e-9);
        CHECK(most > 70.0);
    }
    SECTION("no Z, or an axis without a letter") {
        for (const Axis axis : {Axis::X, Axis::Y, Axis::Z}) {
            setup = true_setup();
            std::erase_if(setup.machine.chain.tool, [&](const auto& a) { return a.axis == axis; });
            CHECK(names().empty());
        }
        setup = true_setup();
        axis_of(setup, Axis::X).name = "Q1";
        CHECK(names().empty());
    }
}

TEST_CASE("with a rotary axis in the head nothing is asked of G54, the rest runs",
          "[diagnosis][next]") {
    std::vector<std::string> notes;
    const setup::Setup setup =
        setup::load_setup(std::string(TRUNNION_SOURCE_DIR) + "/machines/head_head.toml", notes);
    const Measurements list = diagnosis::ready_measurements(setup, 0.0);
    CHECK_FALSE(names_of(list).contains("two_modes"));
    CHECK(names_of(list).contains("both_ways"));
    require_within_travel(setup, list);
}

TEST_CASE("clamps are closed by the machine's own codes, else by the operator",
          "[diagnosis][next]") {
    setup::Setup setup = true_setup();
    const auto clamped = [&] {
        for (const diagnosis::Measurement& m : diagnosis::ready_measurements(setup, 0.0))
            if (m.name == "clamped") return m;
        throw std::logic_error("no measurement");
    };
    setup.clamps.clear();
    CHECK_THAT(clamped().program,
               Catch::Contains("M0 (CLOSE THE CLAMPS)") && Catch::Contains("M0 (OPEN THE CLAMPS)"));
    setup.clamps.push_back({Axis::C, 68, 69});
    const diagnosis::Measurement m = clamped();
    CHECK_THAT(m.program, Catch::Contains("\nM68\nDPRNT[CLAMPED*1]\n") &&
                              Catch::Contains("\nM69\nDPRNT[CLAMPED*0]\n") &&
                              !Catch::Contains("THE CLAMPS)"));
    CHECK(alarm_of(setup, m) == "");
}

}  // namespace trunnion
