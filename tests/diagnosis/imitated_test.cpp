// A cause that one effect of another axis imitates together with a second one: neither of the two
// may be certain, and the cause is named.
#include <catch2/catch.hpp>

#include "tests/support/campaign.h"
#include "tests/support/diagnosed.h"
#include "tests/support/measured_machines.h"
#include "tests/support/said.h"

namespace trunnion {
namespace {

/// Readings of the sphere at 63 indexations of the BC table machine.
records::ReadingTable pivot_readings(const setup::Setup& truth, std::uint64_t seed) {
    const measured::Shipped& bc = measured::shipped_machines().front();
    const std::vector<measured::Program> programs = measured::programs_of(bc, truth);
    return measured::run_of(truth, programs[1], seed);  // O8002
}

setup::Setup bc_machine() {
    return measured::setup_of(measured::setup_text(measured::shipped_machines().front()));
}

}  // namespace

TEST_CASE("once per turn of a radial motion is no scale with a backlash", "[diagnosis]") {
    // The sphere turns with C: seen at one radius, the first order is a scale of Y within 0.4 um,
    // and what is left looks like a backlash of 1.6 um.
    const setup::Setup setup = bc_machine(),
                       truth = campaign::with_effect(
                           setup, "C.radial: EXC_cos1_mm=0.004, EYC_sin1_mm=0.004");
    for (const std::uint64_t seed : {11, 12, 14}) {
        const diagnosis::Diagnosis d = diagnosed(setup, pivot_readings(truth, seed));
        INFO(seed << ": " << said(d));
        REQUIRE_FALSE(d.causes.empty());
        CHECK(d.causes.front().effect == "C.radial");
        CHECK_FALSE(claims(d, "Y.backlash"));
        for (const diagnosis::Cause& cause : d.causes)
            if (cause.effect != "C.radial") CHECK(cause.probability < 0.5);
    }
}

}  // namespace trunnion
