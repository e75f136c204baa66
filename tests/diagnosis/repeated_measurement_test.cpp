// A laser has no NC program of ours: the next measurement is its own, with one thing changed. What
// is asked for is taken, for either rival as the truth, and tells them apart.
#include <catch2/catch.hpp>

#include "diagnosis/advice/measurement_repeats.h"
#include "diagnosis/diagnosis.h"
#include "effects/settings.h"
#include "emulator/replay.h"
#include "tests/support/campaign.h"
#include "tests/support/said.h"

namespace trunnion {
namespace {

setup::Setup mill(const std::string& more = "") {
    std::vector<std::string> notes;
    return setup::parse_setup(
        "[machine]\nname = \"mill\"\nchain = \"w X Y b Z t\"\n"
        "[machine.axis.Y]\nlimits_mm = [-30, 300]\n"
        "[[artefact]]\nname = \"R1\"\nkind = \"target\"\ntool_mm = [0, 0, -100]\n" +
            more + "[model]\nmodelled = []\nnoise_um = { linear = 0.8 }\n",
        "mill.toml", notes);
}

/// A reading and the move before it, past its place from the side of the run.
void add_target(records::ReadingTable& table, double x_mm, int side, bool run_up) {
    records::Reading row;
    row.index = static_cast<int>(table.rows.size());
    row.time_s = 10.0 * row.index;
    row.commanded[Axis::X] = x_mm - (run_up ? 2.0 * side : 0.0);
    row.test = "X";
    if (!run_up) {
        row.device = records::Device::linear;
        row.feature = "R1";
        row.direction_M = Vector3(1, 0, 0);
    }
    table.rows.push_back(row);
}

/// X along one line, three runs up and down.
records::ReadingTable laser_line() {
    records::ReadingTable table;
    table.path = "laser.csv";
    table.axes = {Axis::X, Axis::Y, Axis::Z};
    table.side_before.fill(1);
    for (int pass = 0; pass < 6; ++pass) {
        const int side = pass % 2 ? -1 : 1;
        for (int k = 0; k < 21; ++k) {
            const double x_mm = 20.0 * (side > 0 ? k : 20 - k);
            if (k == 0) add_target(table, x_mm, side, true);
            add_target(table, x_mm, side, false);
        }
    }
    return table;
}

const diagnosis::Measurement* asked_for(const std::vector<diagnosis::Measurement>& list,
                                        const diagnosis::NextMeasurement& next) {
    for (const diagnosis::Measurement& m : list)
        if (next.text.find(m.text) != std::string::npos) return &m;
    return nullptr;
}

const diagnosis::NextMeasurement* between(const diagnosis::Diagnosis& d, const std::string& a,
                                          const std::string& b) {
    for (const diagnosis::NextMeasurement& next : d.next)
        if ((next.first == a && next.second == b) || (next.first == b && next.second == a))
            return &next;
    return nullptr;
}

bool claims(const diagnosis::Diagnosis& d, const std::string& name) {
    return std::any_of(d.causes.begin(), d.causes.end(), [&](const diagnosis::Cause& c) {
        return c.effect == name && c.probability >= 0.5;
    });
}

bool has_rival(const diagnosis::Diagnosis& d, const std::string& name) {
    return std::any_of(d.causes.begin(), d.causes.end(), [&](const diagnosis::Cause& c) {
        return std::find(c.rivals.begin(), c.rivals.end(), name) != c.rivals.end();
    });
}

/// First and repeated readings of one machine, diagnosed together by `known`.
diagnosis::Diagnosis with_repeat(const setup::Setup& known, const setup::Setup& real,
                                 const records::ReadingTable& first,
                                 const diagnosis::Measurement& repeat) {
    return diagnosis::diagnose(
        known, records::join_readings({first, campaign::measured(real, repeat.table, 8)}));
}

}  // namespace

TEST_CASE("a laser on one line asks for a line beside it, which tells a scale from an angle",
          "[diagnosis][next]") {
    const setup::Setup known = mill();
    for (const char* truth : {"X.scale: scale_ppm=20", "X.angular: ECX_p1_rad=6e-5"}) {
        INFO(truth);
        const std::string right(truth, std::string(truth).find(':'));
        const std::string wrong = right == "X.scale" ? "X.angular" : "X.scale";
        const setup::Setup real = campaign::with_effect(known, truth);
        records::ReadingTable first = laser_line();
        // An angle has no arm on its own line through machine zero.
        for (records::Reading& row : first.rows) row.commanded[Axis::Y] = 150.0;
        first = campaign::measured(real, first, 7);
        const diagnosis::Diagnosis before = diagnosis::diagnose(known, first);
        const diagnosis::NextMeasurement* next = between(before, right, wrong);
        REQUIRE(next);
        INFO(next->text);
        CHECK(next->program.empty());
        CHECK(next->settles);
        const auto list = diagnosis::repeated_measurements(known, first, 1e4);
        const diagnosis::Measurement* repeat = asked_for(list, *next);
        REQUIRE(repeat);
        REQUIRE_FALSE(repeat->setup);  // a parallel line needs no other target
        const diagnosis::Diagnosis after = with_repeat(known, real, first, *repeat);
        CHECK(claims(after, right));
        CHECK_FALSE(claims(after, wrong));
        CHECK_FALSE(has_rival(after, wrong));
    }
}

TEST_CASE("a repeat that shows nothing new is not asked for", "[diagnosis][next]") {
    const setup::Setup known = mill();
    const records::ReadingTable first =
        campaign::measured(campaign::with_effect(known, "X.scale: scale_ppm=20"), laser_line(), 7);
    const diagnosis::Diagnosis d = diagnosis::diagnose(known, first);
    const diagnosis::NextMeasurement* next = between(d, "X.scale", "sensor.gain");
    REQUIRE(next);
    CHECK(next->text.find("to tell X.scale from sensor.gain: take a line along Y") == 0);
    CHECK(next->settles);
}

namespace {

/// A stage has no other axis.
setup::Setup stage(const std::string& more = "") {
    std::vector<std::string> notes;
    return setup::parse_setup(
        "[machine]\nname = \"stage\"\nchain = \"w X b t\"\n"
        "[[artefact]]\nname = \"R1\"\nkind = \"target\"\ntool_mm = [0, 0, -100]\n" +
            more + "[model]\nmodelled = []\nnoise_um = { linear = 0.8 }\n",
        "stage.toml", notes);
}

}  // namespace

// The first instrument is named nowhere; the setup learns of both when the second one comes.
TEST_CASE("a second instrument tells an axis from the first instrument", "[diagnosis][next]") {
    const setup::Setup known = stage();
    const setup::Setup both =
        stage("[[instrument]]\nname = \"old\"\n[[instrument]]\nname = \"new\"\n");
    for (const char* truth : {"X.scale: scale_ppm=20", "sensor.gain: gain_old_ppm=20"}) {
        INFO(truth);
        const std::string right(truth, std::string(truth).find(':'));
        const std::string wrong = right == "X.scale" ? "sensor.gain" : "X.scale";
        const setup::Setup real = campaign::with_effect(both, truth);
        records::ReadingTable first = laser_line();
        first.axes = {Axis::X};
        first = campaign::measured(real, first, 7);
        const diagnosis::Diagnosis before = diagnosis::diagnose(known, first);
        const diagnosis::NextMeasurement* next = between(before, right, wrong);
        REQUIRE(next);
        INFO(next->text);
        CHECK(next->text.find("with a second instrument") != std::string::npos);
        CHECK(next->text.find("--with instrument=NAME") != std::string::npos);
        CHECK(next->settles);
        const auto list = diagnosis::repeated_measurements(known, first, 1e4);
        const diagnosis::Measurement* asked = asked_for(list, *next);
        REQUIRE(asked);
        diagnosis::Measurement repeat = *asked;
        for (records::Reading& row : repeat.table.rows) row.instrument = "new";
        const diagnosis::Diagnosis after = with_repeat(both, real, first, repeat);
        INFO(said(after));
        REQUIRE(after.causes.size() == 1);
        CHECK(claims(after, right));
        CHECK_FALSE(has_rival(after, wrong));
        if (right == "sensor.gain")
            CHECK(after.causes.front().parameters.front().name == "gain_old_ppm");
    }
}

TEST_CASE("a line along another axis tells the scale of one from the stretch of all",
          "[diagnosis][next]") {
    const setup::Setup known = mill();
    for (const char* truth : {"X.scale: scale_ppm=20", "machine.expansion: stretch_ppm=20"}) {
        INFO(truth);
        const std::string right(truth, std::string(truth).find(':'));
        const std::string wrong = right == "X.scale" ? "machine.expansion" : "X.scale";
        const setup::Setup real = campaign::with_effect(known, truth);
        records::ReadingTable aside = laser_line();
        for (records::Reading& row : aside.rows) row.commanded[Axis::Z] = 200.0;
        const records::ReadingTable first =
            campaign::measured(real, records::join_readings({laser_line(), aside}), 7);
        const diagnosis::Diagnosis before = diagnosis::diagnose(known, first);
        INFO(said(before));
        const diagnosis::NextMeasurement* next = between(before, right, wrong);
        REQUIRE(next);
        INFO(next->text);
        CHECK(next->settles);
        const auto list = diagnosis::repeated_measurements(known, first, 1e4);
        const diagnosis::Measurement* repeat = asked_for(list, *next);
        REQUIRE(repeat);
        const diagnosis::Diagnosis after = with_repeat(known, real, first, *repeat);
        INFO(said(after));
        CHECK(claims(after, right));
        CHECK_FALSE(claims(after, wrong));
        CHECK_FALSE(has_rival(after, wrong));
    }
}

namespace {

bool are_rivals(const diagnosis::Diagnosis& d, const diagnosis::NextMeasurement& pair) {
    return std::any_of(d.causes.begin(), d.causes.end(), [&](const diagnosis::Cause& c) {
        const std::string& other = c.effect == pair.first ? pair.second : pair.first;
        return (c.effect == pair.first || c.effect == pair.second) &&
               std::find(c.rivals.begin(), c.rivals.end(), other) != c.rivals.end();
    });
}

/// X in one direction, on one line or on two.
records::ReadingTable sweeps(int count) {
    records::ReadingTable sweep = laser_line();
    sweep.rows.resize(22);
    for (records::Reading& row : sweep.rows) row.time_s *= 1.5;
    std::vector<records::ReadingTable> all(1, sweep);
    for (records::Reading& row : sweep.rows) row.commanded[Axis::Z] = 200.0;
    if (count > 1) all.push_back(sweep);
    return records::join_readings(std::move(all));
}

struct Swept {
    const char* truth;
    int lines;
};

}  // namespace

// Position and time are one in a sweep of one direction, and the time constant of a drift adapts
// itself to how long each sweep took: the places from both sides, as slowly, promise nothing.
TEST_CASE("what is asked for after sweeps of one direction ends at a scale or at a drift",
          "[diagnosis][next]") {
    const setup::Setup known = mill();
    for (const auto& [truth, lines] :
         {Swept{"X.scale: scale_ppm=29", 1}, Swept{"X.scale: scale_ppm=29", 2},
          Swept{"thermal.drift: d_mm=[0.02, 0, 0], tau_s=600", 1}}) {
        INFO(truth << " " << lines);
        const std::string right(truth, std::string(truth).find(':'));
        const setup::Setup real = campaign::with_effect(known, truth);
        records::ReadingTable all = campaign::measured(real, sweeps(lines), 7, 0.5);
        diagnosis::Diagnosis d = diagnosis::diagnose(known, all);
        std::uint64_t seed = 8;
        bool of_drift = false;
        while (d.verdict == diagnosis::Verdict::ambiguous && seed < 14) {
            const auto next =
                std::find_if(d.next.begin(), d.next.end(), [](const diagnosis::NextMeasurement& n) {
                    return n.first == "thermal.drift" || n.second == "thermal.drift";
                });
            const diagnosis::NextMeasurement asked = next == d.next.end() ? d.next.front() : *next;
            INFO(said(d) << '\n' << asked.text);
            of_drift = of_drift || next != d.next.end();
            REQUIRE(asked.settles);
            const auto list =
                diagnosis::repeated_measurements(known, all, all.rows.back().time_s + 600.0);
            const diagnosis::Measurement* repeat = asked_for(list, asked);
            REQUIRE(repeat);
            all =
                records::join_readings({all, campaign::measured(real, repeat->table, seed++, 0.5)});
            d = diagnosis::diagnose(known, all);
            CHECK_FALSE(are_rivals(d, asked));
        }
        INFO(said(d));
        CHECK(of_drift);
        CHECK(claims(d, right));
        CHECK(d.verdict == diagnosis::Verdict::explained);
    }
}

TEST_CASE("repeats stay within the travel, go on in time and hold no value", "[diagnosis][next]") {
    const setup::Setup known = mill();
    const auto list =
        diagnosis::repeated_measurements(known, campaign::measured(known, laser_line(), 7), 1e4);
    std::vector<std::string> names;
    for (const diagnosis::Measurement& m : list) {
        INFO(m.name);
        names.push_back(m.name);
        CHECK(m.minutes > 0.0);
        double now_s = 1e4;
        for (const records::Reading& row : m.table.rows) {
            CHECK(row.time_s >= now_s);
            now_s = row.time_s;
            CHECK_FALSE(row.value_mm);
            CHECK(row.commanded[Axis::Y] <= 300.0);
            CHECK(row.commanded[Axis::Y] >= -30.0);
        }
        CHECK(emulator::Replay(m.setup.value_or(known), m.table).size() >= 126);
    }
    CHECK(names == std::vector<std::string>{"parallel_Y", "parallel_Z", "parallel_all",
                                            "longer_tool", "both_sides", "denser", "reversed",
                                            "line_Y", "line_Z", "second_instrument"});
}

TEST_CASE("a probe and a ballbar have programs, and nothing is repeated", "[diagnosis][next]") {
    const setup::Setup setup = campaign::bc_setup();
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_sphere_map(table, setup, 10, 5);
    CHECK(diagnosis::repeated_measurements(setup, table, 0.0).empty());
}

}  // namespace trunnion
