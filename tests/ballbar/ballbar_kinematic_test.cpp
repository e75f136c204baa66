// BK1, BK2 and BK4 on the emulated control against displacements written down by hand.
#include <Eigen/Geometry>
#include <cmath>
#include <map>

#include "ballbar_runs.h"

using namespace trunnion;
using namespace trunnion::ballbar_test;

namespace {

struct TableMachine {
    const char* setup;
    Vector3 first, second;               ///< what a positive word does to the table
    std::map<std::string, Vector3> bar;  ///< from pivot to cup with the rotary axes at zero
    std::vector<std::string> errors;
};

const Vector3 pivot(75, 0, 110);

const std::vector<TableMachine> machines = {
    {"ac_trunnion.toml",
     {-1, 0, 0},
     {0, 0, -1},
     {{"radial_A", {0, 0, 1}},
      {"axial_A", {1, 0, 0}},
      {"radial_C", {1, 0, 0}},
      {"axial_C", {0, 0, 1}},
      {"bk4", {0, 0, 1}}},
     {"EY0A", "EZ0A", "EB0A", "EC0A", "EX0C", "EY0C", "EA0C", "EB0C"}},
    {"bc_table.toml",
     {0, -1, 0},
     {0, 0, -1},
     {{"radial_B", Vector3(75, 0, 110).normalized()},
      {"axial_B", {0, 1, 0}},
      {"radial_C", {1, 0, 0}},
      {"axial_C", {0, 0, 1}},
      {"bk4", {0, 0, 1}}},
     {"EX0B", "EZ0B", "EA0B", "EC0B", "EX0C", "EY0C", "EA0C", "EB0C"}}};

/// First order: minus what the error moves the pivot along the bar. Axes cross in the origin.
double closed_form(const TableMachine& m, const records::Reading& row, const std::string& error,
                   double size) {
    const Axis first = m.first.y() == 0.0 ? Axis::A : Axis::B;
    const Matrix3 r1 = Eigen::AngleAxisd(row.commanded[first], m.first).toRotationMatrix();
    const Matrix3 r2 = Eigen::AngleAxisd(row.commanded[Axis::C], m.second).toRotationMatrix();
    const Vector3 bar = r1 * r2 * m.bar.at(row.test.substr(0, row.test.rfind('_')));
    const bool second = error.back() == 'C', tilt = error[1] < 'D';
    const Vector3 along = Vector3::Unit(tilt ? error[1] - 'A' : error[1] - 'X') * size;
    const Vector3 arm = second ? Vector3(r2 * pivot) : Vector3(r1 * r2 * pivot);
    const Vector3 moved = tilt ? Vector3(along.cross(arm)) : along;
    return -bar.dot(second ? Vector3(r1 * moved) : moved);
}

setup::Setup perfect(const TableMachine& m) {
    setup::Setup setup = load(m.setup);
    setup.machine.errors = {};
    setup.ballbar->noise_um = 0.0;
    setup.ballbar->sample_hz = 4.0;
    tell_the_pivots(setup);
    REQUIRE((setup.find_artefact("P1")->center_W_mm - pivot).norm() == 0.0);
    return setup;
}

std::string program_of(const setup::Setup& setup) {
    return ballbar::test::kinematic_test_program(without_errors(setup.machine),
                                                 ballbar::test::stated_program_data(setup, false));
}

}  // namespace

TEST_CASE("BK1 BK2 and BK4 read zero on a perfect machine") {
    for (const TableMachine& m : machines) {
        setup::Setup setup = perfect(m);
        const emulator::RunLog log = run(setup, program_of(setup));
        require_no_alarm(log);
        std::map<std::string, int> count;
        double worst_mm = 0.0;
        bool five_axes = false;
        for (const records::Reading& row : log.readings.rows) {
            if (row.device != records::Device::ballbar) continue;
            ++count[row.test];
            worst_mm = std::max(worst_mm, std::abs(*row.value_mm));
            five_axes |= row.test == "bk4_pos" && row.commanded[Axis::C] > 2.0 &&
                         std::max(row.commanded[Axis::A], row.commanded[Axis::B]) > 0.3;
        }
        CAPTURE(m.setup, worst_mm);
        CHECK(count.size() == 10);
        CHECK(count["bk4_pos"] == count["bk4_neg"]);
        CHECK(count["bk4_pos"] > 100);
        CHECK(five_axes);
        CHECK(worst_mm < 1e-9);
    }
}

TEST_CASE("each location error leaves its closed form on BK1 BK2 and BK4") {
    for (const TableMachine& m : machines) {
        const setup::Setup clean = perfect(m);
        const std::string program = program_of(clean);
        for (const std::string& error : m.errors) {
            setup::Setup setup = clean;
            const kinematics::ErrorName name = *kinematics::parse_error_name(error);
            const double size = name.angular() ? 5e-5 : 0.02;
            setup.machine.errors.location(name) = size;
            const emulator::RunLog log = run(setup, program);
            require_no_alarm(log);
            double worst_mm = 0.0, largest_mm = 0.0;
            for (const records::Reading& row : log.readings.rows) {
                if (row.device != records::Device::ballbar) continue;
                const double expected = closed_form(m, row, error, size);
                largest_mm = std::max(largest_mm, std::abs(expected));
                worst_mm = std::max(worst_mm, std::abs(*row.value_mm - expected));
            }
            CAPTURE(m.setup, error, worst_mm, largest_mm);
            CHECK(largest_mm > 3e-3);
            CHECK(worst_mm < 3e-6);  // (20 um)^2 / 2 L0: the second order
        }
    }
}
