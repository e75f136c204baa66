// The NC programs of the single-set-up test on the emulated control.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "ballbar/test/ballbar_fit.h"
#include "ballbar/test/ballbar_result.h"
#include "ballbar_runs.h"

using namespace trunnion;
using namespace trunnion::ballbar_test;

namespace {

ballbar::test::BallbarLayout layout_of(const setup::Setup& setup) {
    ballbar::test::BallbarLayout layout;
    layout.pivot_W_mm = setup.find_artefact("P1")->center_W_mm;
    layout.cup_S_mm = setup.ballbar->cup_S_mm;
    layout.length_mm = setup.ballbar->length_mm;
    return layout;
}

std::string file_text(const std::string& path) {
    std::ifstream in(path);
    std::ostringstream out;
    out << in.rdbuf();
    return out.str();
}

std::vector<std::string> split(const std::string& line) {
    std::vector<std::string> cells;
    std::istringstream in(line);
    for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
    return cells;
}

std::map<std::string, std::size_t> columns_of(const std::string& header) {
    std::map<std::string, std::size_t> out;
    for (const std::string& name : split(header)) out.emplace(name, out.size());
    return out;
}

double number(const std::string& text) {
    return std::stod(text);
}

std::vector<double> values_at(const records::ReadingTable& table,
                              const std::vector<std::size_t>& rows) {
    std::vector<double> out;
    for (const std::size_t i : rows) out.push_back(*table.rows[i].value_mm);
    return out;
}

/// Seven tests both ways, exact; every error found.
void check_single_run(setup::Setup setup, bool inside = false) {
    setup.ballbar->noise_um = 0.0;
    setup.ballbar->sample_hz = 5.0;
    const kinematics::Machine nominal = without_errors(setup.machine);
    const ballbar::test::BallbarLayout layout = layout_of(setup);
    const emulator::RunLog log = run(setup, test_program(setup, inside));
    require_no_alarm(log);
    const ballbar::test::BallbarModel model(nominal, layout, log.readings.rows, {});
    CHECK(model.passes().size() == 14);
    const ballbar::test::BallbarFit fit = model.fit(values_at(log.readings, model.rows_used()));
    CHECK(fit.rank == 12);
    CHECK(fit.rms_mm < 1e-10);
    for (const ballbar::test::ErrorEstimate& e : ballbar::test::chain_estimates(fit, 0.0)) {
        CAPTURE(to_string(e.name));
        CHECK(std::abs(e.value - setup.machine.errors.location(e.name)) <
              (e.name.angular() ? 1e-9 : 1e-6));
    }
}

struct Variant {
    const char* name;
    const char* setup;
    double length_mm;
    Vector3 pivot_mm;
    bool inside;
};

/// Machines, bars, places of the pivot and sides of the cup.
const std::vector<Variant> variants = {
    {"A-C", "ac_trunnion.toml", 100, {75, 0, 110}, false},
    {"A-C inside", "ac_trunnion.toml", 100, {75, 0, 110}, true},
    {"A-C short bar, pivot to the left and back", "ac_trunnion.toml", 50, {-90, 60, 80}, false},
    {"A-C long bar inside", "ac_trunnion.toml", 150, {-90, 60, 80}, true},
    {"B-C", "bc_table.toml", 100, {75, 0, 110}, false},
    {"B-C inside", "bc_table.toml", 100, {75, 0, 110}, true},
    {"B-C long bar, pivot in front", "bc_table.toml", 150, {0, -90, 70}, false},
    {"B-C short bar inside", "bc_table.toml", 50, {40, 80, 90}, true}};

setup::Setup setup_of(const Variant& v) {
    setup::Setup setup = load(v.setup);
    setup.ballbar->length_mm = v.length_mm;
    for (setup::Artefact& artefact : setup.artefacts)
        if (artefact.name == "P1") artefact.center_W_mm = v.pivot_mm;
    if (setup.machine.chain.work[0].axis != Axis::B) return setup;
    for (const char* name : {"EX0B", "EZ0B", "EX0C", "EY0C"})
        setup.machine.errors.location(*kinematics::parse_error_name(name)) = 0.02;
    for (const char* name : {"EA0B", "EC0B", "EA0C", "EB0C"})
        setup.machine.errors.location(*kinematics::parse_error_name(name)) = 5e-5;
    return setup;
}

/// Ball-to-ball lengths that an ideal machine runs through while the bar is mounted.
std::vector<double> bar_lengths_mm(const setup::Setup& setup, bool inside) {
    const ballbar::test::BallbarLayout layout = layout_of(setup);
    const emulator::RunLog log = run(setup, test_program(setup, inside), 5.0);
    require_no_alarm(log);
    std::vector<double> bar_mm, pending_mm;  // of feed moves, of the move being read
    std::istringstream lines(log.trace_csv);
    std::string line;
    std::getline(lines, line);
    const auto column = columns_of(line);
    while (std::getline(lines, line)) {
        const auto cells = split(line);
        const Vector3 tip(number(cells[column.at("tip_x_mm")]),
                          number(cells[column.at("tip_y_mm")]),
                          number(cells[column.at("tip_z_mm")]));
        pending_mm.push_back((tip - layout.pivot_W_mm).norm());
        const std::string& motion = cells[column.at("motion")];
        if (motion == "SAMPLE") continue;
        if (motion != "G0") bar_mm.insert(bar_mm.end(), pending_mm.begin(), pending_mm.end());
        pending_mm.clear();
    }
    // The first feed move comes down from 10 mm above.
    while (!bar_mm.empty() && bar_mm.front() > layout.length_mm + 0.1) bar_mm.erase(bar_mm.begin());
    return bar_mm;
}

}  // namespace

TEST_CASE("one run does all seven tests both ways and finds the errors - every machine and side") {
    for (const Variant& v : variants) {
        INFO(v.name);
        check_single_run(setup_of(v), v.inside);
    }
}

TEST_CASE("inside the flat bar points to the second rotary axis and the upright one stays up") {
    setup::Setup setup = load("ac_trunnion.toml");
    setup.ballbar->sample_hz = 1.0;
    const kinematics::Machine nominal = without_errors(setup.machine);
    for (const bool inside : {false, true}) {
        const emulator::RunLog log = run(setup, test_program(setup, inside));
        std::map<std::string, Vector3> bar;
        for (const records::Reading& row : log.readings.rows) {
            const kinematics::MachinePose pose = nominal.poses(row.commanded);
            const Vector3 cup_W = pose.pose_MW.inverse() * (pose.pose_MS * setup.ballbar->cup_S_mm);
            bar[row.test] = cup_W - Vector3(75, 0, 110);
        }
        const double x = inside ? -100.0 : 100.0;
        CHECK((bar["radial_C_pos"] - Vector3(x, 0, 0)).norm() < 1e-6);
        CHECK((bar["axial_A_neg"] - Vector3(x, 0, 0)).norm() < 1e-6);
        CHECK((bar["radial_A_pos"] - Vector3(0, 0, 100)).norm() < 1e-6);
        CHECK((bar["axial_C_neg"] - Vector3(0, 0, 100)).norm() < 1e-6);
    }
}

TEST_CASE("the Hurco program with M128 gives the readings of the Fanuc program") {
    setup::Setup setup = load("ac_trunnion.toml");
    setup.ballbar->noise_um = 0.0;
    setup.ballbar->sample_hz = 5.0;
    const emulator::RunLog fanuc = run(setup, test_program(setup));
    setup.dialect = interpreter::hurco_dialect();
    for (const bool bnc : {false, true}) {
        CAPTURE(bnc);
        setup.hurco.bnc = bnc;
        const std::string program = test_program(setup);
        CHECK(program.find("M128\nG43.4\n") != std::string::npos);
        CHECK(program.find("G43.4H") == std::string::npos);
        const emulator::RunLog hurco = run(setup, program);
        require_no_alarm(hurco);
        REQUIRE(hurco.readings.rows.size() == fanuc.readings.rows.size());
        double worst_mm = 0.0;
        int tests = 0;
        for (std::size_t i = 0; i < hurco.readings.rows.size(); ++i) {
            const records::Reading &a = fanuc.readings.rows[i], &b = hurco.readings.rows[i];
            REQUIRE(a.test == b.test);
            REQUIRE(a.value_mm.has_value() == b.value_mm.has_value());
            tests += i > 0 && a.test != fanuc.readings.rows[i - 1].test;
            if (a.value_mm) worst_mm = std::max(worst_mm, std::abs(*a.value_mm - *b.value_mm));
        }
        CHECK(tests >= 13);
        CHECK(worst_mm < 1e-9);
        check_single_run(setup);
    }
}

TEST_CASE("the bar keeps its length from the first test to the last - every machine and side") {
    for (const Variant& v : variants) {
        setup::Setup setup = setup_of(v);
        tell_the_pivots(setup);
        const auto bar_mm = bar_lengths_mm(setup, v.inside);
        CAPTURE(v.name);
        CHECK(bar_mm.size() > 400);
        CHECK(*std::min_element(bar_mm.begin(), bar_mm.end()) > v.length_mm - 0.002);
        CHECK(*std::max_element(bar_mm.begin(), bar_mm.end()) < v.length_mm + 0.002);
    }
}

TEST_CASE("the programs that ship are what the generator writes") {
    struct Shipped {
        const char *setup, *folder;
        setup::ProgramLanguage language;
    };
    for (const Shipped& s : {Shipped{"ac_trunnion.toml", "", setup::ProgramLanguage::fanuc},
                             Shipped{"bc_table.toml", "bc/", setup::ProgramLanguage::fanuc},
                             Shipped{"ac_trunnion.toml", "hurco/", setup::ProgramLanguage::isnc}}) {
        const setup::Setup setup = load(s.setup);
        const kinematics::Machine nominal = without_errors(setup.machine);
        auto data = ballbar::test::stated_program_data(setup, false);
        data.language = s.language;
        const std::string folder =
            std::string(TRUNNION_SOURCE_DIR) + "/programs/ballbar/" + s.folder;
        CAPTURE(folder);
        CHECK(file_text(folder + "O8200.nc") == ballbar::test::ballbar_program(nominal, data));
        CHECK(file_text(folder + "O8300.nc") ==
              ballbar::test::kinematic_test_program(nominal, data));
    }
}

TEST_CASE("a pivot on an axis is refused") {
    const setup::Setup setup = load("ac_trunnion.toml");
    ballbar::test::BallbarLayout layout = layout_of(setup);
    layout.pivot_W_mm = Vector3(0, 0, 110);
    CHECK_THROWS_AS(ballbar::test::ballbar_program_data(setup.machine, layout), InputError);
    layout.pivot_W_mm = Vector3(75, 0, 0);
    CHECK_THROWS_AS(ballbar::test::ballbar_program_data(setup.machine, layout), InputError);
}
