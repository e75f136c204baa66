// Each of several instruments reads with its own gain.
#include <catch2/catch.hpp>

#include "base/alarm.h"
#include "effects/settings.h"
#include "emulator/replay.h"
#include "identification/set_up.h"

using namespace trunnion;

namespace {

setup::Setup setup_with(const std::vector<std::string>& instruments, const std::string& effect) {
    std::string text =
        "[machine]\nname = \"m\"\nchain = \"w b X Y Z t\"\n"
        "[[artefact]]\nname = \"R1\"\nkind = \"target\"\ntool_mm = [0, 0, -150]\n";
    for (const std::string& name : instruments) text += "[[instrument]]\nname = \"" + name + "\"\n";
    std::vector<std::string> notes;
    setup::Setup setup = setup::parse_setup(text + "[model]\nmodelled = []\n", "s.toml", notes);
    setup.effects.push_back(effects::parse_injection(effect, effects::make_catalogue(setup)));
    return setup;
}

/// X from 0 to 100 mm by a laser and by its own encoder.
records::ReadingTable readings_of(const std::string& instrument) {
    records::ReadingTable table;
    table.axes = {Axis::X, Axis::Y, Axis::Z};
    table.side_before.fill(1);
    for (const records::Device device : {records::Device::linear, records::Device::axis})
        for (const double x_mm : {0.0, 100.0}) {
            records::Reading row;
            row.time_s = static_cast<double>(table.rows.size());
            row.test = "t";
            row.device = device;
            row.feature = device == records::Device::axis ? "X" : "R1";
            row.commanded[Axis::X] = x_mm;
            row.direction_M = Vector3::UnitX();
            row.instrument = instrument;
            table.rows.push_back(row);
        }
    return table;
}

/// What laser and encoder read at 100 mm, um.
std::pair<double, double> read_um(const setup::Setup& setup, const std::string& instrument) {
    const auto rows =
        emulator::predicted(setup, readings_of(instrument), effects::active_models(setup)).rows;
    return {1e3 * *rows[1].value_mm, 1e3 * *rows[3].value_mm};
}

void check_um(const std::pair<double, double>& read, double expected_um) {
    CHECK(read.first == Approx(expected_um).margin(1e-6));
    CHECK(read.second == Approx(expected_um).margin(1e-6));
}

}  // namespace

TEST_CASE("the gain of one instrument is not that of another", "[emulator]") {
    const setup::Setup setup = setup_with({"old", "new"}, "sensor.gain: gain_old_ppm=30");
    check_um(read_um(setup, "old"), 3.0);
    check_um(read_um(setup, ""), 3.0);  // readings that name none are the first one's
    check_um(read_um(setup, "new"), 0.0);
    CHECK_THROWS_WITH(read_um(setup, "third"), Catch::Contains("no [[instrument]] named 'third'"));
}

TEST_CASE("one gain is that of all instruments", "[emulator]") {
    for (const std::vector<std::string>& names :
         {std::vector<std::string>{}, {"old"}, {"old", "new"}}) {
        const setup::Setup setup = setup_with(names, "sensor.gain: gain_ppm=30");
        check_um(read_um(setup, ""), 3.0);
        if (!names.empty()) check_um(read_um(setup, names.back()), 3.0);
    }
}

TEST_CASE("a laser's readings free no pose of a tracker in the same setup", "[emulator]") {
    setup::Setup setup = setup_with({"tracker"}, "X.scale: scale_ppm=30");
    setup.instruments.front().free_pose = setup.instruments.front().free_scale = true;
    const emulator::Replay replay(setup, readings_of(""));
    for (const identification::FreeQuantity& q : identification::free_quantities(setup, replay))
        CHECK(q.name.find("tracker") == std::string::npos);
}
