// Laser, autocollimator, tracker and servo log beside a program: rows, values, noise, refusals.
#include <catch2/catch.hpp>
#include <cmath>

#include "base/units.h"
#include "effects/settings.h"
#include "emulator/run.h"
#include "interpreter/program_folders.h"

namespace trunnion {
namespace {

setup::Setup machine(const std::string& effects, double noise = 0.001) {
    std::vector<std::string> notes;
    const std::string n = std::to_string(noise);
    return setup::parse_setup(
        "[machine]\nname = \"m\"\nchain = \"w C B b X Y Z t\"\n"
        "[machine.axis.B]\ndirection = [0, -1, 0]\npoint_mm = [0, 0, 0]\n"
        "[machine.axis.C]\ndirection = [0, 0, -1]\npoint_mm = [0, 0, 0]\n"
        "[effects]\n" +
            effects +
            "\n[[instrument]]\nname = \"Tracker\"\norigin_mm = [1000, 0, 0]\n"
            "rotation_deg = [0, 0, 90]\n"
            "[[artefact]]\nname = \"R1\"\nkind = \"target\"\ntool_mm = [0, 0, -150]\n"
            "[model]\nnoise_um = { linear = " +
            n + ", axis = " + n + ", point = " + n + " }\nnoise_urad = { angle = " + n +
            ", axis = " + n + " }\n",
        "s.toml", notes);
}

records::ReadingTable run(const setup::Setup& setup, const std::string& program,
                          const std::vector<std::string>& measure, std::uint64_t seed = 1) {
    interpreter::ProgramFolders source({});
    emulator::RunOptions options;
    options.seed = seed;
    options.measure = measure;
    options.effects = effects::active_models(setup);
    emulator::RunLog log =
        emulator::run_program(setup, source, interpreter::ProgramText{"O1", program, {}}, options);
    REQUIRE(log.result.status == controller::RunStatus::ok);
    return std::move(log.readings);
}

std::vector<records::Reading> device_rows(const records::ReadingTable& table) {
    std::vector<records::Reading> list;
    for (const records::Reading& row : table.rows)
        if (row.device != records::Device::none) list.push_back(row);
    return list;
}

/// The rows written and read again predict what the run read.
void require_predicted(const setup::Setup& setup, const records::ReadingTable& table) {
    std::vector<std::string> notes;
    const records::ReadingTable again =
        records::parse_readings(records::format_readings(table), "r.csv", notes);
    const records::ReadingTable predicted =
        emulator::predicted(setup, again, effects::active_models(setup));
    for (std::size_t i = 0; i < table.rows.size(); ++i)
        if (table.rows[i].value_mm)
            REQUIRE(*table.rows[i].value_mm ==
                    Approx(*predicted.rows[i].value_mm).epsilon(0).margin(6e-6));
}

const std::string laser =
    "%\nO1\nDPRNT[TEST*X]\nG21 G90 G53 G0 X-1.\nG53 G0 X0.\nG4 X2.\nG53 G0 X100.\nG4 X2.\n"
    "G53 G0 X200.\nG4 X2.\nG53 G0 X201.\nG53 G0 X200.\nG4 X2.\nG53 G0 X100.\nG4 X2.\n"
    "G53 G0 X0.\nG4 X2.\nM30\n%\n";

}  // namespace

TEST_CASE("a laser beside a program reads at each dwell: scale and reversal value", "[emulator]") {
    const setup::Setup setup =
        machine("\"X.scale\" = { scale_ppm = 40.0 }\n\"X.backlash\" = { gap_mm = 0.006 }");
    const records::ReadingTable table = run(setup, laser, {"linear R1 X"});
    const auto rows = device_rows(table);
    REQUIRE(rows.size() == 6);
    const double up[] = {0.0, 0.004, 0.008}, down[] = {0.002, -0.002, -0.006};
    for (std::size_t k = 0; k < 3; ++k) {
        CHECK(rows[k].test == "X");
        CHECK(rows[k].device == records::Device::linear);
        CHECK(rows[k].commanded[Axis::X] == Approx(100.0 * static_cast<double>(k)));
        CHECK(*rows[k].value_mm == Approx(up[k]).margin(1e-5));
        CHECK(*rows[3 + k].value_mm == Approx(down[k]).margin(1e-5));
    }
    require_predicted(setup, table);
}

TEST_CASE("the program's own lines mount and dismount devices", "[emulator]") {
    const setup::Setup setup = machine("\"X.scale\" = { scale_ppm = 40.0 }");
    const auto rows = device_rows(
        run(setup,
            "%\nO1\nG21 G90 G53 G0 X100.\nG4 X1.\nDPRNT[MEASURE*POINT*R1*TRACKER]\nG4 X1.\n"
            "DPRNT[MEASURE*OFF]\nG4 X1.\nM30\n%\n",
            {}));
    REQUIRE(rows.size() == 3);
    for (const records::Reading& row : rows) {
        CHECK(row.instrument == "Tracker");
        // The tracker's Y is the machine's X: turned by 90 degrees about Z.
        CHECK(std::abs(*row.value_mm) ==
              Approx(row.direction_M.y() != 0.0 ? 0.004 : 0.0).margin(1e-5));
    }
}

TEST_CASE("a servo log beside a program: lag times speed, as predict reads it", "[emulator]") {
    const setup::Setup setup = machine("\"servo.mismatch\" = { tau_x_s = 0.002 }");
    const records::ReadingTable table =
        run(setup, "%\nO1\nG21 G90 G54 G1 X100. F6000.\nG1 X0.\nM30\n%\n", {"axis X 200"});
    const auto rows = device_rows(table);
    CHECK(rows.size() > 380);
    double most = 0.0;
    for (const records::Reading& row : rows) most = std::max(most, std::abs(*row.value_mm));
    CHECK(most == Approx(100.0 * 0.002).epsilon(1e-3));  // 100 mm/s
    require_predicted(setup, table);
}

TEST_CASE("noise of such devices is that of the setup, by the seed", "[emulator]") {
    const setup::Setup setup = machine("", 2.0);
    double sum = 0.0;
    int count = 0;
    for (std::uint64_t seed = 1; seed <= 60; ++seed)
        for (const records::Reading& row : device_rows(run(setup, laser, {"linear R1 X"}, seed))) {
            sum += *row.value_mm * *row.value_mm;
            ++count;
        }
    // 360 draws: the rms is known to 3.7 %.
    CHECK(std::sqrt(sum / count) == Approx(0.002).epsilon(0.12));
    CHECK(*device_rows(run(setup, laser, {"linear R1 X"}, 5))[3].value_mm ==
          *device_rows(run(setup, laser, {"linear R1 X"}, 5))[3].value_mm);
}

TEST_CASE("an autocollimator beside a program reads a rotary axis from both sides", "[emulator]") {
    const setup::Setup setup = machine("\"C.backlash\" = { gap_rad = 6e-5 }");
    const records::ReadingTable table =
        run(setup,
            "%\nO1\nDPRNT[TEST*C]\nG21 G90 G53 G0 C-10.\nG53 G0 C0.\nG4 X2.\nG53 G0 C90.\nG4 X2.\n"
            "G53 G0 C100.\nG53 G0 C90.\nG4 X2.\nG53 G0 C0.\nG4 X2.\nM30\n%\n",
            {"angle R1 Z"});
    const auto rows = device_rows(table);
    REQUIRE(rows.size() == 4);
    // C + turns the table about -Z: the tool goes ahead of it about +Z. The first row is the zero.
    const double expected_rad[] = {0.0, 0.0, -6e-5, -6e-5};
    for (std::size_t k = 0; k < 4; ++k) {
        CHECK(rows[k].device == records::Device::angle);
        CHECK(rows[k].angular);
        CHECK(rows[k].direction_M == Vector3::UnitZ());
        CHECK(*rows[k].value_mm == Approx(expected_rad[k]).margin(1e-8));
    }
    require_predicted(setup, table);
}

TEST_CASE("an autocollimator beside a program reads pitch and yaw of a slide, and no roll",
          "[emulator]") {
    const setup::Setup setup = machine("\"X.angular\" = { EBX_p1_rad = 4e-5, ECX_p1_rad = -3e-5 }");
    const std::pair<const char*, double> about[] = {
        {"angle R1 X", 0.0}, {"angle R1 Y", 4e-5}, {"angle R1 Z", -3e-5}};
    for (const auto& [words, at_200_rad] : about) {
        INFO(words);
        const auto rows = device_rows(run(setup, laser, {words}));
        REQUIRE(rows.size() == 6);
        const double part[] = {0.0, 0.5, 1.0, 1.0, 0.5, 0.0};  // in proportion to X, 200 mm at most
        for (std::size_t k = 0; k < 6; ++k)
            CHECK(*rows[k].value_mm == Approx(part[k] * at_200_rad).margin(1e-8));
    }
}

TEST_CASE("noise of an autocollimator is that of the setup, in microradians", "[emulator]") {
    const setup::Setup setup = machine("", 2.0);
    double sum = 0.0;
    int count = 0;
    for (std::uint64_t seed = 1; seed <= 60; ++seed)
        for (const records::Reading& row : device_rows(run(setup, laser, {"angle R1 Y"}, seed))) {
            sum += *row.value_mm * *row.value_mm;
            ++count;
        }
    CHECK(std::sqrt(sum / count) == Approx(2e-6).epsilon(0.12));  // 360 draws
}

TEST_CASE("words that name no device are refused", "[emulator]") {
    const setup::Setup setup = machine("");
    const std::pair<const char*, const char*> cases[] = {
        {"linear R9 X", "no target 'R9'"}, {"linear R1 Q", "X, Y or Z"},
        {"point R1 cmm", "no instrument"}, {"axis Q", "no axis 'Q'"},
        {"axis X 0", "how often"},         {"radar R1", "none of LINEAR"},
        {"angle R1", "X, Y or Z"}};
    for (const auto& [words, message] : cases) {
        INFO(words);
        CHECK_THROWS_WITH(run(setup, laser, {words}), Catch::Contains(message));
    }
}

}  // namespace trunnion
