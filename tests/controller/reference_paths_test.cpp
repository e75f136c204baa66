// Programs with the path another interpreter takes (end points, arc centres, sense of arcs).
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "block_bench.h"
#include "controller/controller.h"

namespace trunnion {

namespace {

/// One row: kind G0, G1 or ARC, end point x y z b c, centre and turns of arcs; mm and deg.
struct PathRow {
    std::string kind;
    double end[5] = {};
    double centre[3] = {};
    int plane = 17;
    double turns = 0.0;
    int line = 0;
};

std::vector<std::string> cells_of(const std::string& line) {
    std::vector<std::string> out;
    std::istringstream in(line);
    for (std::string cell; std::getline(in, cell, ',');) out.push_back(cell);
    return out;
}

/// Moves that end where the one before ended say nothing, arcs apart.
void push(std::vector<PathRow>& rows, const PathRow& row) {
    static constexpr double start[5] = {};
    const double* before = rows.empty() ? start : rows.back().end;
    double way = 0.0;
    for (int i = 0; i < 5; ++i) way = std::max(way, std::abs(row.end[i] - before[i]));
    if (row.kind == "ARC" || way > 1e-7) rows.push_back(row);
}

std::vector<PathRow> expected_path(const std::filesystem::path& csv) {
    std::ifstream in(csv);
    std::vector<PathRow> rows;
    std::string line;
    std::getline(in, line);
    while (std::getline(in, line)) {
        const auto cell = cells_of(line);
        if (cell[1] != "G0" && cell[1] != "G1" && cell[1] != "ARC") continue;
        PathRow row;
        row.kind = cell[1];
        row.line = std::stoi(cell[0]);
        const int column[5] = {2, 3, 4, 6, 7};
        for (int i = 0; i < 5; ++i)
            row.end[i] = std::stod(cell[static_cast<std::size_t>(column[i])]);
        if (row.kind == "ARC") {
            row.plane = std::stoi(cell[9]);
            row.turns = std::stod(cell[10]);
            for (std::size_t i = 0; i < 3; ++i) row.centre[i] = std::stod(cell[11 + i]);
        }
        push(rows, row);
    }
    return rows;
}

PathRow row_of(const motion::AxisMove& m) {
    PathRow row;
    row.kind = m.arc ? "ARC" : m.kind == motion::MotionKind::rapid ? "G0" : "G1";
    row.line = m.line;
    const offsets::ControlPosition to = offsets::control_position_of(m.to);
    const Axis axes[5] = {Axis::X, Axis::Y, Axis::Z, Axis::B, Axis::C};
    for (int i = 0; i < 5; ++i) row.end[i] = to[axes[i]];
    if (m.arc) {
        for (int i = 0; i < 3; ++i) row.centre[i] = m.arc->centre_mm[i];
        row.turns = m.arc->turns;
    }
    return row;
}

controller::RunResult run_reference(const std::filesystem::path& program, bench::Recorder& sink) {
    offsets::Stores stores;
    stores.parameters.set(3410, 0.05);
    stores.parameters.set(5114, 0.254);
    stores.parameters.set(5115, 0.254);
    stores.parameters.set(6004, 1.0);
    std::ifstream in(program, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    const auto owner = std::make_shared<const std::string>(text.str());
    interpreter::ProgramsInMemory none;
    controller::Controller control(bench::five_axes(), stores, none, sink, [](std::string_view) {});
    return control.run(interpreter::ProgramText{program.filename().string(), *owner, owner});
}

/// Largest fault of two rows: end point (mm, deg), and for arcs centre in the plane and sense.
std::string fault(const PathRow& is, const PathRow& wanted) {
    if (is.kind != wanted.kind) return "kind " + is.kind + " instead of " + wanted.kind;
    for (int i = 0; i < 5; ++i)
        if (std::abs(is.end[i] - wanted.end[i]) > 2e-5) return "end point";
    if (wanted.kind != "ARC") return {};
    const int normal = wanted.plane == 17 ? 2 : wanted.plane == 18 ? 1 : 0;
    for (int i = 0; i < 3; ++i)
        if (i != normal && std::abs(is.centre[i] - wanted.centre[i]) > 5e-4) return "centre";
    if (is.turns * wanted.turns <= 0.0) return "sense";
    return {};
}

void compare(const std::filesystem::path& program) {
    INFO(program.string());
    bench::Recorder sink;
    const controller::RunResult result = run_reference(program, sink);
    if (result.alarm) {
        FAIL_CHECK(result.alarm->number << " " << result.alarm->text << " line "
                                        << result.alarm->where.line);
        return;
    }
    std::filesystem::path csv = program;
    const std::vector<PathRow> wanted = expected_path(csv.replace_extension(".path.csv"));
    std::vector<PathRow> is;
    for (const motion::AxisMove& m : sink.moves) push(is, row_of(m));
    for (std::size_t i = 0; i < std::min(is.size(), wanted.size()); ++i)
        if (const std::string what = fault(is[i], wanted[i]); !what.empty()) {
            FAIL_CHECK(what << " at line " << is[i].line << " (" << wanted[i].line
                            << "): " << is[i].end[0] << " " << is[i].end[1] << " " << is[i].end[2]
                            << " " << is[i].end[3] << " " << is[i].end[4] << " instead of "
                            << wanted[i].end[0] << " " << wanted[i].end[1] << " "
                            << wanted[i].end[2] << " " << wanted[i].end[3] << " "
                            << wanted[i].end[4]);
            return;
        }
    CHECK(is.size() == wanted.size());
}

std::filesystem::path reference_folder() {
    const char* folder = std::getenv("TRUNNION_REFERENCE");
    return folder ? folder : "";
}

}  // namespace

TEST_CASE("reference programs take the reference path") {
    const std::filesystem::path folder = reference_folder();
    if (folder.empty()) {
        WARN("no reference folder: set TRUNNION_REFERENCE");
        return;
    }
    std::size_t programs = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "paths"))
        if (entry.path().extension() == ".nc") {
            compare(entry.path());
            ++programs;
        }
    CHECK(programs >= 70);
}

}  // namespace trunnion
