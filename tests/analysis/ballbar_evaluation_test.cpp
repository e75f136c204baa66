// The single-set-up evaluation against lengths computed on the physical machine.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "analysis/ballbar_fit.h"
#include "ballbar_machine.h"
#include "geometry/units.h"

using namespace trunnion;
using namespace trunnion::ballbar_test;

namespace {

struct Bench {
    Machine nominal = nominal_ac();
    BallbarLayout layout;
    Truth truth;

    Bench() {
        truth = {with_lines(nominal, paper_errors()), layout.cup_S_mm, layout.pivot_W_mm, 100.0};
        // The operator clamps the centre pivot where the spindle says the origin is: with all axes
        // at zero it stands at its stated place in M, errors of the table or not.
        truth.pivot_W_mm = truth.machine.poses({}).pose_MW.inverse() * layout.pivot_W_mm;
    }
    double true_value(const NamedError& e) const { return truth.machine.errors.location(e.name); }
};

}  // namespace

TEST_CASE("paper's errors go into the machine and come out of its axis lines") {
    const Bench bench;
    const auto [first, second] = axis_lines(bench.truth.machine);
    const auto back = intersection_errors(first, second, bench.nominal);
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
    for (const NamedError& error : paper_errors()) e[to_string(error.name)] = error.value;
    const double ya = e["EY0A"] + ox * e["EC0A"], za = e["EZ0A"] - ox * e["EB0A"];
    const double xc = e["EX0C"] + oz * e["EB0C"], yc = e["EY0C"] - oz * e["EA0C"];
    const auto rows = measure(bench.nominal, bench.truth, bench.layout, false);
    for (const Reading& row : rows) {
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
        const BallbarModel model(bench.nominal, bench.layout, rows, {});
        const BallbarFit fit = model.fit(values_of(rows));
        CHECK(fit.rank == 12);
        CHECK(fit.inseparable.empty());
        CHECK(fit.rms_mm < 1e-11);
        for (const NamedError& e : paper_errors()) {
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
        const auto published = evaluate_as_published(bench.nominal, bench.layout, rows);
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
    const auto published = evaluate_as_published(bench.nominal, bench.layout, rows);
    CHECK((published.pivot_offset_mm - off).norm() < 2e-5);
    CHECK(std::abs(published.length_error_mm + 0.005) < 2e-5);
    CHECK(published.setup_rms_mm < 1e-5);
}

TEST_CASE("predicted uncertainties are the Cramer-Rao bounds of the facts") {
    const Bench bench;
    // One free constant a test: nothing but the shape of the four signals counts.
    const std::vector<double> um_urad = {0.142, 0.225, 1.69, 1.07, 0.066, 0.066, 0.50, 0.50};
    const auto rows = measure(bench.nominal, bench.truth, bench.layout, false);
    const BallbarModel model(bench.nominal, bench.layout, rows,
                             {false, false, BarConstant::per_test});
    const auto estimates =
        intersection_estimates(bench.nominal, model.fit(values_of(rows)), 0.5e-3);
    for (std::size_t i = 0; i < 8; ++i) {
        const ErrorEstimate& e = estimates[i];
        CHECK(e.sigma * (e.name.angular() ? 1e6 : 1e3) == Approx(um_urad[i]).epsilon(0.012));
    }
}

TEST_CASE("200 noisy runs scatter as predicted and are centred on the truth") {
    Bench bench;
    bench.truth.pivot_W_mm = bench.layout.pivot_W_mm;
    const auto paper = paper_errors();
    const auto rows = measure(bench.nominal, bench.truth, bench.layout, false);
    const BallbarModel model(bench.nominal, bench.layout, rows,
                             {false, false, BarConstant::per_test});
    const auto predicted =
        intersection_estimates(bench.nominal, model.fit(values_of(rows)), 0.5e-3);
    SeededNoise noise(2015);
    const int runs = 200;  // 3000 runs agree within 2.5 %
    std::vector<double> mean(8, 0.0), square(8, 0.0);
    double rms = 0.0;
    for (int run = 0; run < runs; ++run) {
        auto values = values_of(rows);
        add_noise(values, 0.5e-3, noise);
        const BallbarFit fit = model.fit(values);
        const auto [first, second] = axis_lines(machine_of(bench.nominal, fit));
        const auto found = intersection_errors(first, second, bench.nominal);
        for (std::size_t i = 0; i < 8; ++i) {
            const double off = found[i].value - paper[i].value;
            mean[i] += off / runs;
            square[i] += off * off / runs;
        }
        rms += fit.rms_mm / runs;
    }
    CHECK(rms == Approx(0.5e-3).epsilon(0.01));
    for (std::size_t i = 0; i < 8; ++i) {
        CAPTURE(to_string(paper[i].name), std::sqrt(square[i]) / predicted[i].sigma);
        CHECK(std::sqrt(square[i]) == Approx(predicted[i].sigma).epsilon(0.10));
        CHECK(std::abs(mean[i]) < 3.5 * predicted[i].sigma / std::sqrt(runs));
    }
}

TEST_CASE("rank 12 of 15 - tool cup, centre pivot and both axes move together") {
    const Bench bench;
    auto rows = measure(bench.nominal, bench.truth, bench.layout);
    const BallbarModel model(bench.nominal, bench.layout, rows, {true, true, BarConstant::length});
    const BallbarFit fit = model.fit(values_of(rows));
    CHECK(fit.parameters.size() == 15);
    CHECK(fit.rank == 12);
    REQUIRE(fit.inseparable.size() == 3);
    CHECK_FALSE(fit.determined(fit.find("EZ0A")));
    CHECK_FALSE(fit.determined(fit.find("ballbar.cup.z")));
    CHECK(fit.determined(fit.find("EB0A")));
    CHECK(fit.determined(fit.find("ballbar.length")));
    for (const InseparableGroup& group : fit.inseparable) {
        // Along each group no reading changes.
        Eigen::VectorXd at = fit.value;
        for (std::size_t i = 0; i < group.names.size(); ++i)
            at(fit.find(group.names[i])) += 0.01 * group.direction[i];
        const auto moved = model.predict(at), before = model.predict(fit.value);
        for (std::size_t i = 0; i < moved.size(); ++i) CHECK(std::abs(moved[i] - before[i]) < 5e-6);
    }
    // The four tests of the rotary axes alone leave two more open.
    rows = measure(bench.nominal, bench.truth, bench.layout, false);
    CHECK(BallbarModel(bench.nominal, bench.layout, rows, {true, true, BarConstant::length})
              .fit(values_of(rows))
              .rank == 10);
}

TEST_CASE("a wrong tool length reads as EZ0A and a cup offset as a shift of the axes") {
    Bench bench;
    const auto paper = paper_errors();
    const std::vector<std::pair<Vector3, std::vector<std::size_t>>> cases = {
        {Vector3(0, 0, 0.01), {1}}, {Vector3(0.01, 0, 0), {4}}, {Vector3(0, 0.01, 0), {0, 5}}};
    for (const auto& [off, moved] : cases) {
        bench.truth.cup_S_mm = bench.layout.cup_S_mm + off;
        const auto rows = measure(bench.nominal, bench.truth, bench.layout);
        const BallbarModel model(bench.nominal, bench.layout, rows, {});
        const auto found = intersection_estimates(bench.nominal, model.fit(values_of(rows)), 0.0);
        for (std::size_t i = 0; i < 8; ++i) {
            const bool shifts = std::find(moved.begin(), moved.end(), i) != moved.end();
            CAPTURE(to_string(paper[i].name), off.transpose());
            CHECK(std::abs(found[i].value - paper[i].value + (shifts ? 0.01 : 0.0)) < 2e-5);
        }
        // Told the true cup, the fit has them right.
        BallbarLayout known = bench.layout;
        known.cup_S_mm = bench.truth.cup_S_mm;
        const BallbarModel resolved(bench.nominal, known, rows, {});
        const auto right =
            intersection_estimates(bench.nominal, resolved.fit(values_of(rows)), 0.0);
        for (std::size_t i = 0; i < 8; ++i) CHECK(std::abs(right[i].value - paper[i].value) < 1e-9);
    }
}

TEST_CASE("after compensation and a new measurement every error is within three sigma of zero") {
    Bench bench;
    SeededNoise noise(11);
    const auto rows = measure(bench.nominal, bench.truth, bench.layout, true, true);
    const BallbarModel model(bench.nominal, bench.layout, rows, {});
    auto values = values_of(rows);
    add_noise(values, 0.5e-3, noise);
    const BallbarFit first = model.fit(values);
    const Machine known = machine_of(bench.nominal, first);
    // The control leads the cup to where the programmed path would have put it on a perfect
    // machine.
    auto again = rows;
    for (Reading& row : again) {
        const AxisPositions q =
            compensated(row.commanded, bench.nominal, known, bench.layout.cup_S_mm);
        const MachinePose pose = bench.truth.machine.poses(q);
        row.value_mm =
            (pose.pose_MS * bench.truth.cup_S_mm - pose.pose_MW * bench.truth.pivot_W_mm).norm() -
            100.0;
    }
    values = values_of(again);
    add_noise(values, 0.5e-3, noise);
    const BallbarFit second = BallbarModel(bench.nominal, bench.layout, again, {}).fit(values);
    const double sigma = std::sqrt(2.0) * reading_sigma_mm(second, 0.5e-3);
    for (const ErrorEstimate& e : chain_estimates(second, sigma)) {
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
        const BallbarModel model(bench.nominal, bench.layout, rows, {});
        const ResidualVerdict verdict = judge_residuals(model, model.fit(values));
        CHECK_FALSE(verdict.structured);
    }
    for (const ErrorName name : {ErrorName{'C', true, Axis::Y}, ErrorName{'X', false, Axis::X}}) {
        Bench bad = bench;
        if (name.location)
            bad.truth.machine.errors.location(name) = 3e-5;  // squareness
        else
            bad.truth.machine.errors.motion(name).slope = 2e-5;  // scale
        rows = measure(bad.nominal, bad.truth, bad.layout, true, true);
        values = values_of(rows);
        add_noise(values, 0.3e-3, noise);
        const BallbarModel model(bad.nominal, bad.layout, rows, {});
        const ResidualVerdict verdict = judge_residuals(model, model.fit(values));
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
    const std::vector<NamedError> errors = {
        {{'X', true, Axis::B}, 0.021}, {{'Z', true, Axis::B}, -0.013}, {{'A', true, Axis::B}, 4e-5},
        {{'C', true, Axis::B}, -6e-5}, {{'X', true, Axis::C}, 0.017},  {{'Y', true, Axis::C}, 0.03},
        {{'A', true, Axis::C}, 3e-5},  {{'B', true, Axis::C}, -2e-5}};
    bench.truth.machine = with_lines(bench.nominal, errors);
    bench.truth.pivot_W_mm = bench.layout.pivot_W_mm + Vector3(0.02, -0.03, 0.015);
    const auto rows = measure(bench.nominal, bench.truth, bench.layout);
    const BallbarModel model(bench.nominal, bench.layout, rows, {});
    const BallbarFit fit = model.fit(values_of(rows));
    CHECK(fit.rank == 12);
    const auto found = intersection_estimates(bench.nominal, fit, 0.0);
    const auto published = evaluate_as_published(bench.nominal, bench.layout, rows);
    REQUIRE(found.size() == 8);
    for (std::size_t i = 0; i < 8; ++i) {
        CHECK(found[i].name == errors[i].name);
        CHECK(std::abs(found[i].value - errors[i].value) < 1e-9);
        const double allowed = errors[i].name.angular() ? 2e-6 : 3e-4;
        CHECK(std::abs(published.intersection[i].value - errors[i].value) < allowed);
    }
}

TEST_CASE("names of ballbar passes") {
    CHECK(to_string(*parse_ballbar_test("radial_A_pos")) == "radial_A");
    CHECK(to_string(*parse_ballbar_test("AXIAL_C_NEG")) == "axial_C");
    CHECK(to_string(*parse_ballbar_test("xy_ccw_1000")) == "xy");
    CHECK_FALSE(parse_ballbar_test("xyz"));
    CHECK_FALSE(parse_ballbar_test("map"));
    CHECK_FALSE(parse_ballbar_test("radial_X"));
    const Bench bench;
    const auto rows = measure(bench.nominal, bench.truth, bench.layout, true, true);
    const auto passes = ballbar_passes(rows);
    REQUIRE(passes.size() == 14);
    CHECK(passes[0].travel == Approx(2 * pi).epsilon(0.01));
    CHECK(passes[7].travel == Approx(-2 * pi).epsilon(0.01));
    CHECK(passes[1].travel == Approx(rad_from_deg(220)).epsilon(0.01));
    CHECK(passes[3].travel == Approx(rad_from_deg(120)).epsilon(0.01));
}
