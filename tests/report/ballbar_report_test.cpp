// The whole single-set-up procedure on the emulated machine, and what is reported of it.
#include "report/ballbar_report.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "ballbar/test/ballbar_procedure.h"
#include "base/alarm.h"
#include "base/units.h"
#include "report/ballbar_json.h"
#include "report/ballbar_pictures.h"
#include "report/polar_plot.h"

using namespace trunnion;

namespace {

setup::Setup ac_setup(double noise_um) {
    std::vector<std::string> notes;
    setup::Setup setup =
        setup::load_setup(std::string(TRUNNION_SOURCE_DIR) + "/machines/ac_trunnion.toml", notes);
    setup.ballbar->noise_um = noise_um;
    setup.ballbar->sample_hz = 8.0;
    return setup;
}

const ballbar::test::BallbarErrorRow& row(const std::vector<ballbar::test::BallbarErrorRow>& rows,
                                          const std::string& name) {
    for (const ballbar::test::BallbarErrorRow& r : rows)
        if (to_string(r.name) == name) return r;
    FAIL("no row " + name);
    return rows.front();
}

}  // namespace

TEST_CASE("run, identify, compensate, run again - every error within three sigma of zero") {
    const setup::Setup setup = ac_setup(0.5);
    const ballbar::test::BallbarResult result = ballbar::test::run_ballbar(setup, {});
    REQUIRE(result.errors.size() == 8);
    for (const ballbar::test::BallbarErrorRow& r : result.errors) {
        CAPTURE(to_string(r.name), r.before, r.after, r.sigma);
        CHECK(r.sigma_before > 0.0);
        CHECK(r.sigma > r.sigma_before);
        CHECK(std::abs(r.before - setup.machine.errors.location(r.name)) < 3.5 * r.sigma_before);
        CHECK(std::abs(r.after) < 3.0 * r.sigma);
        REQUIRE(r.published_before);
        CHECK(std::abs(*r.published_before - r.before) < (r.name.angular() ? 4e-6 : 5e-4));
    }
    CHECK_FALSE(result.verdict.structured);
    CHECK(result.open_fit.rank == 12);
    CHECK(result.open_fit.parameters.size() == 15);
    // Less than two set-ups by at least the published 40 %.
    CHECK(result.single_setup_s() < 0.6 * result.two_setups_s());
    CHECK(result.times.setup_s == 600.0);
}

TEST_CASE("noise-free the procedure is exact and the tilts are compensated too") {
    const ballbar::test::BallbarResult result = ballbar::test::run_ballbar(ac_setup(0.0), {});
    for (const ballbar::test::BallbarErrorRow& r : result.errors) {
        CAPTURE(to_string(r.name), r.after);
        CHECK(std::abs(r.after) < (r.name.angular() ? 1e-9 : 1e-6));
    }
    for (const ballbar::test::BallbarErrorRow& r : result.at_intersection)
        CHECK(std::abs(r.after) < (r.name.angular() ? 1e-9 : 1e-6));
    // 19700-19702 hold a point of the A axis, 19703-19705 lead from there to the C axis.
    CHECK(result.true_tip->stated_um < 1e-3);
    CHECK(result.true_tip->cup_um < 1e-3);
    for (const ballbar::test::BallbarErrorRow& r : result.errors)
        CHECK(std::abs(*r.truly_left) < (r.name.angular() ? 1e-9 : 1e-6));
    for (const ballbar::test::BallbarErrorRow& r : result.at_intersection)
        CHECK(std::abs(*r.truly_left) < (r.name.angular() ? 1e-9 : 1e-6));
    CHECK(result.sphere_check->after_um < 1e-3);
    CHECK(result.sphere_check->before_um > 50.0);
    REQUIRE(result.stores);
    const offsets::PivotParameters& p = result.stores->exact.pivot;
    CHECK(p.table_point_mm.y() == Approx(0.0726).margin(1e-6));
    CHECK(p.table_point_mm.z() == Approx(-0.0202).margin(1e-6));
    CHECK(p.table_offset_mm.x() == Approx(0.0283).margin(1e-6));
    CHECK(p.table_offset_mm.y() == Approx(0.1041).margin(1e-6));
}

TEST_CASE("a wrong tool length reads as EZ0A and is named as what cannot be told apart") {
    setup::Setup setup = ac_setup(0.0);
    setup.ballbar->cup_S_mm.z() -= 0.01;  // the tool is 10 um longer than its offset says
    const ballbar::test::BallbarResult result = ballbar::test::run_ballbar(setup, {});
    CHECK(row(result.errors, "EZ0A").before - (-0.0202) == Approx(0.01).margin(1e-5));
    CHECK(std::abs(row(result.errors, "EZ0A").after) < 1e-6);
    // What the bar's own re-test misses, another instrument shows.
    REQUIRE(result.sphere_check);
    CHECK(result.sphere_check->after_um > 9.0);
    REQUIRE(result.true_tip);
    CHECK(result.true_tip->stated_um > 9.0);
    CHECK(result.true_tip->cup_um < 1e-3);
    CHECK(*row(result.errors, "EZ0A").truly_left == Approx(-0.01).margin(1e-5));
    bool named = false;
    for (const ballbar::test::InseparableGroup& group : result.open_fit.inseparable)
        named |= std::count(group.names.begin(), group.names.end(), "EZ0A") == 1 &&
                 std::count(group.names.begin(), group.names.end(), "ballbar.cup.z") == 1;
    CHECK(named);
    setup.stores.tools.tool[2].length_geometry_mm += 0.01;  // told the truth
    const ballbar::test::BallbarResult known = ballbar::test::run_ballbar(setup, {});
    CHECK(row(known.errors, "EZ0A").before == Approx(-0.0202).margin(1e-6));
}

TEST_CASE("errors of the linear axes are handed to diagnosis") {
    setup::Setup setup = ac_setup(0.3);
    setup.machine.errors.location(*kinematics::parse_error_name("EC0Y")) = 4e-5;
    const ballbar::test::BallbarResult result = ballbar::test::run_ballbar(setup, {});
    CHECK(result.verdict.structured);
    const std::string text = report::ballbar_table(result);
    CHECK_THAT(text, Catch::Contains("trunnion diagnose R.csv --setup"));
    for (const ballbar::test::PlanarResult& planar : result.planar) {
        if (planar.test.plane != ballbar::test::BallbarTestKind::xy) continue;
        const ballbar::test::CircularCause& first = planar.diagnosis.causes.front();
        CHECK(first.name == "squareness XY");
        CHECK(first.value == Approx(40.0).margin(4.0 * first.sigma));
    }
}

TEST_CASE("a bar out of its range is said with the pass") {
    setup::Setup setup = ac_setup(0.0);
    setup.machine.errors.location(*kinematics::parse_error_name("EX0C")) = 3.0;
    CHECK_THROWS_MATCHES(ballbar::test::run_ballbar(setup, {}), InputError,
                         Catch::Matchers::Predicate<InputError>([](const InputError& e) {
                             return e.message.find("out of its range of 1 mm") !=
                                        std::string::npos &&
                                    e.message.find("in test zx_ccw_2000") != std::string::npos &&
                                    e.message.find("more passes") != std::string::npos;
                         }));
}

TEST_CASE("ballbar JSON holds the keys of the contract") {
    const ballbar::test::BallbarResult result = ballbar::test::run_ballbar(ac_setup(0.5), {});
    const auto json = nlohmann::json::parse(report::ballbar_json(result));
    CHECK(json["schema"] == "trunnion.ballbar/1");
    REQUIRE(json["errors"].size() == 8);
    for (const auto& e : json["errors"])
        for (const char* key : {"name", "before", "after", "sigma", "unit", "published_before"})
            CHECK(e.contains(key));
    CHECK(json["errors"][0]["name"] == "EY0A");
    CHECK(json["errors"][0]["unit"] == "mm");
    CHECK(json["errors"][0]["before"].get<double>() == Approx(0.0726).margin(1e-3));
    CHECK(json["time_s"].get<double>() > 100.0);
    REQUIRE(json["circularity"].size() == 3);
    CHECK(json["circularity"][0]["circularity_ccw_um"].get<double>() > 0.0);
    CHECK(json["rank"] == 12);
    CHECK(json["inseparable"].size() == 3);
}

TEST_CASE("same seed, same report") {
    const setup::Setup setup = ac_setup(0.5);
    CHECK(report::ballbar_json(ballbar::test::run_ballbar(setup, {})) ==
          report::ballbar_json(ballbar::test::run_ballbar(setup, {})));
    ballbar::test::BallbarProcedureOptions other;
    other.seed = 2;
    CHECK(report::ballbar_json(ballbar::test::run_ballbar(setup, {})) !=
          report::ballbar_json(ballbar::test::run_ballbar(setup, other)));
}

TEST_CASE("polar plots have a scale, both directions and the fitted circle") {
    report::PolarPlot plot;
    plot.title = "XY";
    report::PolarTrace trace{"ccw", {}, {}};
    for (int i = 0; i < 360; ++i) {
        trace.angle_rad.push_back(rad_from_deg(i));
        trace.radial_um.push_back(3.0 + 6.5 * std::cos(rad_from_deg(i)) -
                                  2.0 * std::sin(rad_from_deg(i)));
    }
    plot.traces = {trace, trace};
    plot.fitted_um = report::fit_eccentric_circle(plot.traces);
    REQUIRE(plot.fitted_um.size() == 3);
    CHECK(plot.fitted_um[0] == Approx(3.0));
    CHECK(plot.fitted_um[1] == Approx(6.5));
    CHECK(plot.fitted_um[2] == Approx(-2.0));
    CHECK(report::um_per_division(plot) == 5.0);  // 9.8 um within four divisions
    const std::string svg = report::polar_svg(plot);
    CHECK_THAT(svg, Catch::Contains("5 µm/div") && Catch::Contains("fitted circle"));
    CHECK(svg.find("nan") == std::string::npos);
    const auto pictures = report::ballbar_pictures(ballbar::test::run_ballbar(ac_setup(0.5), {}));
    CHECK(pictures.size() == 7);
    CHECK(pictures.count("radial_A.svg") == 1);
    CHECK(pictures.count("xy_2000.svg") == 1);
}
