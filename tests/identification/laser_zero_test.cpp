// A laser whose travel begins far from zero: its readings count from the first, and so must their
// derivatives.
#include <catch2/catch.hpp>
#include <cmath>
#include <stdexcept>

#include "effects/settings.h"
#include "identification/identify.h"
#include "identification/sensitivity.h"
#include "tests/support/laser_machine.h"

namespace trunnion {
namespace {

/// A run of X from -350 to 350 mm and back, by a formula: scale, reversal, zero of the laser.
records::ReadingTable laser(const setup::Setup& setup, double scale_ppm, double gap_mm,
                            double zero_mm) {
    records::ReadingTable table;
    table.path = "laser.csv";
    table.names = setup.machine.chain.names();
    for (const kinematics::AxisGeometry& axis : setup.machine.chain.axes())
        table.axes.push_back(axis.axis);
    records::Reading row;
    row.test = "X";
    row.feature = "R1";
    row.direction_M = Vector3::UnitX();
    const auto add = [&](double x_mm, int way, records::Device device) {
        row.index = static_cast<int>(table.rows.size());
        row.time_s = 60.0 * row.index;
        row.device = device;
        row.commanded[Axis::X] = x_mm;
        row.value_mm.reset();
        if (device == records::Device::linear)
            row.value_mm = 1e-6 * scale_ppm * x_mm + 0.5 * way * gap_mm + zero_mm;
        table.rows.push_back(row);
    };
    add(-351.0, 1, records::Device::none);
    for (int k = -5; k <= 5; ++k) add(70.0 * k, 1, records::Device::linear);
    add(351.0, 1, records::Device::none);
    for (int k = 5; k >= -5; --k) add(70.0 * k, -1, records::Device::linear);
    return table;
}

const identification::FitParameter& fitted(const identification::Identification& found,
                                           const std::string& name) {
    for (const identification::FitParameter& p : found.parameters)
        if (p.name == name) return p;
    throw std::runtime_error("no " + name);
}

TEST_CASE("scale and reversal of a laser that begins at the end of the travel",
          "[identification][laser]") {
    const setup::Setup setup = laser_machine();
    for (const double scale_ppm : {54.7, -200.0}) {
        const identification::Identification found = identification::identify(
            setup, laser(setup, scale_ppm, -0.005, 0.0017), {"X.scale", "X.backlash"});
        CHECK(fitted(found, "scale_ppm").value.value() == Approx(scale_ppm).epsilon(1e-6));
        CHECK(fitted(found, "gap_mm").value.value() == Approx(-0.005).epsilon(1e-6));
        // The zero is what the model reads at the first row: 22 readings about a line, at its end.
        CHECK(fitted(found, "zero.X_mm").value.value() ==
              Approx(-350e-6 * scale_ppm - 0.0025 + 0.0017));
        CHECK(fitted(found, "zero.X_mm").sigma ==
              Approx(0.4e-3 * std::sqrt(1.0 / 22 + 1.0 / 22 + 25.0 / 220)).epsilon(0.02));
        for (const std::string& note : found.notes)
            CHECK_THAT(note, !Catch::Contains("has not settled"));
    }
}

TEST_CASE("the derivatives of a laser's readings are those of what predict computes",
          "[identification][laser]") {
    const setup::Setup setup = laser_machine();
    const records::ReadingTable table = laser(setup, 0.0, 0.0, 0.0);
    const auto catalogue = effects::make_catalogue(setup, effects::extent_of(setup, table));
    const auto found = identification::sensitivity(setup, table, {"X.scale", "X.backlash"});
    for (std::size_t j = 0; j < found.parameters.size(); ++j) {
        const identification::FitParameter& p = found.parameters[j];
        if (p.name != "scale_ppm" && p.name != "gap_mm") continue;
        setup::Setup moved = setup;
        const effects::Effect& effect = *effects::find_effect(catalogue, p.effect);
        std::vector<double> values = effect.zeros();
        for (std::size_t k = 0; k < values.size(); ++k)
            if (effect.parameters[k].name == p.name) values[k] = p.typical;
        identification::add_effect(moved, effect, values);
        const auto rows = emulator::predicted(moved, table, effects::active_models(moved)).rows;
        Eigen::Index i = 0;
        for (const records::Reading& row : rows)
            if (row.device != records::Device::none)
                CHECK(p.typical * found.jacobian(i++, static_cast<Eigen::Index>(j)) ==
                      Approx(*row.value_mm).margin(1e-9));
        CHECK(i == found.jacobian.rows());
    }
}

}  // namespace
}  // namespace trunnion
