// What next: the programs do what was predicted, and what they read tells the rivals apart.

#include <catch2/catch.hpp>
#include <set>

#include "diagnosis/advice/measurements.h"
#include "diagnosis/diagnosis.h"
#include "emulator/run.h"
#include "identification/identify.h"
#include "interpreter/program_folders.h"
#include "records/samples.h"
#include "tests/support/campaign.h"
#include "tests/support/said.h"

namespace trunnion {
namespace {

/// Runs a measurement's program on the emulated control of `machine`.
records::ReadingTable run_measurement(const setup::Setup& machine, const std::string& program,
                                      std::uint64_t seed) {
    interpreter::ProgramFolders folders({std::string(TRUNNION_SOURCE_DIR) + "/programs"});
    emulator::RunOptions options;
    options.seed = seed;
    options.effects = effects::active_models(machine);
    const interpreter::ProgramText text{"O8900", program, {}};
    emulator::RunLog log = emulator::run_program(machine, folders, text, options);
    INFO((log.result.alarm ? log.result.alarm->text + " in " + log.result.alarm->block : ""));
    REQUIRE(log.result.status == controller::RunStatus::ok);
    return std::move(log.readings);
}

std::vector<std::size_t> device_rows(const records::ReadingTable& table) {
    std::vector<std::size_t> rows;
    for (std::size_t i = 0; i < table.rows.size(); ++i)
        if (table.rows[i].device != records::Device::none) rows.push_back(i);
    return rows;
}

/// Rows that differ in what a prediction depends on, time aside.
void require_same_rows(const diagnosis::Measurement& planned, const records::ReadingTable& run) {
    const auto a = device_rows(planned.table), b = device_rows(run);
    INFO(planned.name);
    REQUIRE(a.size() == b.size());
    const auto sa = records::samples_of(planned.table), sb = records::samples_of(run);
    for (std::size_t i = 0; i < a.size(); ++i) {
        const records::Reading &p = planned.table.rows[a[i]], &r = run.rows[b[i]];
        INFO("reading " << i << " of test " << r.test << " line " << p.test);
        REQUIRE(p.device == r.device);
        REQUIRE(p.feature == r.feature);
        REQUIRE(p.mode == r.mode);
        REQUIRE(p.test == r.test);
        for (const Axis axis : planned.table.axes) {
            INFO("axis " << letter_of(axis));
            REQUIRE(p.commanded[axis] == Approx(r.commanded[axis]).margin(2e-4));
            if (p.device == records::Device::touch)
                REQUIRE(static_cast<int>(sa[a[i]].travel[index_of(axis)]) ==
                        static_cast<int>(sb[b[i]].travel[index_of(axis)]));
        }
        if (p.device == records::Device::touch)
            REQUIRE((p.direction_M - r.direction_M).norm() < 1e-5);
        REQUIRE(p.spindle_rad == Approx(r.spindle_rad));
        REQUIRE(p.temperature_c == r.temperature_c);
        REQUIRE(p.load_kg == r.load_kg);
        REQUIRE(p.clamped == r.clamped);
        REQUIRE(p.extension_mm == r.extension_mm);
    }
}

/// What the run read is what a replay of its rows predicts.
void require_predicted(const setup::Setup& machine, const records::ReadingTable& run) {
    const records::ReadingTable replayed =
        emulator::predicted(machine, run, effects::active_models(machine));
    for (std::size_t i = 0; i < run.rows.size(); ++i)
        if (run.rows[i].value_mm) {
            INFO(run.rows[i].test << " row " << i);
            REQUIRE(*run.rows[i].value_mm == Approx(*replayed.rows[i].value_mm).margin(1e-6));
        }
}

setup::Setup shipped(const char* name) {
    std::vector<std::string> notes;
    return setup::load_setup(std::string(TRUNNION_SOURCE_DIR) + "/machines/" + name, notes);
}

/// bc_table.toml holds wrong stores on purpose.
void tell_truth(setup::Setup& setup) {
    for (const Axis axis : {Axis::X, Axis::Y, Axis::Z}) setup.stores.work.standard[0][axis] = 0.0;
    if (setup.name == "BC rotary table")
        for (int n = 19700; n <= 19705; ++n) setup.stores.parameters.set(n, 0.0);
}

}  // namespace

TEST_CASE("every program of the list reads the rows that were predicted", "[diagnosis][next]") {
    setup::Setup isnc = shipped("ac_trunnion.toml");
    isnc.dialect = interpreter::hurco_dialect();
    setup::Setup bnc = isnc;
    bnc.hurco.bnc = true;
    for (setup::Setup setup : {campaign::bc_setup(), campaign::ac_setup(), shipped("bc_table.toml"),
                               shipped("ac_trunnion.toml"), isnc, bnc}) {
        INFO(setup.name);
        setup.machine.errors = {};
        tell_truth(setup);
        const auto list = diagnosis::ready_measurements(setup, 100.0);
        REQUIRE(list.size() == 14);
        setup.probe->repeatability_um = setup.ballbar->noise_um = 0.0;
        for (const diagnosis::Measurement& m : list) {
            CAPTURE(m.name, setup.hurco.bnc);
            const records::ReadingTable run = run_measurement(setup, m.program, 1);
            require_same_rows(m, run);
            require_predicted(setup, run);
        }
    }
}

TEST_CASE("a planned measurement knows from which side every axis comes to its first reading",
          "[diagnosis][next]") {
    for (const setup::Setup& setup : {campaign::bc_setup(), campaign::ac_setup()})
        for (const diagnosis::Measurement& m : diagnosis::ready_measurements(setup, 100.0)) {
            const std::size_t first = device_rows(m.table).front();
            const AxisSample at = records::samples_of(m.table)[first];
            for (const Axis axis : m.table.axes) {
                INFO(setup.name << " " << m.name << " " << letter_of(axis));
                CHECK_FALSE(at.side_unknown[index_of(axis)]);
                // Out and back: the way into the last position is not all that the axis moved.
                double way = 0.0, last = 0.0;
                for (std::size_t k = 0; k < first; ++k) {
                    const double q = m.table.rows[k].commanded[axis];
                    way += std::abs(q - last);
                    last = q;
                }
                if (axis != Axis::Z) CHECK(way > std::abs(last) + 1e-6);
            }
        }
}

TEST_CASE("the clock of a planned measurement only goes on, from the time that was given",
          "[diagnosis][next]") {
    for (const diagnosis::Measurement& m :
         diagnosis::ready_measurements(campaign::bc_setup(), 100.0)) {
        double now_s = 100.0;
        for (const records::Reading& row : m.table.rows) {
            INFO(m.name << " " << row.test << " " << row.feature);
            REQUIRE(row.time_s >= now_s);
            now_s = row.time_s;
        }
        CHECK(now_s > 100.0);
    }
}

namespace {

struct Bench {
    setup::Setup setup, real;
    records::ReadingTable table;
    Bench(const setup::Setup& machine, bool ballbar)
        : setup(machine),
          real(campaign::real_machine(machine)),
          table(campaign::empty_table(machine)) {
        ballbar ? campaign::add_ballbar(table, setup, 36)
                : campaign::add_sphere_map(table, setup, 70, 5);
        real.probe->repeatability_um = 0.8;
        real.ballbar->noise_um = 0.3;
    }
};

std::string names(const std::vector<std::string>& list) {
    std::string text;
    for (const std::string& name : list) text += name + ' ';
    return text;
}

}  // namespace

namespace {

/// Weighted squares left when `effect` (with the location) is fitted.
double left_by(const Bench& bench, const records::ReadingTable& table, const std::string& effect) {
    const identification::Identification fit =
        identification::identify(bench.setup, table, {"location", effect});
    const records::ReadingTable read =
        emulator::predicted(fit.setup, table, effects::active_models(fit.setup));
    double sum = 0.0;
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        if (!table.rows[i].value_mm) continue;
        const double sigma_um = table.rows[i].device == records::Device::ballbar ? 0.3 : 0.8;
        sum += std::pow(1e3 * (*table.rows[i].value_mm - *read.rows[i].value_mm) / sigma_um, 2);
    }
    return sum;
}

bool lists(const std::vector<std::string>& list, const std::string& name) {
    return std::find(list.begin(), list.end(), name) != list.end();
}

struct Pair {
    bool ac, ballbar;
    const char *truth, *other;  ///< injections; each is the truth in turn
};

std::string name_of_effect(const std::string& injection) {
    return injection.substr(0, injection.find_first_of(":="));
}

/// From ambiguous readings through the program that was asked for to one claim.
void go_the_whole_way(const Bench& bench, const std::string& injection, const std::string& rival,
                      std::uint64_t seed) {
    const std::string right = name_of_effect(injection), wrong = name_of_effect(rival);
    INFO(bench.setup.chain_text << ": " << injection << " against " << wrong);
    const setup::Setup truth = campaign::with_effect(bench.real, injection);
    const records::ReadingTable first = campaign::measured(truth, bench.table, seed);
    const diagnosis::Diagnosis before = diagnosis::diagnose(bench.setup, first);
    REQUIRE(before.verdict == diagnosis::Verdict::ambiguous);
    REQUIRE(before.causes.size() == 1);
    const diagnosis::Cause& claim = before.causes.front();
    INFO("first " << claim.effect << " rivals " << names(claim.rivals));
    REQUIRE((claim.effect == right || lists(claim.rivals, right)));
    REQUIRE((claim.effect == wrong || lists(claim.rivals, wrong)));
    const diagnosis::NextMeasurement* next = nullptr;
    for (const diagnosis::NextMeasurement& n : before.next)
        if (!next && !n.program.empty() && (lists({n.first, n.second}, right))) next = &n;
    REQUIRE(next);
    INFO(next->text);
    const records::ReadingTable all =
        records::join_readings({first, run_measurement(truth, next->program, seed + 1)});
    const diagnosis::Diagnosis after = diagnosis::diagnose(bench.setup, all);
    INFO("then " << after.causes.front().effect << " rivals "
                 << names(after.causes.front().rivals));
    REQUIRE(after.causes.size() == 1);
    CHECK(after.causes.front().effect == right);
    const std::string other = next->first == right ? next->second : next->first;
    if (next->settles) CHECK_FALSE(lists(after.causes.front().rivals, other));
    // What was predicted came true: half the chi-squared that the other one loses more than before.
    const double achieved = 0.5 * (left_by(bench, all, other) - left_by(bench, all, right) -
                                   left_by(bench, first, other) + left_by(bench, first, right));
    INFO("predicted " << next->log_bayes_factor << " achieved " << achieved);
    CHECK(achieved > 0.5 * next->log_bayes_factor);
    CHECK(achieved < 2.0 * next->log_bayes_factor);
}

}  // namespace

TEST_CASE("the verdict is the same without the plan of the next measurement", "[diagnosis][next]") {
    const Bench bench(campaign::bc_setup(), false);
    const setup::Setup truth = campaign::with_effect(bench.real, "ZX.squareness: angle_rad=6e-5");
    const records::ReadingTable table = campaign::measured(truth, bench.table, 17);
    const diagnosis::Diagnosis whole = diagnosis::diagnose(bench.setup, table);
    REQUIRE(whole.next.size() > 0);
    std::vector<std::string> stages;
    int asked = 0;
    diagnosis::DiagnosisOptions options;
    options.watch = [&](const char* stage) { stages.emplace_back(stage); };
    options.plan_on = [&] { return ++asked < 3; };
    const diagnosis::Diagnosis cut = diagnosis::diagnose(bench.setup, table, options);
    CHECK(asked == 3);
    CHECK(stages.back().starts_with("the next measurement"));
    CHECK(cut.next.empty());
    CHECK(cut.verdict == whole.verdict);
    REQUIRE(cut.causes.size() == whole.causes.size());
    CHECK(cut.causes[0].effect == whole.causes[0].effect);
    CHECK(cut.causes[0].heldout.low == whole.causes[0].heldout.low);
}

TEST_CASE("ambiguous, measured as asked, diagnosed together: the right one is claimed",
          "[diagnosis][next]") {
    const Pair pairs[] = {
        {false, false, "pivot.g54: dg_mm=[0.005, 0.004, -0.006]",
         "pivot.p1970x: dp_mm=[-0.005, -0.004, 0.006]"},
        {true, false, "pivot.g54: dg_mm=[0.005, 0.004, -0.006]",
         "pivot.p1970x: dp_mm=[-0.005, -0.004, 0.006]"},
        // X, which carries Y and Z, shows its angles in their travel; Z carries the tool alone.
        {false, false, "ZX.squareness: angle_rad=6e-5", "Z.angular: EBZ_p1_rad=8e-5"},
        {true, false, "ZX.squareness: angle_rad=6e-5", "Z.angular: EBZ_p1_rad=8e-5"},
        {false, true, "ZX.squareness: angle_rad=4e-5", "Z.angular: EBZ_p1_rad=6e-5"},
        {true, true, "ZX.squareness: angle_rad=4e-5", "Z.angular: EBZ_p1_rad=6e-5"},
    };
    std::uint64_t seed = 7;
    for (const Pair& pair : pairs) {
        const Bench bench(pair.ac ? campaign::ac_setup() : campaign::bc_setup(), pair.ballbar);
        go_the_whole_way(bench, pair.truth, pair.other, seed += 10);
        go_the_whole_way(bench, pair.other, pair.truth, seed += 10);
    }
}

// 14,000 readings are thinned; the few touches that were asked for must not be.
TEST_CASE("what is asked for after a long ballbar test settles the matter", "[diagnosis][next]") {
    const setup::Setup known = campaign::bc_setup();
    const setup::Setup real =
        campaign::with_effect(known, "B.radial: EXB_cos2_mm=0.004, EZB_sin2_mm=0.003");
    records::ReadingTable bar = campaign::empty_table(known);
    campaign::add_ballbar(bar, known, 600);
    REQUIRE(bar.rows.size() > 10000);
    const records::ReadingTable first = campaign::measured(real, bar, 11);
    const diagnosis::Diagnosis before = diagnosis::diagnose(known, first);
    REQUIRE_FALSE(before.causes.empty());
    UNSCOPED_INFO(said(before));
    CHECK(before.causes.front().effect == "B.radial");
    CHECK_FALSE(before.causes.front().rivals.empty());
    REQUIRE_FALSE(before.next.empty());
    CHECK(before.next.front().settles);
    const records::ReadingTable second = run_measurement(real, before.next.front().program, 12);
    const diagnosis::Diagnosis after =
        diagnosis::diagnose(known, records::join_readings({first, second}));
    REQUIRE_FALSE(after.causes.empty());
    UNSCOPED_INFO(said(after));
    CHECK(after.causes.front().effect == "B.radial");
    const std::vector<std::string>& left = after.causes.front().rivals;
    CHECK(std::find(left.begin(), left.end(), before.next.front().second) == left.end());
}

}  // namespace trunnion
