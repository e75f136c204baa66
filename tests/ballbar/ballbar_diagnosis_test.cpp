// Each line of the circular diagnosis: the error goes in as `run --inject` takes it, the NC program
// runs, the line comes out first.
#include <cmath>

#include "ballbar_runs.h"
#include "effects/settings.h"

using namespace trunnion;
using namespace trunnion::ballbar_test;

namespace {

struct Injected {
    std::string effect;
    ballbar::test::BallbarTestKind plane;
    std::string line;
    double value;
    double allowed;  ///< beside four sigma: of what the model of the line leaves out
};

constexpr auto xy = ballbar::test::BallbarTestKind::xy, yz = ballbar::test::BallbarTestKind::yz,
               zx = ballbar::test::BallbarTestKind::zx;

/// Circle of R 100 about (75, 0, 230): a bow p2 (q/200)^2 about q = 75 needs the slope -0.75 p2.
const std::vector<Injected> injected = {
    {"X.backlash: gap_mm=0.008", xy, "backlash X", 8.0, 0.1},
    {"Y.backlash: gap_mm=0.005", xy, "backlash Y", 5.0, 0.1},
    {"Z.backlash: gap_mm=-0.006", yz, "backlash Z", -6.0, 0.1},
    {"X.reversal_spike: height_mm=0.010, decay_mm=2", xy, "reversal spike X", 10.0, 0.5},
    {"Y.reversal_spike: height_mm=0.008, decay_mm=3", xy, "reversal spike Y", 8.0, 0.5},
    {"X.lateral_play: play_y_mm=0.006", xy, "lateral play X", 6.0, 0.1},
    {"Y.lateral_play: play_x_mm=0.006", xy, "lateral play Y", 6.0, 0.1},
    {"XY.squareness: angle_rad=40e-6", xy, "squareness XY", 40.0, 0.3},
    {"YZ.squareness: angle_rad=50e-6", yz, "squareness YZ", 50.0, 0.5},
    {"ZX.squareness: angle_rad=-50e-6", zx, "squareness ZX", 50.0, 0.5},
    {"X.straightness: EYX_p1_mm=-0.015, EYX_p2_mm=0.020", xy, "straightness X", 5.0, 0.1},
    {"Y.straightness: EXY_p2_mm=0.020", xy, "straightness Y", 5.0, 0.1},
    {"X.scale: scale_ppm=40", xy, "scale mismatch X-Y", 40.0, 0.3},
    {"Y.scale: scale_ppm=40", xy, "scale mismatch X-Y", -40.0, 0.3},
    {"servo.mismatch: tau_x_s=0.3e-3", xy, "servo mismatch X-Y", 0.3, 0.003},
    {"servo.mismatch: tau_y_s=0.3e-3", xy, "servo mismatch X-Y", -0.3, 0.003},
    {"X.cyclic: cos_mm=0.002, period_mm=10", xy, "cyclic error X", 2.0, 0.1},
    {"Y.cyclic: sin_mm=0.003, period_mm=12", xy, "cyclic error Y", 3.0, 0.1}};

ballbar::test::PlanarResult circle_with(const std::string& effect,
                                        ballbar::test::BallbarTestKind plane, double noise_um) {
    setup::Setup setup = load("ac_trunnion.toml");
    setup.machine.errors = {};
    setup.ballbar->noise_um = noise_um;
    setup.ballbar->sample_hz = 40.0;
    if (!effect.empty())
        setup.effects.push_back(effects::parse_injection(effect, effects::make_catalogue(setup)));
    ballbar::test::BallbarProcedureOptions options;
    options.effects = effects::active_models(setup);
    for (const ballbar::test::PlanarResult& planar :
         ballbar::test::run_ballbar(setup, options).planar)
        if (planar.test.plane == plane) return planar;
    FAIL("no such circle");
    return {};
}

}  // namespace

TEST_CASE("each line of the diagnosis ranks first with its value when its error is there") {
    for (const Injected& in : injected) {
        const ballbar::test::PlanarResult planar = circle_with(in.effect, in.plane, 0.3);
        REQUIRE_FALSE(planar.diagnosis.causes.empty());
        const ballbar::test::CircularCause& first = planar.diagnosis.causes.front();
        CAPTURE(in.effect, first.name, first.value, first.sigma, first.share);
        CHECK(first.name == in.line);
        CHECK(first.rank == 1);
        CHECK(first.significant);
        CHECK(std::abs(first.value - in.value) < 4.0 * first.sigma + in.allowed);
        CHECK(first.sigma < 0.1 * std::abs(in.value));
        CHECK(first.share > 0.5);
        // The trace of the line is the circularity that is there, noise aside.
        CHECK(first.share_um < planar.figures.bidirectional_circularity_um + 0.2);
    }
}

TEST_CASE("without an error no line of any circle is significant") {
    for (const auto plane : {xy, yz, zx}) {
        const ballbar::test::PlanarResult planar = circle_with("", plane, 0.3);
        for (const ballbar::test::CircularCause& c : planar.diagnosis.causes) {
            CAPTURE(c.name, c.value, c.sigma);
            CHECK(std::abs(c.value) < 4.2 * c.sigma);
        }
    }
}

TEST_CASE("an eccentric set-up leaves nothing on a noise-free circle") {
    setup::Setup setup = load("ac_trunnion.toml");  // the errors move the pivot by 0.17 mm at home
    setup.ballbar->noise_um = 0.0;
    for (const double hz : {50.0, 300.0}) {
        setup.ballbar->sample_hz = hz;
        for (const ballbar::test::PlanarResult& planar :
             ballbar::test::run_ballbar(setup, {}).planar) {
            CAPTURE(hz, ballbar::test::plane_name(planar.test.plane));
            CHECK(planar.figures.hysteresis_um < 1e-3);
            for (const ballbar::test::CircularCause& c : planar.diagnosis.causes)
                CHECK(c.share_um < 0.01);
        }
    }
}
