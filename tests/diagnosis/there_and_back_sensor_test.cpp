// The sensor of a printed joint, read there and back over half a turn by hand: errors of degrees at
// places that never come twice.
#include <catch2/catch.hpp>
#include <cmath>

#include "base/random.h"
#include "base/units.h"
#include "diagnosis/diagnosis.h"
#include "effects/settings.h"
#include "emulator/replay.h"
#include "tests/support/said.h"

namespace trunnion {
namespace {

constexpr double noise_rad = 2.6e-3;

double sensor_error_rad(double q_rad) {
    return rad_from_deg(2.2 * std::sin(4.0 * q_rad + 0.5) + 1.6 * std::cos(7.0 * q_rad - 1.0) +
                        1.2 * std::cos(2.0 * q_rad));
}

/// `fifth`: every fifth reading is taken out (1), or these alone are left (2); else 0.
records::ReadingTable half_turns(std::uint64_t seed, int fifth) {
    SeededNoise random(seed);
    records::ReadingTable table;
    table.path = "joint.csv";
    table.axes = {Axis::C};
    for (int k = 0; k < 107; ++k) {
        const double even_deg = k < 63 ? 100.0 - 3.05 * k : -86.0 + 4.1 * (k - 63);
        records::Reading row;
        row.index = k;
        row.time_s = 30.0 * k;
        row.test = "C";
        row.commanded[Axis::C] = rad_from_deg(even_deg + 0.8 * (random.uniform() - 0.5));
        const double value_rad =
            sensor_error_rad(row.commanded[Axis::C]) + noise_rad * random.normal();
        if (fifth == 0 || (k % 5 == 2) == (fifth == 2)) {
            row.device = records::Device::angle;
            row.angular = true;
            row.feature = "M";
            row.direction_M = Vector3::UnitZ();
            row.value_mm = value_rad;
        }
        table.rows.push_back(row);
    }
    return table;
}

}  // namespace

TEST_CASE("a sensor that is degrees off is written as it was read there and back",
          "[diagnosis][angle_sensor]") {
    std::vector<std::string> notes;
    const setup::Setup setup = setup::parse_setup(
        "[machine]\nname = \"joint\"\nchain = \"w C b t\"\n"
        "[machine.axis.C]\ndirection = [0, 0, 1]\npoint_mm = [0, 0, 0]\n"
        "[[artefact]]\nname = \"M\"\nkind = \"target\"\ntool_mm = [0, 0, 0]\n"
        "[model]\nmodelled = []\n",
        "s.toml", notes);
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        const diagnosis::Diagnosis d = diagnosis::diagnose(setup, half_turns(seed, 1));
        INFO(seed << ": " << said(d));
        CHECK(d.writes_causes);
        CHECK(1e-3 * d.after_rms_um < 1.6e3 * noise_rad);
        const records::ReadingTable fresh = half_turns(seed, 2);
        const emulator::Replay replay(d.setup, fresh);
        const std::vector<double> read = replay.predict(effects::active_models(d.setup));
        double sum = 0.0, mean = 0.0;
        for (std::size_t i = 0; i < replay.size(); ++i) {
            const double left = *fresh.rows[replay.table_row(i)].value_mm - read[i];
            mean += left;
            sum += left * left;
        }
        const auto count = static_cast<double>(replay.size());
        // The error of the sensor is 35 mrad; an end of the travel is beyond the others.
        CHECK(std::sqrt(sum / count - std::pow(mean / count, 2)) < 2.5 * noise_rad);
    }
}

}  // namespace trunnion
