// The single-set-up evaluation against lengths computed on the physical machine.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "ballbar/test/ballbar_fit.h"
#include "ballbar_machine.h"
#include "base/units.h"

using namespace trunnion;
using namespace trunnion::ballbar_test;

TEST_CASE("paper's errors go into the machine and come out of its axis lines") {
    const Bench bench;
    const auto [first, second] = ballbar::test::axis_lines(bench.truth.machine);
    const auto back = ballbar::test::intersection_errors(first, second, bench.nominal);
    const auto paper = paper_errors();
    REQUIRE(back.size() == 8);
    for (std::size_t i = 0; i < 8; ++i) {
        CHECK(back[i].name == paper[i].name);
        CHECK(std::abs(back[i].value - paper[i].value) < 1e-12);
    }
}

TEST_CASE("closed-form signals of the four rotary tests") {
    const Bench bench;
    const double ox = 75, oz = 110;
    std::map<std::string, double> e;
    for (const ballbar::test::NamedError& error : paper_errors())
        e[to_string(error.name)] = error.value;
    const double ya = e["EY0A"] + ox * e["EC0A"], za = e["EZ0A"] - ox * e["EB0A"];
    const double xc = e["EX0C"] + oz * e["EB0C"], yc = e["EY0C"] - oz * e["EA0C"];
    const auto rows = measure(bench.nominal, bench.truth, bench.layout, false);
    for (const records::Reading& row : rows) {
        const bool on_a = row.test.find("_A") != std::string::npos;
        const double angle = -row.commanded[on_a ? Axis::A : Axis::C];  // left-hand thread
        const double s = std::sin(angle), c1 = std::cos(angle) - 1.0;
        double expected = 0.0;
        if (row.test == "radial_A_pos") expected = -(-ya * s + za * c1);
        if (row.test == "radial_C_pos") expected = -(xc * c1 + yc * s);
        if (row.test == "axial_A_pos") expected = -oz * (e["EB0A"] * c1 + e["EC0A"] * s);
        if (row.test == "axial_C_pos") expected = -ox * (e["EA0C"] * s - e["EB0C"] * c1);
        CAPTURE(row.test, angle);
        CHECK(std::abs(*row.value_mm - expected) < 2.5e-4);
    }
}

TEST_CASE("noise-free the exact fit returns all eight errors") {
    Bench bench;
    bench.truth.pivot_W_mm = bench.layout.pivot_W_mm + Vector3(0.02, -0.03, 0.015);
    bench.truth.length_mm += 0.004;
    for (const bool inside : {false, true}) {
        bench.layout.inside = inside;
        const auto rows = measure(bench.nominal, bench.truth, bench.layout);
        const ballbar::test::BallbarModel model(bench.nominal, bench.layout, rows, {});
        const ballbar::test::BallbarFit fit = model.fit(values_of(rows));
        CHECK(fit.rank == 12);
        CHECK(fit.inseparable.empty());
        CHECK(fit.rms_mm < 1e-11);
        for (const ballbar::test::NamedError& e : paper_errors()) {
            const int k = fit.find(to_string(e.name));
            REQUIRE(k >= 0);
            INFO(to_string(e.name));
            CHECK(std::abs(fit.value(k) - bench.true_value(e)) < (e.name.angular() ? 1e-11 : 1e-9));
        }
        CHECK(std::abs(fit.value(fit.find("ballbar.length")) - 0.004) < 1e-9);
        CHECK(std::abs(fit.value(fit.find("ballbar.pivot.y")) + 0.03) < 1e-9);
    }
}

TEST_CASE("the published way has its published bias and no more") {
    Bench bench;
    const auto paper = paper_errors();
    for (const bool inside : {false, true}) {
        bench.layout.inside = inside;
        const auto rows = measure(bench.nominal, bench.truth, bench.layout);
        const auto published =
            ballbar::test::evaluate_as_published(bench.nominal, bench.layout, rows);
        CHECK(published.missing.empty());
        REQUIRE(published.intersection.size() == 8);
        const double side = inside ? -1.0 : 1.0;
        for (std::size_t i = 0; i < 8; ++i) {
            const std::string name = to_string(paper[i].name);
            const double off_um = 1e6 * (published.intersection[i].value - paper[i].value) /
                                  (paper[i].name.angular() ? 1.0 : 1e3);  // um or urad
            CAPTURE(inside, name, off_um);
            // The cosine error of the bar; the two large ones change sign with the cup's side.
            if (name == "EX0C")
                CHECK(std::abs(off_um - side * 0.27) < 0.01);
            else if (name == "EB0C")
                CHECK(std::abs(off_um + side * 1.5) < 0.05);
            else
                CHECK(std::abs(off_um) < (paper[i].name.angular() ? 0.5 : 0.07));
        }
    }
}

TEST_CASE("the location check finds the centre pivot and the bar's length") {
    Bench bench;
    const Vector3 off(0.012, -0.02, 0.031);
    bench.truth.pivot_W_mm =
        bench.truth.machine.poses({}).pose_MW.inverse() * (bench.layout.pivot_W_mm + off);
    bench.truth.length_mm += 0.005;
    const auto rows = measure(bench.nominal, bench.truth, bench.layout);
    const auto published = ballbar::test::evaluate_as_published(bench.nominal, bench.layout, rows);
    CHECK((published.pivot_offset_mm - off).norm() < 2e-5);
    CHECK(std::abs(published.length_error_mm + 0.005) < 2e-5);
    CHECK(published.setup_rms_mm < 1e-5);
}

TEST_CASE("a wrong tool length reads as EZ0A and a cup offset as a shift of the axes") {
    Bench bench;
    const auto paper = paper_errors();
    const std::vector<std::pair<Vector3, std::vector<std::size_t>>> cases = {
        {Vector3(0, 0, 0.01), {1}}, {Vector3(0.01, 0, 0), {4}}, {Vector3(0, 0.01, 0), {0, 5}}};
    for (const auto& [off, moved] : cases) {
        bench.truth.cup_S_mm = bench.layout.cup_S_mm + off;
        const auto rows = measure(bench.nominal, bench.truth, bench.layout);
        const ballbar::test::BallbarModel model(bench.nominal, bench.layout, rows, {});
        const auto found =
            ballbar::test::intersection_estimates(bench.nominal, model.fit(values_of(rows)), 0.0);
        for (std::size_t i = 0; i < 8; ++i) {
            const bool shifts = std::find(moved.begin(), moved.end(), i) != moved.end();
            CAPTURE(to_string(paper[i].name), off.transpose());
            CHECK(std::abs(found[i].value - paper[i].value + (shifts ? 0.01 : 0.0)) < 2e-5);
        }
        // Told the true cup, the fit has them right.
        ballbar::test::BallbarLayout known = bench.layout;
        known.cup_S_mm = bench.truth.cup_S_mm;
        const ballbar::test::BallbarModel resolved(bench.nominal, known, rows, {});
        const auto right = ballbar::test::intersection_estimates(
            bench.nominal, resolved.fit(values_of(rows)), 0.0);
        for (std::size_t i = 0; i < 8; ++i) CHECK(std::abs(right[i].value - paper[i].value) < 1e-9);
    }
}

TEST_CASE("after compensation and a new measurement every error is within three sigma of zero") {
    Bench bench;
    SeededNoise noise(11);
    const auto rows = measure(bench.nominal, bench.truth, bench.layout, true, true);
    const ballbar::test::BallbarModel model(bench.nominal, bench.layout, rows, {});
    auto values = values_of(rows);
    add_noise(values, 0.5e-3, noise);
    const ballbar::test::BallbarFit first = model.fit(values);
    const kinematics::Machine known = ballbar::test::machine_of(bench.nominal, first);
    // The control leads the cup to where the programmed path would have put it on a perfect
    // machine.
    auto again = rows;
    for (records::Reading& row : again) {
        const AxisPositions q =
            ballbar::test::compensated(row.commanded, bench.nominal, known, bench.layout.cup_S_mm);
        const kinematics::MachinePose pose = bench.truth.machine.poses(q);
        row.value_mm =
            (pose.pose_MS * bench.truth.cup_S_mm - pose.pose_MW * bench.truth.pivot_W_mm).norm() -
            100.0;
    }
    values = values_of(again);
    add_noise(values, 0.5e-3, noise);
    const ballbar::test::BallbarFit second =
        ballbar::test::BallbarModel(bench.nominal, bench.layout, again, {}).fit(values);
    const double sigma = std::sqrt(2.0) * ballbar::test::reading_sigma_mm(second, 0.5e-3);
    for (const ballbar::test::ErrorEstimate& e : ballbar::test::chain_estimates(second, sigma)) {
        CAPTURE(to_string(e.name), e.value, e.sigma);
        CHECK(std::abs(e.value) < 3.0 * e.sigma);
        CHECK(std::abs(e.value) <
              0.1 * std::abs(bench.truth.machine.errors.location(e.name)) + 5e-6);
    }
}

TEST_CASE("errors of linear axes are not absorbed - the residual shows them") {
    Bench bench;
    SeededNoise noise(5);
    auto rows = measure(bench.nominal, bench.truth, bench.layout, true, true);
    auto values = values_of(rows);
    add_noise(values, 0.3e-3, noise);
    {
        const ballbar::test::BallbarModel model(bench.nominal, bench.layout, rows, {});
        const ballbar::test::ResidualVerdict verdict =
            ballbar::test::judge_residuals(model, model.fit(values));
        CHECK_FALSE(verdict.structured);
    }
    for (const kinematics::ErrorName name :
         {kinematics::ErrorName{'C', true, Axis::Y}, kinematics::ErrorName{'X', false, Axis::X}}) {
        Bench bad = bench;
        if (name.location)
            bad.truth.machine.errors.location(name) = 3e-5;  // squareness
        else
            bad.truth.machine.errors.motion(name).slope = 2e-5;  // scale
        rows = measure(bad.nominal, bad.truth, bad.layout, true, true);
        values = values_of(rows);
        add_noise(values, 0.3e-3, noise);
        const ballbar::test::BallbarModel model(bad.nominal, bad.layout, rows, {});
        const ballbar::test::ResidualVerdict verdict =
            ballbar::test::judge_residuals(model, model.fit(values));
        CAPTURE(to_string(name), verdict.excess_um, verdict.worst_test);
        CHECK(verdict.structured);
        CHECK(verdict.excess_um > 0.3);
    }
}

TEST_CASE("the same evaluation serves a B-C table") {
    Bench bench;
    bench.nominal.chain.work[0].axis = Axis::B;
    bench.nominal.chain.work[0].direction = -Vector3::UnitY();
    bench.truth.machine = bench.nominal;
    const std::vector<ballbar::test::NamedError> errors = {
        {{'X', true, Axis::B}, 0.021}, {{'Z', true, Axis::B}, -0.013}, {{'A', true, Axis::B}, 4e-5},
        {{'C', true, Axis::B}, -6e-5}, {{'X', true, Axis::C}, 0.017},  {{'Y', true, Axis::C}, 0.03},
        {{'A', true, Axis::C}, 3e-5},  {{'B', true, Axis::C}, -2e-5}};
    bench.truth.machine = with_lines(bench.nominal, errors);
    bench.truth.pivot_W_mm = bench.layout.pivot_W_mm + Vector3(0.02, -0.03, 0.015);
    const auto rows = measure(bench.nominal, bench.truth, bench.layout);
    const ballbar::test::BallbarModel model(bench.nominal, bench.layout, rows, {});
    const ballbar::test::BallbarFit fit = model.fit(values_of(rows));
    CHECK(fit.rank == 12);
    const auto found = ballbar::test::intersection_estimates(bench.nominal, fit, 0.0);
    const auto published = ballbar::test::evaluate_as_published(bench.nominal, bench.layout, rows);
    REQUIRE(found.size() == 8);
    for (std::size_t i = 0; i < 8; ++i) {
        CHECK(found[i].name == errors[i].name);
        CHECK(std::abs(found[i].value - errors[i].value) < 1e-9);
        const double allowed = errors[i].name.angular() ? 2e-6 : 3e-4;
        CHECK(std::abs(published.intersection[i].value - errors[i].value) < allowed);
    }
}

TEST_CASE("names of ballbar passes") {
    CHECK(to_string(*ballbar::test::parse_ballbar_test("radial_A_pos")) == "radial_A");
    CHECK(to_string(*ballbar::test::parse_ballbar_test("AXIAL_C_NEG")) == "axial_C");
    CHECK(to_string(*ballbar::test::parse_ballbar_test("xy_ccw_1000")) == "xy");
    CHECK_FALSE(ballbar::test::parse_ballbar_test("xyz"));
    CHECK_FALSE(ballbar::test::parse_ballbar_test("map"));
    CHECK_FALSE(ballbar::test::parse_ballbar_test("radial_X"));
    const Bench bench;
    const auto rows = measure(bench.nominal, bench.truth, bench.layout, true, true);
    const auto passes = ballbar::test::ballbar_passes(rows);
    REQUIRE(passes.size() == 14);
    CHECK(passes[0].travel == Approx(2 * pi).epsilon(0.01));
    CHECK(passes[7].travel == Approx(-2 * pi).epsilon(0.01));
    CHECK(passes[1].travel == Approx(rad_from_deg(220)).epsilon(0.01));
    CHECK(passes[3].travel == Approx(rad_from_deg(120)).epsilon(0.01));
}
