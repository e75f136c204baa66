// A course of time that is no drift of the catalogue: poses follow each other in time, and what
// they have of it must not become errors of the axes.
#include <catch2/catch.hpp>
#include <cmath>

#include "diagnosis/diagnosis.h"
#include "tests/support/campaign.h"
#include "tests/support/said.h"

namespace trunnion {
namespace {

/// A fast warming that a slow cooling takes back and overshoots, of the tool, mm.
Vector3 course_mm(double time_s, double height_mm) {
    const double fast = 1.0 - std::exp(-time_s / 200.0);
    const double slow = 1.0 - std::exp(-std::pow(time_s / 800.0, 2.0));
    return height_mm * (fast - 1.25 * slow) * Vector3(0.3, 1.0, 0.7);
}

records::ReadingTable warmed(const setup::Setup& setup, double height_mm, std::uint64_t seed) {
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_sphere_map(table, setup, 80, seed);
    table = campaign::measured(campaign::real_machine(setup), table, seed);
    for (records::Reading& row : table.rows)
        if (row.device == records::Device::sphere)
            *row.value_mm += course_mm(row.time_s, height_mm).dot(row.direction_M);
    return table;
}

}  // namespace

TEST_CASE("a course of time is no error of the axes", "[diagnosis]") {
    const setup::Setup setup = campaign::bc_setup();
    for (const double height_mm : {0.02, 0.06, 0.2})
        for (const std::uint64_t seed : {1, 2, 3, 4}) {
            const diagnosis::Diagnosis d =
                diagnosis::diagnose(setup, warmed(setup, height_mm, seed));
            INFO(height_mm << " mm, seed " << seed << ": " << said(d));
            CHECK(d.verdict != diagnosis::Verdict::no_gap);
            for (const diagnosis::Cause& cause : d.causes)
                if (cause.effect != "unknown" && cause.effect != "thermal.drift")
                    CHECK(cause.probability.value() < 0.5);
        }
}

}  // namespace trunnion
