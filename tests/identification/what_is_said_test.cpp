// What a fit says beside its values: bends, poses in words, sides, searches that were ended.
#include <catch2/catch.hpp>
#include <cmath>

#include "base/alarm.h"
#include "identification/monte_carlo.h"
#include "identification/set_up_words.h"
#include "identification/unknown_sides.h"
#include "tests/support/campaign.h"
#include "tests/support/laser_machine.h"

namespace trunnion {
namespace {

/// A laser along X, -400 to 400 mm, of a scale with a bend; its repetitions are off by +-0.3 um.
records::ReadingTable laser(const setup::Setup& setup, double scale_ppm, double bow_mm) {
    records::ReadingTable table;
    table.path = "laser.csv";
    table.names = setup.machine.chain.names();
    for (const kinematics::AxisGeometry& axis : setup.machine.chain.axes())
        table.axes.push_back(axis.axis);
    for (int k = 0; k < 34; ++k) {
        records::Reading row;
        row.index = k;
        row.time_s = 60.0 * k;
        row.test = "X";
        row.feature = "R1";
        row.direction_M = Vector3::UnitX();
        const double x_mm = 50.0 * (k / 2 - 8);
        row.device = records::Device::linear;
        row.commanded[Axis::X] = x_mm;
        row.value_mm = 1e-6 * scale_ppm * x_mm + bow_mm * std::pow(x_mm / 200.0, 2) +
                       (k % 2 == 0 ? 3e-4 : -3e-4);
        table.rows.push_back(row);
    }
    return table;
}

std::vector<std::string> notes_of(double scale_ppm, double bow_mm) {
    const setup::Setup setup = laser_machine();
    return identification::identify(setup, laser(setup, scale_ppm, bow_mm), {"X.scale"}).notes;
}

identification::FitParameter pose_part(int component, double value) {
    identification::FitParameter p;
    p.of_set_up = true;
    p.set_up.kind = identification::SetUpQuantity::Kind::instrument;
    p.set_up.component = component;
    p.value = value;
    return p;
}

}  // namespace

TEST_CASE("a scale that bends is said with its straight line, one that does not is held straight",
          "[identification]") {
    const std::vector<std::string> bent = notes_of(30.0, 0.004), straight = notes_of(30.0, 0.0);
    REQUIRE(bent.size() == 1);
    // The bow is even over the travel: the straight line has the scale alone.
    CHECK(bent[0] == "X.scale bends; as one straight line over -400 to 400 mm it is 30 ppm");
    REQUIRE(straight.size() == 1);
    CHECK(straight[0] == "X.scale: the readings show no curvature; its higher terms are 0");
}

TEST_CASE("the pose of an instrument in words has the parts that the readings tell",
          "[identification]") {
    setup::Setup setup = laser_machine();
    setup.instruments.emplace_back();
    setup.instruments[0].name = "T1";
    const auto words = [&](const std::vector<identification::FitParameter>& parts) {
        return identification::set_up_words(setup, parts);
    };
    CHECK(words({}).empty());
    CHECK(words({pose_part(6, 5e-6)}) ==
          std::vector<std::string>{"T1 sees the machine scaled by 5.00 ppm"});
    CHECK(
        words({pose_part(5, 1e-3), pose_part(6, 5e-6)}) ==
        std::vector<std::string>{"T1 sees the machine turned by 0.05730 deg, scaled by 5.00 ppm"});
    CHECK(words({pose_part(1, 0.02)}) ==
          std::vector<std::string>{"T1 sees the machine shifted by (0.0000, 0.0200, 0.0000) mm"});
    CHECK(words({pose_part(2, 0.02), pose_part(4, 1e-3), pose_part(6, -1e-6)}) ==
          std::vector<std::string>{"T1 sees the machine turned by 0.05730 deg, shifted by (0.0000, "
                                   "0.0000, 0.0200) mm, scaled by -1.00 ppm"});
    setup.instruments[0].sees_table = true;
    identification::FitParameter unseen = pose_part(0, 0.5);
    unseen.sigma = std::numeric_limits<double>::quiet_NaN();
    CHECK(words({unseen}).empty());
    CHECK(words({unseen, pose_part(3, 1e-3)}) ==
          std::vector<std::string>{"the part was turned by 0.05730 deg"});
}

TEST_CASE("a side that nothing tells is said to be taken, one that the fit tells by how much",
          "[identification]") {
    identification::FoundSide side{0, "C", -1};
    CHECK_FALSE(side.told());
    CHECK(side.value() == 0.0);
    CHECK(side.sigma() == 1.0);
    CHECK(identification::to_string(side) ==
          "no row tells from which side C came before its first motion, nor do the readings: taken "
          "as -");
    side.worse = 40.0;
    side.side = 1;
    CHECK(side.told());
    CHECK(side.value() == Approx(1.0));
    CHECK(side.sigma() < 1e-4);
    CHECK_THAT(identification::to_string(side),
               Catch::Contains("C came travelling + (the other side fits worse by 40 "));
}

namespace {

setup::Setup one_axis() {
    std::vector<std::string> notes;
    return setup::parse_setup(
        "[machine]\nname = \"m\"\nchain = \"w b X t\"\n"
        "[model]\nnoise_um = { axis = 1 }\n",
        "s.toml", notes);
}

}  // namespace

TEST_CASE("a following error at speed is plausible in a servo log, as far as a delay makes it",
          "[identification]") {
    const setup::Setup setup = one_axis();
    const effects::Catalogue catalogue = effects::make_catalogue(setup);
    const auto fit = [&](double lag_s, double still_mm) {
        records::ReadingTable log;
        log.path = "log.csv";
        log.axes = {Axis::X};
        for (int k = 0; k < 400; ++k) {  // to and fro, 200 mm/s in the middle, then standing
            records::Reading row;
            row.index = k;
            row.time_s = 0.01 * k;
            row.test = "log";
            row.device = records::Device::axis;
            row.feature = "X";
            const double angle = 0.05 * k;
            row.commanded[Axis::X] = k < 200 ? 40.0 * std::sin(angle) : 40.0 * std::sin(10.0);
            row.value_mm = k < 200      ? -lag_s * 200.0 * std::cos(angle)
                           : k % 2 == 0 ? still_mm
                                        : -still_mm;
            log.rows.push_back(row);
        }
        const emulator::Replay replay(setup, log);
        return identification::fit_base(setup, log, replay, catalogue, {});
    };
    CHECK_NOTHROW(fit(0.02, 0.0));
    CHECK_NOTHROW(fit(0.09, 0.0));  // 18 mm
    CHECK_NOTHROW(fit(0.2, 0.0));   // 40 mm, of a slow drive
    CHECK_THROWS_AS(fit(0.4, 0.0), InputError);
    CHECK_THROWS_AS(fit(0.0, 6.0), InputError);
}

TEST_CASE("an axis that stops after a fast move lags on, and that is plausible",
          "[identification]") {
    const setup::Setup setup = one_axis();
    const double row_s = 0.005, lag_s = 0.04, speed = 120.0;
    records::ReadingTable log;
    log.path = "log.csv";
    log.axes = {Axis::X};
    double commanded = 0.0, actual = 0.0;
    for (int k = 0; k < 400; ++k) {  // 0.1 s of motion, 0.1 s of rest, by turns
        records::Reading row;
        row.index = k;
        row.time_s = row_s * k;
        row.test = "log";
        row.device = records::Device::axis;
        row.feature = "X";
        row.commanded[Axis::X] = commanded;
        row.value_mm = actual - commanded;
        log.rows.push_back(row);
        if (k / 20 % 2 == 0) commanded += speed * row_s;
        actual += (commanded - actual) * (1.0 - std::exp(-row_s / lag_s));
    }
    const emulator::Replay replay(setup, log);
    CHECK_NOTHROW(identification::fit_base(setup, log, replay, effects::make_catalogue(setup), {}));
}

TEST_CASE("a fit needs two readings, more readings than unknowns and effects that there are",
          "[identification]") {
    const setup::Setup setup = laser_machine();
    records::ReadingTable table = laser(setup, 10.0, 0.0);
    CHECK_THROWS_AS(identification::identify(setup, table, {"X.scales"}), InputError);
    table.rows = {table.rows[0], table.rows[2]};  // a scale and the laser's zero
    CHECK_THROWS_AS(identification::identify(setup, table, {"X.scale"}), InputError);
    table.rows.resize(1);
    CHECK_THROWS_AS(identification::identify(setup, table, {"X.scale"}), InputError);
}

TEST_CASE("a search of keys that is ended names what it did not search", "[identification]") {
    const setup::Setup setup = campaign::bc_setup();
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_sphere_map(table, setup, 20, 3);
    const records::ReadingTable readings = campaign::measured(setup, table, 1);
    const auto result =
        identification::identify(setup, readings, {"thermal.drift"}, [] { return false; });
    CHECK(result.not_searched == std::vector<std::string>{"thermal.drift"});
    CHECK(identification::identify(setup, readings, {"thermal.drift"}, [] {
              return true;
          }).not_searched.empty());
}

TEST_CASE("what ends a repetition by an exception comes out of all threads", "[identification]") {
    const setup::Setup setup = laser_machine();
    const records::ReadingTable table = laser(setup, 10.0, 0.0);
    identification::Identification fitted = identification::identify(setup, table, {"X.scale"});
    for (const unsigned threads : {1U, 3U}) {
        const identification::RepetitionPlan plan{
            9, 1, 0, 1, threads, [](int) -> bool { throw InputError("enough", {}); }};
        CHECK_THROWS_AS(
            identification::repeat_identification(setup, table, {"X.scale"}, plan, fitted),
            InputError);
    }
    CHECK(identification::spread({}).empty());
    fitted.parameters[0].sigma = std::numeric_limits<double>::quiet_NaN();
    identification::RepetitionPlan plan;
    plan.runs = 3;
    identification::enter_spread(
        identification::repeat_identification(setup, table, {"X.scale"}, plan, fitted), fitted);
    CHECK(std::isnan(fitted.parameters[0].sigma_monte_carlo));
    CHECK(fitted.parameters[1].sigma_monte_carlo > 0.0);
}

}  // namespace trunnion
