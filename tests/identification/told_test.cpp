// Identifications of drawn machines as they were said: a change of any of them shows
// (tests/support/told.h). What they ought to say is judged by the other tests.
#include "tests/support/told.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "emulator/replay.h"
#include "identification/identify.h"
#include "identification/monte_carlo.h"
#include "identification/sensitivity.h"
#include "report/identification_report.h"
#include "tests/identification/arm.h"
#include "tests/support/campaign.h"
#include "tests/support/drawn_effects.h"
#include "tests/support/measured_machines.h"

namespace trunnion {
namespace {

using Names = std::vector<std::string>;

/// An identification under the number of its case with its covariance and what its setup predicts:
/// in one line, or each value where `whole`.
void tell(const identification::Identification& fitted, const records::ReadingTable& table,
          std::uint64_t number, Names& lines, bool whole = true) {
    told::Json json = told::Json::parse(report::identification_json(fitted));
    lines.push_back(fmt::format("== {} {}", number, told::brief(json)));
    for (const double value_mm :
         emulator::Replay(fitted.setup, table).predict(effects::active_models(fitted.setup)))
        json["predicted_um"].push_back(1e3 * value_mm);
    for (Eigen::Index k = 0; k < fitted.covariance.rows(); ++k)
        json["deviations"].push_back(1e3 * std::sqrt(std::max(0.0, fitted.covariance(k, k))));
    if (whole)
        told::add_lines(json, "", lines);
    else
        lines.push_back(told::brief(json));
}

records::ReadingTable small_campaign(const setup::Setup& setup, std::uint64_t seed) {
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_sphere_map(table, setup, 30, seed);
    campaign::add_ballbar(table, setup, 16);
    return table;
}

/// The effects that were put in, each once.
Names names_of(const setup::Setup& truth) {
    Names names{"location"};
    for (const setup::EffectSetting& effect : truth.effects)
        if (std::find(names.begin(), names.end(), effect.name) == names.end())
            names.push_back(effect.name);
    return names;
}

}  // namespace

TEST_CASE("told: drawn effects fitted, with B and C, and with A and C", "[identification][told]") {
    Names lines;
    for (std::uint64_t seed = 1; seed <= 30; ++seed) {
        const setup::Setup setup = seed % 2 ? campaign::bc_setup() : campaign::ac_setup();
        const records::ReadingTable table = small_campaign(setup, seed);
        const setup::Setup truth = with_drawn_effects(campaign::real_machine(setup), table,
                                                      static_cast<int>(seed % 4), seed);
        const records::ReadingTable read = campaign::measured(truth, table, seed);
        tell(identification::identify(setup, read, names_of(truth)), read, seed, lines,
             seed % 5 == 0);
    }
    told::check_told("identification", "drawn", lines);
}

TEST_CASE("told: effects fitted that are not there", "[identification][told]") {
    Names lines;
    for (std::uint64_t seed = 31; seed <= 42; ++seed) {
        const setup::Setup setup = campaign::bc_setup();
        const records::ReadingTable table = small_campaign(setup, seed);
        const setup::Setup truth =
            with_drawn_effects(campaign::real_machine(setup), table, 1, seed);
        const Names names = names_of(with_drawn_effects(setup, table, 2, seed + 1000));
        const records::ReadingTable read = campaign::measured(truth, table, seed);
        tell(identification::identify(setup, read, names), read, seed, lines, seed % 3 == 0);
    }
    told::check_told("identification", "others", lines);
}

TEST_CASE("told: sides that nothing tells, and two days", "[identification][told]") {
    Names lines;
    for (std::uint64_t seed = 51; seed <= 62; ++seed) {
        setup::Setup setup = campaign::bc_setup();
        const Names names{"location", "B.backlash", seed % 2 ? "C.backlash" : "X.backlash"};
        setup::Setup truth = campaign::with_effect(
            campaign::real_machine(setup), seed % 2 ? "C.backlash=60urad" : "X.backlash=5um");
        const records::ReadingTable table = small_campaign(setup, seed);
        records::ReadingTable read = campaign::measured(truth, table, seed);
        read.side_before = {};
        if (seed % 3 == 0) {
            truth.ballbar->cup_S_mm += Vector3(0.02, -0.01, 0.005);
            records::ReadingTable later = campaign::measured(truth, table, seed + 1);
            for (records::Reading& row : read.rows) row.session = "a";
            for (records::Reading& row : later.rows) row.session = "b";
            read.optional_columns.push_back("session");
            later.optional_columns.push_back("session");
            read = records::join_readings({read, later});
        }
        tell(identification::identify(setup, read, names), read, seed, lines, seed % 3 == 0);
    }
    told::check_told("identification", "sides", lines);
}

TEST_CASE("told: repetitions", "[identification][told]") {
    Names lines;
    const setup::Setup setup = campaign::bc_setup();
    const records::ReadingTable table = small_campaign(setup, 51);
    const setup::Setup truth =
        campaign::with_effect(campaign::real_machine(setup), "C.backlash=60urad");
    const records::ReadingTable read = campaign::measured(truth, table, 51);
    const Names names{"location", "C.backlash", "B.cyclic"};
    identification::Identification fitted = identification::identify(setup, read, names);
    identification::RepetitionPlan plan;
    plan.runs = 6;
    identification::enter_spread(
        identification::repeat_identification(setup, read, names, plan, fitted), fitted);
    tell(fitted, read, 51, lines);
    told::check_told("identification", "repetitions", lines);
}

TEST_CASE("told: an arm", "[identification][told]") {
    Names lines;
    const setup::Setup setup = arm::setup(arm::ur5, 20.0);
    SeededNoise random(61);
    std::vector<arm::Pose> poses(80);
    for (arm::Pose& pose : poses) {
        for (double& q : pose.joints_deg) q = 240.0 * (random.uniform() - 0.5);
        auto turned = pose.joints_deg;
        turned[3] += 0.02;
        pose.measured_mm = arm::target_mm(arm::ur5, turned) +
                           0.02 * Vector3(random.normal(), random.normal(), random.normal());
    }
    const records::ReadingTable read = arm::table(setup, arm::ur5, poses);
    tell(identification::identify(setup, read, arm::kinematic_effects()), read, 61, lines);
    told::check_told("identification", "arm", lines);
}

TEST_CASE("told: shipped machines by a program that measures them", "[identification][told]") {
    Names lines;
    std::uint64_t seed = 81;
    for (const measured::Shipped& machine : measured::shipped_machines()) {
        const setup::Setup setup = measured::setup_of(measured::setup_text(machine));
        const measured::Program program = measured::programs_of(machine, setup).back();
        const setup::Setup truth =
            with_drawn_effects(setup, measured::run_of(setup, program, seed), 1, seed);
        const records::ReadingTable read = measured::run_of(truth, program, seed);
        Names names = names_of(truth);
        if (setup.machine.chain.axes().size() < 4) names.erase(names.begin());
        tell(identification::identify(setup, read, names), read, seed, lines, seed % 3 == 0);
        ++seed;
    }
    told::check_told("identification", "shipped", lines);
}

}  // namespace trunnion
