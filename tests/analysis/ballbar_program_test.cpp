// The NC programs of the single-set-up test on the emulated control.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "analysis/ballbar_fit.h"
#include "analysis/ballbar_procedure.h"
#include "analysis/ballbar_result.h"
#include "emulator/program_folders.h"
#include "emulator/run.h"

using namespace trunnion;

namespace {

Setup load(const std::string& name) {
    std::vector<std::string> notes;
    return load_setup(std::string(TRUNNION_SOURCE_DIR) + "/machines/" + name, notes);
}

BallbarLayout layout_of(const Setup& setup) {
    BallbarLayout layout;
    layout.pivot_W_mm = setup.find_artefact("P1")->center_W_mm;
    layout.cup_S_mm = setup.ballbar->cup_S_mm;
    layout.length_mm = setup.ballbar->length_mm;
    return layout;
}

Machine without_errors(Machine machine) {
    machine.errors = {};
    return machine;
}

std::string file_text(const std::string& path) {
    std::ifstream in(path);
    std::ostringstream out;
    out << in.rdbuf();
    return out.str();
}

RunLog run(const Setup& setup, const std::string& text, double trace_step_mm = 0.0) {
    const auto owner = std::make_shared<std::string>(text);
    const ProgramText program{"O8200.nc", *owner, owner};
    ProgramFolders folders({});
    folders.add_file(program);
    RunOptions options;
    options.trace = trace_step_mm > 0.0;
    options.trace_step_mm = trace_step_mm;
    return run_program(setup, folders, program, options);
}

void require_no_alarm(const RunLog& log) {
    if (const auto& alarm = log.result.alarm)
        FAIL(alarm->number << " " << alarm->text << " line " << alarm->where.line << " "
                           << alarm->block);
    for (const std::string& note : log.notes)
        CHECK(note.find("out of its range") == std::string::npos);
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

std::vector<double> values_at(const ReadingTable& table, const std::vector<std::size_t>& rows) {
    std::vector<double> out;
    for (const std::size_t i : rows) out.push_back(*table.rows[i].value_mm);
    return out;
}

/// Seven tests both ways, exact; every error found.
void check_single_run(Setup setup, bool hurco = false) {
    setup.ballbar->noise_um = 0.0;
    setup.ballbar->sample_hz = 5.0;
    const Machine nominal = without_errors(setup.machine);
    const BallbarLayout layout = layout_of(setup);
    BallbarProgramData data = ballbar_program_data(nominal, layout);
    data.hurco = hurco;
    const RunLog log = run(setup, ballbar_program(nominal, data));
    require_no_alarm(log);
    const BallbarModel model(nominal, layout, log.readings.rows, {});
    CHECK(model.passes().size() == 14);
    const BallbarFit fit = model.fit(values_at(log.readings, model.rows_used()));
    CHECK(fit.rank == 12);
    CHECK(fit.rms_mm < 1e-10);
    for (const ErrorEstimate& e : chain_estimates(fit, 0.0)) {
        CAPTURE(to_string(e.name));
        CHECK(std::abs(e.value - setup.machine.errors.location(e.name)) <
              (e.name.angular() ? 1e-9 : 1e-6));
    }
}

}  // namespace

TEST_CASE("one run of the NC program does all seven tests both ways and finds the errors") {
    check_single_run(load("ac_trunnion.toml"));
}

TEST_CASE("the Hurco program with M128 finds the same errors") {
    Setup setup = load("ac_trunnion.toml");
    setup.dialect = hurco_dialect();
    check_single_run(setup, true);
}

TEST_CASE("the generator serves a B-C table, other radii and other places of the pivot") {
    Setup setup = load("bc_table.toml");
    for (const char* name : {"EX0B", "EZ0B", "EX0C", "EY0C"})
        setup.machine.errors.location(*parse_error_name(name)) = 0.02;
    for (const char* name : {"EA0B", "EC0B", "EA0C", "EB0C"})
        setup.machine.errors.location(*parse_error_name(name)) = 5e-5;
    SECTION("pivot beside the tilting axis") {}
    SECTION("other bar, other side") {
        setup.ballbar->length_mm = 150.0;
        for (Artefact& artefact : setup.artefacts)
            if (artefact.name == "P1") artefact.center_W_mm = Vector3(0, -90, 70);
    }
    check_single_run(setup);
}

TEST_CASE("the bar keeps its length from the first test to the last") {
    const Setup setup = load("ac_trunnion.toml");
    const Machine nominal = without_errors(setup.machine);
    const BallbarLayout layout = layout_of(setup);
    const RunLog log =
        run(setup, ballbar_program(nominal, ballbar_program_data(nominal, layout)), 5.0);
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
    while (!bar_mm.empty() && bar_mm.front() > 100.1) bar_mm.erase(bar_mm.begin());
    CHECK(bar_mm.size() > 500);
    CHECK(*std::min_element(bar_mm.begin(), bar_mm.end()) > 99.998);
    CHECK(*std::max_element(bar_mm.begin(), bar_mm.end()) < 100.002);
}

TEST_CASE("BK1 BK2 and BK4 run and read along the whole path") {
    Setup setup = load("ac_trunnion.toml");
    setup.ballbar->sample_hz = 5.0;
    const Machine nominal = without_errors(setup.machine);
    const BallbarLayout layout = layout_of(setup);
    const RunLog log =
        run(setup, kinematic_test_program(nominal, ballbar_program_data(nominal, layout)));
    require_no_alarm(log);
    std::map<std::string, int> tests;
    bool five_axes = false;
    for (const Reading& row : log.readings.rows) {
        if (row.device == Device::ballbar) ++tests[row.test];
        five_axes |=
            row.test == "bk4_pos" && row.commanded[Axis::A] > 0.3 && row.commanded[Axis::C] > 2.0;
    }
    CHECK(tests.size() == 10);
    CHECK(tests["bk4_pos"] == tests["bk4_neg"]);
    CHECK(tests["bk4_pos"] > 100);
    CHECK(five_axes);
}

TEST_CASE("the programs that ship are what the generator writes") {
    struct Shipped {
        const char *setup, *folder;
        bool hurco;
    };
    for (const Shipped& s :
         {Shipped{"ac_trunnion.toml", "", false}, Shipped{"bc_table.toml", "bc/", false},
          Shipped{"ac_trunnion.toml", "hurco/", true}}) {
        const Setup setup = load(s.setup);
        const Machine nominal = without_errors(setup.machine);
        int tool_offset = 0;
        auto data = ballbar_program_data(nominal, stated_layout(setup, tool_offset));
        data.tool_offset = tool_offset;
        data.hurco = s.hurco;
        const std::string folder =
            std::string(TRUNNION_SOURCE_DIR) + "/programs/ballbar/" + s.folder;
        CAPTURE(folder);
        CHECK(file_text(folder + "O8200.nc") == ballbar_program(nominal, data));
        CHECK(file_text(folder + "O8300.nc") == kinematic_test_program(nominal, data));
    }
}

TEST_CASE("a pivot on an axis is refused") {
    const Setup setup = load("ac_trunnion.toml");
    BallbarLayout layout = layout_of(setup);
    layout.pivot_W_mm = Vector3(0, 0, 110);
    CHECK_THROWS_AS(ballbar_program_data(setup.machine, layout), InputError);
    layout.pivot_W_mm = Vector3(75, 0, 0);
    CHECK_THROWS_AS(ballbar_program_data(setup.machine, layout), InputError);
}
