// Two solvers written apart, one set of readings: the ballbar's own fit and the general
// identification.
#include <catch2/catch.hpp>
#include <cmath>

#include "ballbar/test/ballbar_procedure.h"
#include "identification/identify.h"

using namespace trunnion;

TEST_CASE("the general identification finds what the ballbar fit finds") {
    std::vector<std::string> notes;
    setup::Setup setup =
        setup::load_setup(std::string(TRUNNION_SOURCE_DIR) + "/machines/ac_trunnion.toml", notes);
    setup.ballbar->sample_hz = 5.0;
    setup.ballbar->free_cup = false;
    const ballbar::test::BallbarResult result = ballbar::test::run_ballbar(setup, {});
    setup::Setup declared = setup;
    declared.machine.errors = {};
    const identification::Identification found =
        identification::identify(declared, result.before.readings, {"location"});
    CHECK(found.inseparable.empty());
    int compared = 0;
    for (const ballbar::test::BallbarErrorRow& row : result.errors)
        for (const identification::FitParameter& p : found.parameters) {
            if (p.name.rfind(to_string(row.name), 0) != 0) continue;
            ++compared;
            CAPTURE(p.name, p.value, row.before, row.sigma_before, p.sigma);
            CHECK(std::abs(p.value - row.before) < 0.05 * row.sigma_before);
            CHECK(p.sigma == Approx(row.sigma_before).epsilon(0.05));
        }
    CHECK(compared == 8);
}
