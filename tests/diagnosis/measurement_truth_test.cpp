// What a ready measurement promises: the bar keeps its length on the way, and a rival that no
// reading tells apart stays one.
#include <catch2/catch.hpp>

#include "diagnosis/advice/measurements.h"
#include "diagnosis/advice/next_measurement.h"
#include "emulator/run.h"
#include "interpreter/program_folders.h"
#include "tests/support/campaign.h"

namespace trunnion {
namespace {

/// A catalogue effect with its linear parameters, as a claim or as a rival.
diagnosis::ColumnGroup group_of(const diagnosis::Prepared& prepared, const std::string& name) {
    diagnosis::ColumnGroup group;
    group.name = name;
    group.effect = effects::find_effect(prepared.catalogue, name);
    REQUIRE(group.effect);
    group.keys = group.effect->zeros();
    for (std::size_t j = 0; j < group.effect->parameters.size(); ++j) group.parameters.push_back(j);
    group.features.assign(group.parameters.size(), 0);  // counts the columns
    return group;
}

}  // namespace

TEST_CASE("the bar keeps its length between the samples of a turn", "[diagnosis][next]") {
    setup::Setup setup = campaign::bc_setup();
    setup.ballbar->noise_um = 0.0;
    // Half way between two samples, 2.5 degrees, the axes move along a chord.
    const double longest_mm = 175.0, chord_mm = longest_mm * (1.0 - std::cos(rad_from_deg(1.25)));
    for (const diagnosis::Measurement& m : diagnosis::ready_measurements(setup, 0.0)) {
        if (m.name != "ballbar_turns") continue;
        std::string program = m.program;
        const std::string coarse = "SAMPLE*5", fine = "SAMPLE*1";
        for (std::size_t at = 0; (at = program.find(coarse, at)) != std::string::npos;)
            program.replace(at, coarse.size(), fine);
        interpreter::ProgramFolders folders({std::string(TRUNNION_SOURCE_DIR) + "/programs"});
        const interpreter::ProgramText text{"O8900", program, {}};
        const emulator::RunLog log = emulator::run_program(setup, folders, text, {});
        REQUIRE_FALSE(log.result.alarm);
        double most_mm = 0.0;
        int turning = 0;
        for (const records::Reading& row : log.readings.rows) {
            if (!row.value_mm || !row.test.starts_with("turn_")) continue;
            ++turning;
            most_mm = std::max(most_mm, std::abs(*row.value_mm));
        }
        CHECK(turning > 1000);
        CHECK(most_mm > 0.2 * chord_mm);
        CHECK(most_mm < chord_mm);
    }
}

TEST_CASE("a measurement is promised where it tells a rival apart, and not where nothing does",
          "[diagnosis][next]") {
    const setup::Setup setup = campaign::bc_setup();
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_sphere_map(table, setup, 30, 5);
    const records::ReadingTable readings = campaign::measured(setup, table, 3);
    const diagnosis::Prepared prepared = diagnosis::prepare(setup, readings);
    const diagnosis::ColumnGroup claimed = group_of(prepared, "C.backlash"),
                                 other = group_of(prepared, "XY.squareness");
    const Eigen::VectorXd values = Eigen::VectorXd::Constant(claimed.columns(), 2.0);
    const auto planned = [&](const diagnosis::ColumnGroup& rival) {
        const auto plan = diagnosis::plan_next(prepared, {}, {{&claimed, values, &rival}}, {});
        REQUIRE(plan.size() == 1);
        return plan.front();
    };
    const diagnosis::NextMeasurement itself = planned(claimed);
    CHECK(itself.program.empty());
    CHECK_THAT(itself.text, Catch::StartsWith("no ready measurement tells"));
    const diagnosis::NextMeasurement told = planned(other);
    CHECK_FALSE(told.program.empty());
    CHECK(told.log_bayes_factor > 3.0);
}

}  // namespace trunnion
