// The three exercises of the 2022 paper on HTM error compensation as setups and programs, run from
// the NC text to the true tip, against the paper's own equations.
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <sstream>

#include "base/units.h"
#include "emulator/run.h"

using namespace trunnion;

namespace {

struct Row {
    AxisPositions at;
    Vector3 true_mm;
};

setup::Setup setup_of(int exercise) {
    std::vector<std::string> notes;
    return setup::load_setup(
        TRUNNION_SOURCE_DIR "/machines/htm_exercise_" + std::to_string(exercise) + ".toml", notes);
}

/// Every G1 row of the exercise's program on this setup.
std::vector<Row> run(const setup::Setup& setup, int exercise) {
    const std::string path =
        TRUNNION_SOURCE_DIR "/programs/papers/htm_exercise_" + std::to_string(exercise) + ".nc";
    std::stringstream text;
    text << std::ifstream(path).rdbuf();
    emulator::RunOptions options;
    options.trace = options.truth = true;
    interpreter::ProgramsInMemory none;
    const emulator::RunLog log = emulator::run_program(
        setup, none, interpreter::ProgramText{path, text.str(), nullptr}, options);
    REQUIRE(log.result.status == controller::RunStatus::ok);
    std::istringstream lines(log.trace_csv);
    std::string header, line;
    std::getline(lines, header);
    std::vector<Row> rows;
    while (std::getline(lines, line)) {
        std::map<std::string, std::string> cell;
        std::istringstream names(header), cells(line);
        std::string column, value;
        while (std::getline(names, column, ',') && std::getline(cells, value, ','))
            cell[column] = value;
        if (cell["motion"] != "G1") continue;
        Row row;
        for (const kinematics::AxisGeometry& axis : setup.machine.chain.axes())
            row.at[axis.axis] =
                std::stod(cell[std::string(1, char(letter_of(axis.axis) - 'A' + 'a')) + "_mm"]);
        row.true_mm = {std::stod(cell["true_x_mm"]), std::stod(cell["true_y_mm"]),
                       std::stod(cell["true_z_mm"])};
        rows.push_back(row);
    }
    return rows;
}

Vector3 slides(const Row& row) {
    return {row.at[Axis::X], row.at[Axis::Y], row.at[Axis::Z]};
}

/// Eq. 19: six errors as a matrix of first order, here applied to a point of the slide.
Vector3 eq_19(const std::array<kinematics::ErrorCurve, 6>& e, double q, const Vector3& p) {
    const Vector3 tilt(e[3](q), e[4](q), e[5](q));
    return p + tilt.cross(p) + Vector3(e[0](q), e[1](q), e[2](q));
}

}  // namespace

TEST_CASE("exercise 1: lateral and Abbe error along the beam") {
    const double ei_Nm2 = 210e9 * 0.025 * std::pow(0.05, 3) / 12;
    const auto rows = run(setup_of(1), 1);
    REQUIRE(rows.size() == 10);
    for (const Row& row : rows) {
        const double x_m = 1e-3 * row.at[Axis::X];
        const Vector3 error = row.true_mm - slides(row) - Vector3(0, 0, -100);
        CHECK(error.z() == Approx(-1e3 * 100 * std::pow(x_m, 3) / (3 * ei_Nm2)).margin(2e-6));
        CHECK(error.x() == Approx(-100 * 100 * x_m * x_m / (2 * ei_Nm2)).margin(1e-7));
    }
    const Vector3 end = rows.back().true_mm - Vector3(250, 0, -100);
    CHECK(std::abs(um_from_mm(end.z()) + 9.54) < 0.03);  // as printed, from rounded figures
    CHECK(std::abs(um_from_mm(end.x()) + 5.7) < 0.03);
}

TEST_CASE("exercise 2: the matrix from the z slide to the y slide, eq. 29") {
    const setup::Setup setup = setup_of(2);
    const auto& e = setup.machine.errors.axis[index_of(Axis::Z)].motion;
    const Vector3 tip(0, 60, -120), offset(0, 35, 70);  // a and b drop out
    const auto rows = run(setup, 2);
    REQUIRE(rows.size() == 11);
    for (const Row& row : rows) {
        const double z = row.at[Axis::Z];
        const Vector3 in_frame_1 = offset + Vector3(0, 0, z) + eq_19(e, z, tip);
        const Vector3 in_M = in_frame_1 - offset + Vector3(0, row.at[Axis::Y], 0);
        CHECK((row.true_mm - in_M).norm() < 3e-6);  // squares of the angles times 120 mm
    }
}

TEST_CASE("exercise 3: the tool point's errors are those of the paper's Table 2") {
    const double table_2_um[] = {0, 8, 60, 81, 76, 17, -18, -47, -54};
    const setup::Setup post = setup_of(3);
    const auto& e = post.machine.errors.axis[index_of(Axis::Y)].motion;
    const Vector3 b(300, 400, 500);
    const auto rows = run(post, 3);
    REQUIRE(rows.size() == 8);  // Y0 is where it stands
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const Vector3 way(0, rows[i].at[Axis::Y], 0), error = rows[i].true_mm - b - way;
        CHECK(std::round(um_from_mm(error.y())) == table_2_um[i + 1]);
        CHECK((error - (eq_19(e, way.y(), b) - b)).norm() < 2e-5);  // eq. 33 is of first order
    }
}

TEST_CASE("exercise 3 with the offset run by the slides: what Y carries follows its errors") {
    const setup::Setup post = setup_of(3);
    setup::Setup slides_reach = post;
    slides_reach.probe->tip_S_mm = {0, 400, 0};
    const auto rows = run(post, 3);
    for (const Row& row : rows) {
        AxisPositions q = row.at;
        q[Axis::X] += 300;
        q[Axis::Z] += 500;
        const Vector3 tip = post.machine.tip_W(q, slides_reach.probe->tip_S_mm);
        CHECK((tip - row.true_mm).norm() < 1e-12);
    }
}
