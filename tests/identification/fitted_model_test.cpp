// The fitted base as a model: steps of its parameters, repetitions, sessions, what fits exactly.
#include <catch2/catch.hpp>
#include <cmath>

#include "identification/identify.h"
#include "identification/sensitivity.h"
#include "identification/simulated.h"
#include "tests/support/campaign.h"
#include "tests/support/laser_machine.h"

namespace trunnion {
namespace {

std::vector<double> values_of(const records::ReadingTable& table) {
    std::vector<double> values;
    for (const records::Reading& row : table.rows)
        if (row.device != records::Device::none) values.push_back(*row.value_mm);
    return values;
}

/// Rows along X (mm) and C (mrad), in order, of a laser and an angular laser on two days.
records::ReadingTable two_days(const setup::Setup& setup) {
    records::ReadingTable table;
    table.path = "laser.csv";
    table.names = setup.machine.chain.names();
    for (const kinematics::AxisGeometry& axis : setup.machine.chain.axes())
        table.axes.push_back(axis.axis);
    for (const char* day : {"monday", "tuesday"})
        for (const bool angular : {false, true})
            for (int k = 0; k < 9; ++k) {
                records::Reading row;
                row.index = static_cast<int>(table.rows.size());
                row.time_s = 60.0 * row.index;
                row.session = day;
                row.test = angular ? "EBX" : "EXX";
                row.feature = "R1";
                row.device = angular ? records::Device::angle : records::Device::linear;
                row.angular = angular;
                row.direction_M = angular ? Vector3::UnitY() : Vector3::UnitX();
                row.commanded[Axis::X] = 50.0 * k - 200.0;
                row.value_mm = 0.0;
                table.rows.push_back(row);
            }
    return table;
}

}  // namespace

TEST_CASE("a step of the base parameters changes the readings as its columns say",
          "[identification]") {
    const setup::Setup setup = campaign::bc_setup();
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_sphere_map(table, setup, 30, 5);
    const records::ReadingTable read = campaign::measured(campaign::real_machine(setup), table, 2);
    const auto catalogue = effects::make_catalogue(setup, effects::extent_of(setup, read));
    const emulator::Replay replay(setup, read);
    const identification::BaseModel base =
        identification::fit_base(setup, read, replay, catalogue, {"location", "X.scale"});
    REQUIRE(base.columns.cols() > 8);
    const auto before =
        values_of(emulator::predicted(base.setup, read, effects::active_models(base.setup)));
    for (Eigen::Index j = 0; j < base.columns.cols(); ++j) {
        setup::Setup moved = base.setup;
        const Eigen::VectorXd step = 0.01 * Eigen::VectorXd::Unit(base.columns.cols(), j);
        identification::shift_base(moved, base, catalogue, step);
        const auto after =
            values_of(emulator::predicted(moved, read, effects::active_models(moved)));
        INFO(full_name(base.parameters[static_cast<std::size_t>(j)]));
        double off_mm = 0.0, most_mm = 0.0;
        for (std::size_t i = 0; i < after.size(); ++i) {
            const double by_mm = 0.01 * base.columns(static_cast<Eigen::Index>(i), j);
            off_mm = std::max(off_mm, std::abs(after[i] - before[i] - by_mm));
            most_mm = std::max(most_mm, std::abs(by_mm));
        }
        CHECK(most_mm > 1e-6);
        CHECK(off_mm < 0.01 * most_mm + 1e-9);
    }
}

TEST_CASE("an inseparable group is written as one sum with its signs", "[identification]") {
    CHECK(to_string(identification::Inseparable{}).empty());
    CHECK(to_string(identification::Inseparable{{"a", "b", "c"}, {1.0, -0.5, 0.25}}) ==
          "1 a - 0.5 b + 0.25 c");
    CHECK(to_string(identification::Inseparable{{"a", "b"}, {-1.0, 1.0 / 3.0}}) ==
          "-1 a + 0.333 b");
}

TEST_CASE("simulated readings: the prediction and the noise of each device, by the seed alone",
          "[identification]") {
    const setup::Setup setup = campaign::bc_setup();
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_sphere_map(table, setup, 200, 5);
    campaign::add_ballbar(table, setup);
    const auto exact = values_of(emulator::predicted(setup, table, effects::active_models(setup)));
    const records::ReadingTable read = identification::simulated(setup, table, 7);
    CHECK(values_of(read) == values_of(identification::simulated(setup, table, 7)));
    CHECK(values_of(read) != values_of(identification::simulated(setup, table, 8)));
    CHECK(read.comment.at("source") == "simulated");
    CHECK(read.comment.at("seed") == "7");
    double spheres = 0.0, bars = 0.0;
    int sphere_count = 0, bar_count = 0;
    std::size_t k = 0;
    for (const records::Reading& row : read.rows) {
        if (row.device == records::Device::none) continue;
        const double off_um = 1e3 * (*row.value_mm - exact[k++]);
        const bool bar = row.device == records::Device::ballbar;
        (bar ? bars : spheres) += off_um * off_um;
        ++(bar ? bar_count : sphere_count);
    }
    CHECK(std::sqrt(spheres / sphere_count) == Approx(0.8).epsilon(0.12));
    CHECK(std::sqrt(bars / bar_count) == Approx(0.3).epsilon(0.12));
}

TEST_CASE("each day has its own zeros, of a length and of an angle", "[identification]") {
    const setup::Setup setup = laser_machine();
    records::ReadingTable table = two_days(setup);
    // Scale 20 ppm on both days; each run counts from its own zero.
    const double zero[4] = {0.5, 3e-4, -0.2, -1e-4};
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        records::Reading& row = table.rows[i];
        row.value_mm = zero[i / 9];
        if (row.device == records::Device::linear) *row.value_mm += 20e-6 * row.commanded[Axis::X];
    }
    const auto result = identification::identify(setup, table, {"X.scale"});
    CHECK(result.rms_after_um < 1e-3);
    std::vector<std::string> zeros;
    for (const identification::FitParameter& p : result.parameters) {
        if (p.name == "scale_ppm") CHECK(p.value.value() == Approx(20.0).epsilon(1e-6));
        if (!p.name.starts_with("zero.")) continue;
        zeros.push_back(p.name);
        CHECK(p.unit == (p.name.find("_rad") != std::string::npos ? "rad" : "mm"));
    }
    CHECK(zeros == std::vector<std::string>{"zero.EXX_mm.monday", "zero.EBX_rad.monday",
                                            "zero.EXX_mm.tuesday", "zero.EBX_rad.tuesday"});
}

TEST_CASE("more readings than derivatives are kept of are fitted to the same values",
          "[identification]") {
    setup::Setup setup = laser_machine();
    records::ReadingTable one = two_days(setup);
    std::erase_if(one.rows, [](const auto& row) {
        return row.device != records::Device::linear || row.session != "monday";
    });
    for (records::Reading& row : one.rows) *row.value_mm = 20e-6 * row.commanded[Axis::X] + 0.1;
    records::ReadingTable many = one;
    for (int k = 0; k < 100001; ++k) {
        records::Reading row = one.rows[static_cast<std::size_t>(k % 9)];
        row.index = static_cast<int>(many.rows.size());
        row.time_s = 60.0 * row.index;
        many.rows.push_back(row);
    }
    const auto few = identification::identify(setup, one, {"X.scale"}),
               all = identification::identify(setup, many, {"X.scale"});
    const auto value = [](const identification::Identification& found, const std::string& name) {
        for (const identification::FitParameter& p : found.parameters)
            if (p.name == name) return p.value.value();
        throw std::logic_error("no " + name);
    };
    for (const char* name : {"scale_ppm", "zero.EXX_mm.monday"})
        CHECK(value(all, name) == Approx(value(few, name)).epsilon(1e-6));
    // A stated scatter of zeros asks for the derivatives all the same.
    setup.model.noise_um["zero"] = 1.0;
    CHECK(value(identification::identify(setup, many, {"X.scale"}), "scale_ppm") ==
          Approx(20.0).epsilon(1e-3));
}

TEST_CASE("without effects the derivatives are those of what the setup models",
          "[identification]") {
    setup::Setup setup = campaign::bc_setup();
    setup.ballbar->free_length = false;
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_sphere_map(table, setup, 12, 5);
    campaign::add_ballbar(table, setup, 12);
    const auto own = identification::sensitivity(setup, table, {}),
               asked = identification::sensitivity(setup, table, setup.model.modelled);
    CHECK(own.jacobian == asked.jacobian);
    REQUIRE(own.parameters.size() == asked.parameters.size());
    for (std::size_t j = 0; j < own.parameters.size(); ++j) {
        CHECK(full_name(own.parameters[j]) == full_name(asked.parameters[j]));
        CHECK(own.parameters[j].name != "length_mm");  // not free
    }
    // Zeros scatter where something is probed; the circles of the ballbar take no part.
    setup.model.noise_um["zero"] = 5.0;
    const auto scattered = identification::identify(setup, campaign::measured(setup, table, 3), {});
    setup.model.noise_um.erase("zero");
    const auto plain = identification::identify(setup, campaign::measured(setup, table, 3), {});
    REQUIRE(scattered.parameters.size() == plain.parameters.size());
    for (std::size_t j = 0; j < plain.parameters.size(); ++j)
        CHECK((!std::isfinite(plain.parameters[j].sigma) ||
               scattered.parameters[j].sigma >= 0.99 * plain.parameters[j].sigma));
}

TEST_CASE("readings without any error do not say that a scale bends", "[identification]") {
    const setup::Setup setup = laser_machine();
    records::ReadingTable table = two_days(setup);
    std::erase_if(table.rows, [](const auto& row) {
        return row.device != records::Device::linear || row.session != "monday";
    });
    const auto result = identification::identify(setup, table, {"X.scale"});
    REQUIRE(result.notes.size() == 1);
    CHECK(result.notes[0] == "X.scale: the readings show no curvature; its higher terms are 0");
}

TEST_CASE("a time between two readings is found as the middle between them", "[identification]") {
    const setup::Setup setup = campaign::bc_setup();
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_sphere_map(table, setup, 40, 3);
    std::vector<double> times_s;
    for (const records::Reading& row : table.rows)
        if (row.feature == "S1" && row.device != records::Device::none &&
            (times_s.empty() || times_s.back() < row.time_s))
            times_s.push_back(row.time_s);
    for (const std::size_t k : {5, 11}) {
        const double slip_s = 0.9 * times_s[k] + 0.1 * times_s[k - 1];
        const setup::Setup truth = campaign::with_effect(
            setup, "artefact.moved: shift_mm=[0.02, 0, -0.03], artefact=0, time_s=" +
                       std::to_string(slip_s));
        const auto result = identification::identify(setup, campaign::measured(truth, table, 1),
                                                     {"artefact.moved"});
        for (const identification::FitParameter& p : result.parameters)
            if (p.name == "time_s")
                CHECK(p.value.value() == Approx(0.5 * (times_s[k] + times_s[k - 1])).margin(0.02));
    }
}

}  // namespace trunnion
