// Diagnoses of drawn machines as they were said: a change of any of them shows
// (tests/support/told.h). What they ought to say is judged by the other tests.
#include "tests/support/told.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "diagnosis/diagnosis.h"
#include "report/diagnosis_json.h"
#include "report/diagnosis_text.h"
#include "tests/identification/arm.h"
#include "tests/support/campaign.h"
#include "tests/support/drawn_effects.h"
#include "tests/support/laser_machine.h"
#include "tests/support/measured_machines.h"

namespace trunnion {
namespace {

using diagnosis::Diagnosis;

/// A diagnosis under the number of its case, and what the setup of --out predicts.
Diagnosis tell(const setup::Setup& setup, const records::ReadingTable& table, std::uint64_t number,
               std::vector<std::string>& lines, const diagnosis::DiagnosisOptions& options) {
    Diagnosis d = diagnosis::diagnose(setup, table, options);
    told::Json json = told::Json::parse(report::diagnosis_json(d));
    lines.push_back(fmt::format("== {} {}", number, told::brief(json)));
    // Tables of a cause in free form are long: they are in the brief line.
    for (told::Json& cause : json["causes"]) cause.erase("points");
    told::add_lines(json, "", lines);
    told::Json predicted;
    for (const double value_mm :
         emulator::Replay(d.setup, table).predict(effects::active_models(d.setup)))
        predicted.push_back(1e3 * value_mm);
    lines.push_back("setup.predicted_um = " + told::digest(predicted));
    return d;
}

Diagnosis tell(const setup::Setup& setup, const records::ReadingTable& table, std::uint64_t number,
               std::vector<std::string>& lines) {
    diagnosis::DiagnosisOptions options;
    options.plan_next = false;
    return tell(setup, table, number, lines, options);
}

records::ReadingTable small_campaign(const setup::Setup& setup, std::uint64_t seed) {
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_sphere_map(table, setup, 30, seed);
    campaign::add_ballbar(table, setup, 16);
    return table;
}

/// A smooth error of one motion of an axis, of 2 to 8 um or urad.
void add_form(setup::Setup& truth, SeededNoise& random) {
    const Axis axis = std::array{Axis::X, Axis::Y, Axis::Z, Axis::C}[random.bits() % 4];
    const std::size_t motion = random.bits() % (axis == Axis::C ? 3 : 6);
    kinematics::ErrorCurve& curve = truth.machine.errors.axis[index_of(axis)].motion[motion];
    const double reach = axis == Axis::C ? 2.0 * pi : 400.0;
    const double size = (2.0 + 6.0 * random.uniform()) * (motion < 3 ? 1e-3 : 1e-5);
    const double waves = 1.0 + 2.0 * random.uniform(), phase = 2.0 * pi * random.uniform();
    for (int k = -40; k <= 40; ++k) {
        const double part = k / 40.0;
        curve.at.push_back(part * reach);
        curve.value.push_back(size * (std::sin(waves * pi * part + phase) + part * part));
    }
}

/// Readings of a session, and the machine of a later one that has `count` effects more.
records::ReadingTable two_sessions(const setup::Setup& setup, int count, std::uint64_t seed) {
    const records::ReadingTable table = small_campaign(setup, seed);
    const setup::Setup before = campaign::real_machine(setup);
    std::vector<records::ReadingTable> all{
        campaign::measured(before, table, seed),
        campaign::measured(with_drawn_effects(before, table, count, seed), table, seed + 100)};
    for (std::size_t k = 0; k < 2; ++k) {
        for (records::Reading& row : all[k].rows) row.session = k == 0 ? "Monday" : "Friday";
        all[k].optional_columns.push_back("session");
    }
    return records::join_readings(all);
}

/// A line of a laser there and back, five times, at targets that are not evenly apart.
records::ReadingTable laser_line(const setup::Setup& setup, Axis axis) {
    records::ReadingTable table = campaign::empty_table(setup);
    for (int k = 0; k < 150; ++k) {
        const int place = k % 30 < 15 ? k % 30 : 29 - k % 30;
        records::Reading row;
        row.index = k;
        row.time_s = 8.0 * k;
        row.temperature_c = 20.0 + 0.004 * k;
        row.test = "line";
        row.feature = "R1";
        row.device = records::Device::linear;
        row.direction_M = Vector3::Unit(static_cast<Eigen::Index>(index_of(axis)));
        row.commanded[axis] = -280.0 + 40.0 * place + 3.0 * (place % 3);
        table.rows.push_back(row);
    }
    return table;
}

std::vector<arm::Pose> arm_poses(int count, std::uint64_t seed, double wave_rad) {
    SeededNoise random(seed);
    std::vector<arm::Pose> poses;
    for (int k = 0; k < count; ++k) {
        arm::Pose pose;
        for (double& q : pose.joints_deg) q = 240.0 * (random.uniform() - 0.5);
        auto turned = pose.joints_deg;
        turned[2] += deg_from_rad(wave_rad * std::cos(rad_from_deg(2.0 * turned[2])));
        pose.measured_mm = arm::target_mm(arm::ur5, turned) +
                           0.02 * Vector3(random.normal(), random.normal(), random.normal());
        poses.push_back(pose);
    }
    return poses;
}

}  // namespace

TEST_CASE("told: drawn effects on a machine with B and C", "[diagnosis][told]") {
    std::vector<std::string> lines;
    const setup::Setup setup = campaign::bc_setup();
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        const records::ReadingTable table = small_campaign(setup, seed);
        const setup::Setup truth = with_drawn_effects(campaign::real_machine(setup), table,
                                                      static_cast<int>(seed % 4), seed);
        tell(setup, campaign::measured(truth, table, seed), seed, lines);
    }
    told::check_told("diagnosis", "bc", lines);
}

TEST_CASE("told: drawn effects on a machine with A and C, in words", "[diagnosis][told]") {
    std::vector<std::string> lines;
    const setup::Setup setup = campaign::ac_setup();
    for (std::uint64_t seed = 21; seed <= 26; ++seed) {
        const records::ReadingTable table = small_campaign(setup, seed);
        const setup::Setup truth = with_drawn_effects(campaign::real_machine(setup), table,
                                                      static_cast<int>(1 + seed % 3), seed);
        const Diagnosis d = tell(setup, campaign::measured(truth, table, seed), seed, lines);
        std::istringstream text(report::diagnosis_text(d));
        for (std::string line; std::getline(text, line);) lines.push_back(line);
    }
    told::check_told("diagnosis", "ac", lines);
}

TEST_CASE("told: effects beside forms", "[diagnosis][told]") {
    std::vector<std::string> lines;
    const setup::Setup setup = campaign::bc_setup();
    for (std::uint64_t seed = 31; seed <= 34; ++seed) {
        const records::ReadingTable table = small_campaign(setup, seed);
        setup::Setup truth = with_drawn_effects(campaign::real_machine(setup), table, 1, seed);
        SeededNoise random(seed);
        for (int k = 0; k < 3; ++k) add_form(truth, random);
        tell(setup, campaign::measured(truth, table, seed), seed, lines);
    }
    told::check_told("diagnosis", "forms", lines);
}

TEST_CASE("told: outliers, too small a noise, zeros that scatter, sides that nothing tells",
          "[diagnosis][told]") {
    std::vector<std::string> lines;
    const setup::Setup setup = campaign::bc_setup();
    for (std::uint64_t seed = 41; seed <= 46; ++seed) {
        const records::ReadingTable table = small_campaign(setup, seed);
        const setup::Setup truth =
            with_drawn_effects(campaign::real_machine(setup), table, seed % 2 ? 1 : 2, seed);
        records::ReadingTable read =
            campaign::measured(truth, table, seed, seed % 3 == 0 ? 2.0 : 1.0);
        SeededNoise random(seed);
        std::string test;
        double zero_mm = 0.0;
        for (records::Reading& row : read.rows) {
            if (row.device == records::Device::none) continue;
            if (random.uniform() < 0.01) *row.value_mm += 0.05;
            if (seed % 3 != 1 || row.device != records::Device::ballbar) continue;
            if (row.test != test) zero_mm = 0.002 * random.normal();
            test = row.test;
            *row.value_mm += zero_mm;
        }
        if (seed % 3 == 2) read.side_before = {};
        tell(setup, read, seed, lines);
    }
    told::check_told("diagnosis", "spoiled", lines);
}

TEST_CASE("told: readings held out", "[diagnosis][told]") {
    std::vector<std::string> lines;
    const setup::Setup setup = campaign::bc_setup();
    for (std::uint64_t seed = 51; seed <= 54; ++seed) {
        const records::ReadingTable table = small_campaign(setup, seed);
        const setup::Setup truth = with_drawn_effects(campaign::real_machine(setup), table,
                                                      static_cast<int>(1 + seed % 2), seed);
        records::ReadingTable other = campaign::empty_table(setup);
        campaign::add_sphere_map(other, setup, 25, seed + 7);
        const records::ReadingTable held = campaign::measured(truth, other, seed + 1);
        diagnosis::DiagnosisOptions options;
        options.plan_next = false;
        options.holdout = &held;
        tell(setup, campaign::measured(truth, table, seed), seed, lines, options);
    }
    told::check_told("diagnosis", "heldout", lines);
}

TEST_CASE("told: changes between two sessions", "[diagnosis][told]") {
    std::vector<std::string> lines;
    const setup::Setup setup = campaign::bc_setup();
    for (std::uint64_t seed = 61; seed <= 64; ++seed) {
        diagnosis::DiagnosisOptions options;
        options.plan_next = false;
        options.over_sessions = seed % 2;
        tell(setup, two_sessions(setup, 1, seed), seed, lines, options);
    }
    told::check_told("diagnosis", "sessions", lines);
}

TEST_CASE("told: lines of a laser", "[diagnosis][told]") {
    std::vector<std::string> lines;
    const setup::Setup setup = laser_machine();
    for (std::uint64_t seed = 71; seed <= 78; ++seed) {
        const records::ReadingTable table = laser_line(setup, seed % 2 ? Axis::X : Axis::Y);
        setup::Setup truth = with_drawn_effects(setup, table, 1, seed);
        SeededNoise random(seed);
        add_form(truth, random);
        records::ReadingTable read =
            emulator::predicted(truth, table, effects::active_models(truth));
        for (records::Reading& row : read.rows) *row.value_mm += 4e-4 * random.normal();
        tell(setup, read, seed, lines);
    }
    told::check_told("diagnosis", "laser", lines);
}

TEST_CASE("told: an arm", "[diagnosis][told]") {
    std::vector<std::string> lines;
    setup::Setup setup = arm::setup(arm::ur5, 20.0);
    setup.model.modelled = arm::kinematic_effects();
    for (const double wave_rad : {0.0, 1e-4}) {
        const auto poses = arm_poses(90, 81, wave_rad);
        tell(setup, arm::table(setup, arm::ur5, poses), wave_rad > 0.0, lines);
    }
    told::check_told("diagnosis", "arm", lines);
}

TEST_CASE("told: what would be measured next", "[diagnosis][told]") {
    std::vector<std::string> lines;
    const setup::Setup setup = campaign::bc_setup();
    for (std::uint64_t seed = 91; seed <= 98; ++seed) {
        records::ReadingTable table = campaign::empty_table(setup);
        campaign::add_sphere_map(table, setup, 12, seed);
        const setup::Setup truth =
            with_drawn_effects(campaign::real_machine(setup), table, 2, seed);
        tell(setup, campaign::measured(truth, table, seed), seed, lines, {});
    }
    told::check_told("diagnosis", "next", lines);
}

TEST_CASE("told: shipped machines by a program that measures them", "[diagnosis][told]") {
    std::vector<std::string> lines;
    std::uint64_t seed = 101;
    for (const measured::Shipped& machine : measured::shipped_machines()) {
        const setup::Setup setup = measured::setup_of(measured::setup_text(machine));
        const measured::Program program = measured::programs_of(machine, setup).back();
        const setup::Setup truth =
            with_drawn_effects(setup, measured::run_of(setup, program, seed), 1, seed);
        tell(setup, measured::run_of(truth, program, seed), seed, lines);
        ++seed;
    }
    told::check_told("diagnosis", "shipped", lines);
}

}  // namespace trunnion
