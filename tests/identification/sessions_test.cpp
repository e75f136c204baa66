// What belongs to a day begins anew, what belongs to the machine stays.
#include <catch2/catch.hpp>

#include "base/alarm.h"
#include "base/units.h"
#include "effects/settings.h"
#include "identification/identify.h"

namespace trunnion {
namespace {

setup::Setup machine() {
    std::vector<std::string> notes;
    return setup::parse_setup(
        "[machine]\nname = \"m\"\nchain = \"w C B b X Y Z t\"\n"
        "[machine.axis.B]\ndirection = [0, -1, 0]\npoint_mm = [0, 0, 0]\n"
        "[machine.axis.C]\ndirection = [0, 0, -1]\npoint_mm = [0, 0, 0]\n"
        "[[instrument]]\nname = \"CMM\"\nframe = \"W\"\nfree = [\"pose\", \"scale\"]\n"
        "[[artefact]]\nname = \"R1\"\nkind = \"target\"\ntool_mm = [0, 0, -150]\n"
        "[model]\nmodelled = []\n",
        "s.toml", notes);
}

/// Points of a plate, or of a cube where it has `layers`, without values.
records::ReadingTable points(const setup::Setup& setup, const std::string& session, int layers) {
    records::ReadingTable table;
    table.path = "points.csv";
    table.names = setup.machine.chain.names();
    for (const kinematics::AxisGeometry& axis : setup.machine.chain.axes())
        table.axes.push_back(axis.axis);
    for (int k = 0; k < 25 * layers; ++k)
        for (int d = 0; d < 3; ++d) {
            records::Reading row;
            row.index = static_cast<int>(table.rows.size());
            row.time_s = 10.0 * k;
            row.test = "plate";
            row.device = records::Device::point;
            row.feature = "R1";
            row.session = session;
            row.commanded[Axis::X] = -100.0 + 50.0 * (k % 5);
            row.commanded[Axis::Y] = -100.0 + 50.0 * (k / 5 % 5);
            row.commanded[Axis::Z] = 150.0 + 60.0 * (k / 25);
            row.direction_M = Vector3::Unit(d);
            table.rows.push_back(row);
        }
    return table;
}

/// What the CMM reads of a machine whose part lies so.
void measure(setup::Setup real, const Vector3& shift_mm, const Vector3& tilt_rad, double scale,
             records::ReadingTable& table) {
    real.instruments[0].pose_error = {shift_mm, tilt_rad};
    real.instruments[0].scale_error = scale;
    table = emulator::predicted(real, table, effects::active_models(real));
}

records::ReadingTable two_days(const setup::Setup& real, int layers) {
    records::ReadingTable a = points(real, "monday", layers), b = points(real, "tuesday", layers);
    measure(real, {-0.044, 0.079, 0.01}, {0, 0, rad_from_deg(0.029)}, -34e-6, a);
    measure(real, {0.02, 0.01, -0.03}, {2e-5, -1e-5, rad_from_deg(-0.011)}, 5e-6, b);
    for (records::Reading& row : b.rows) {
        row.time_s += 86400.0;
        a.rows.push_back(row);
    }
    return a;
}

double value_of(const identification::Identification& result, const std::string& name) {
    for (const identification::FitParameter& p : result.parameters)
        if (p.name == name) return p.value;
    FAIL("no parameter " << name);
    return 0.0;
}

}  // namespace

TEST_CASE("each day has its own pose and scale, the machine's error is common",
          "[identification][sessions]") {
    const setup::Setup setup = machine();
    setup::Setup real = setup;
    real.effects.push_back({"XY.squareness", {{"angle_rad", {6e-5}}}});
    const auto result = identification::identify(setup, two_days(real, 2), {"XY.squareness"});
    CHECK(result.rms_after_um < 1e-3);
    CHECK(value_of(result, "angle_rad") == Approx(6e-5).epsilon(1e-3));
    CHECK(value_of(result, "CMM.x_mm.monday") == Approx(-0.044).margin(1e-5));
    CHECK(value_of(result, "CMM.y_mm.monday") == Approx(0.079).margin(1e-5));
    CHECK(value_of(result, "CMM.c_rad.monday") == Approx(rad_from_deg(0.029)).margin(1e-8));
    CHECK(value_of(result, "CMM.scale.monday") == Approx(-34e-6).margin(1e-8));
    CHECK(value_of(result, "CMM.z_mm.tuesday") == Approx(-0.03).margin(1e-5));
    CHECK(value_of(result, "CMM.a_rad.tuesday") == Approx(2e-5).margin(1e-8));
    CHECK(value_of(result, "CMM.c_rad.tuesday") == Approx(rad_from_deg(-0.011)).margin(1e-8));
    CHECK(value_of(result, "CMM.scale.tuesday") == Approx(5e-6).margin(1e-8));
    const std::vector<std::string>& words = result.set_up_words;
    REQUIRE(words.size() == 2);
    CHECK(words[0] ==
          "monday: the part was turned by 0.02900 deg, shifted by (-0.0440, 0.0790, 0.0100) mm, "
          "scaled by -34.00 ppm");
    CHECK_THAT(words[1], Catch::Contains("tuesday: the part was turned by 0.01107 deg"));
}

TEST_CASE(
    "a laser beside an instrument knows none of its poses, a day without a name is the setup's",
    "[identification][sessions]") {
    const setup::Setup setup = machine();
    records::ReadingTable both = two_days(setup, 2);
    for (records::Reading& row : both.rows)
        if (row.session == "monday") row.session.clear();
    // A laser beside it: its readings know no pose of the CMM.
    for (int k = 0; k < 9; ++k) {
        records::Reading row = both.rows.back();
        row.index = static_cast<int>(both.rows.size());
        row.time_s += 60.0;
        row.device = records::Device::linear;
        row.test = "EXX";
        row.commanded[Axis::X] = 50.0 * k - 200.0;
        row.direction_M = Vector3::UnitX();
        row.value_mm = 0.3;
        both.rows.push_back(row);
    }
    const auto result = identification::identify(setup, both, {"XY.squareness"});
    CHECK(result.rms_after_um < 1e-3);
    CHECK(value_of(result, "CMM.x_mm.") == Approx(-0.044).margin(1e-5));
    CHECK(value_of(result, "CMM.z_mm.tuesday") == Approx(-0.03).margin(1e-5));
    REQUIRE(result.setup.sessions.size() == 1);  // a day without a name is the setup itself
    CHECK(result.setup.sessions[0].name == "tuesday");
}

TEST_CASE("a written setup reads each session with its own values, alone and together",
          "[identification][sessions]") {
    const setup::Setup setup = machine();
    setup::Setup real = setup;
    real.effects.push_back({"XY.squareness", {{"angle_rad", {6e-5}}}});
    const records::ReadingTable both = two_days(real, 2);
    const auto result = identification::identify(setup, both, {"XY.squareness"});
    std::vector<std::string> notes;
    const setup::Setup written =
        setup::parse_setup(setup::format_setup(result.setup), "out.toml", notes);
    REQUIRE(written.sessions.size() == 2);
    CHECK(written.find_session("tuesday")->values.at("CMM.z_mm") == Approx(-0.03).margin(1e-5));
    CHECK(setup::format_setup(written) == setup::format_setup(result.setup));

    records::ReadingTable tuesday = both;
    std::erase_if(tuesday.rows, [](const auto& row) { return row.session != "tuesday"; });
    records::ReadingTable friday = tuesday;
    for (records::Reading& row : friday.rows) row.session = "friday";
    const auto apart_um = [&](const records::ReadingTable& table) {
        const records::ReadingTable read =
            emulator::predicted(written, table, effects::active_models(written));
        double most = 0.0;
        for (std::size_t i = 0; i < table.rows.size(); ++i)
            most = std::max(most, std::abs(*read.rows[i].value_mm - *table.rows[i].value_mm));
        return 1e3 * most;
    };
    CHECK(apart_um(both) < 1e-3);
    CHECK(apart_um(tuesday) < 1e-3);
    CHECK(apart_um(friday) > 20.0);  // unknown: as the first one

    // What the setup knows is where the next fit begins; nothing free: it stays.
    setup::Setup held = written;
    held.instruments[0].free_pose = held.instruments[0].free_scale = false;
    CHECK(identification::identify(held, tuesday, {}).rms_after_um < 1e-3);
    CHECK(identification::identify(held, both, {}).rms_after_um < 1e-3);
    const auto again = identification::identify(written, both, {"XY.squareness"});
    CHECK(again.rms_before_um < 1e-3);
    CHECK(value_of(again, "CMM.z_mm.tuesday") == Approx(-0.03).margin(1e-5));
    // On another Monday the part lies elsewhere.
    records::ReadingTable monday = points(real, "monday", 2);
    measure(real, {0.05, -0.02, 0.03}, {0, 0, rad_from_deg(-0.02)}, 10e-6, monday);
    records::ReadingTable moved = both;
    std::copy(monday.rows.begin(), monday.rows.end(), moved.rows.begin());
    const auto anew = identification::identify(written, moved, {"XY.squareness"});
    CHECK(anew.rms_before_um > 20.0);
    CHECK(anew.rms_after_um < 1e-3);
    CHECK(value_of(anew, "CMM.x_mm.monday") == Approx(0.05).margin(1e-5));
    CHECK(value_of(anew, "CMM.z_mm.tuesday") == Approx(-0.03).margin(1e-5));
}

TEST_CASE("a session of a setup names places that the setup has", "[identification][sessions]") {
    std::vector<std::string> notes;
    const std::string text = setup::format_setup(machine());
    for (const char* wrong : {"\"CMM.q_mm\" = 1", "\"S9.x_mm\" = 1", "\"cup.x_mm\" = 1"})
        CHECK_THROWS_AS(
            setup::parse_setup(text + "\n[[session]]\nname = \"a\"\n" + wrong + "\n", "s", notes),
            InputError);
    CHECK_THROWS_AS(setup::parse_setup(text + "\n[[session]]\n\"CMM.x_mm\" = 1\n", "s", notes),
                    InputError);
}

TEST_CASE("two days taken for one leave what lies between them", "[identification][sessions]") {
    const setup::Setup setup = machine();
    records::ReadingTable table = two_days(setup, 2);
    for (records::Reading& row : table.rows) row.session.clear();
    const auto result = identification::identify(setup, table, {});
    CHECK(result.rms_after_um > 20.0);
    CHECK(value_of(result, "CMM.x_mm") < 0.02);  // one session: names without a day
}

TEST_CASE("a line of points does not tell how the part was turned about it",
          "[identification][sessions]") {
    const setup::Setup setup = machine();
    records::ReadingTable table = points(setup, "", 1);
    std::erase_if(table.rows, [](const records::Reading& row) {
        return row.commanded[Axis::Y] != 0.0 || row.commanded[Axis::Z] != 150.0;
    });
    measure(setup, {0.01, 0.02, 0.03}, {0, 1e-4, 2e-4}, 0.0, table);
    const auto result = identification::identify(setup, table, {});
    REQUIRE(result.inseparable.size() == 1);
    CHECK(result.rms_after_um < 1e-3);
}

TEST_CASE("a sphere that was put elsewhere on the second day moves no axis",
          "[identification][sessions]") {
    std::vector<std::string> notes;
    const setup::Setup setup =
        setup::load_setup(std::string(TRUNNION_SOURCE_DIR) + "/machines/bc_table.toml", notes);
    setup::Setup real = setup;
    real.machine.errors.axis[index_of(Axis::C)].location = {};
    records::ReadingTable whole;
    whole.path = "spheres.csv";
    for (const kinematics::AxisGeometry& axis : setup.machine.chain.axes())
        whole.axes.push_back(axis.axis);
    const Vector3 moved(0.05, -0.03, 0.02);
    for (int day = 0; day < 2; ++day) {
        records::ReadingTable table = whole;
        table.rows.clear();
        for (int k = 0; k < 36; ++k)
            for (int d = 0; d < 3; ++d) {
                records::Reading row;
                row.time_s = 1e5 * day + 10.0 * k;
                row.test = "t";
                row.session = day == 0 ? "a" : "b";
                row.device = records::Device::sphere;
                row.feature = "S1";
                row.direction_M = Vector3::Unit(d);
                row.commanded[Axis::B] = rad_from_deg(-60.0 + 24.0 * (k % 6));
                row.commanded[Axis::C] = rad_from_deg(60.0 * (k / 6));
                table.rows.push_back(row);
            }
        setup::Setup of_day = real;
        if (day == 1) of_day.artefacts[0].center_W_mm += moved;
        table = emulator::predicted(of_day, table, {});
        for (const records::Reading& row : table.rows) whole.rows.push_back(row);
    }
    const auto result = identification::identify(setup, whole, {"location"});
    CHECK(result.rms_after_um < 1e-3);
    for (int d = 0; d < 3; ++d) {
        const std::string name = std::string("S1.") + "xyz"[d] + "_mm.";
        CHECK(value_of(result, name + "b") - value_of(result, name + "a") ==
              Approx(moved(d)).margin(1e-6));
    }
    for (const identification::FitParameter& p : result.parameters)
        if (p.effect == "location" && std::isfinite(p.sigma)) CHECK(std::abs(p.value) < 1e-6);
}

}  // namespace trunnion
