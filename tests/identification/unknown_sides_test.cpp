// Sides that no row tells, a model without anything free, and gaps that are large but meant.

#include "identification/unknown_sides.h"

#include <catch2/catch.hpp>

#include "base/alarm.h"
#include "identification/identify.h"
#include "tests/support/campaign.h"

namespace trunnion {
namespace {

/// Circles before which B and C came from sides that the table does not tell, then turns of both.
records::ReadingTable circles(const setup::Setup& truth, signed char side_of_c) {
    records::ReadingTable table = campaign::empty_table(truth);
    campaign::add_ballbar(table, truth);
    table.side_before[index_of(Axis::C)] = side_of_c;
    table.side_before[index_of(Axis::B)] = 1;
    records::ReadingTable read = campaign::measured(truth, table, 3);
    read.side_before = {};
    return read;
}

double value_of(const identification::Identification& result, const std::string& name) {
    for (const identification::FitParameter& p : result.parameters)
        if (p.name == name) return p.value;
    FAIL("no parameter " + name);
    return 0.0;
}

}  // namespace

TEST_CASE("a side that no row tells is found with the gap it belongs to", "[identification]") {
    const setup::Setup truth = campaign::with_effect(campaign::bc_setup(), "C.backlash=60urad");
    for (const int side : {-1, 1}) {
        const identification::Identification result = identification::identify(
            campaign::bc_setup(), circles(truth, static_cast<signed char>(side)), {"C.backlash"});
        CHECK(value_of(result, "gap_rad") == Approx(6e-5).margin(1e-6));
        REQUIRE(result.notes.size() == 1);  // B has no gap, nothing asks for its side
        CHECK_THAT(result.notes[0],
                   Catch::Contains(side > 0 ? "C came travelling +" : "C came travelling -"));
        CHECK(result.rms_after_um < 0.33);
    }
}

TEST_CASE("the side of a day is told with its day", "[identification]") {
    const setup::Setup truth = campaign::with_effect(campaign::bc_setup(), "C.backlash=60urad");
    records::ReadingTable read = circles(truth, -1);
    for (records::Reading& row : read.rows) row.session = "monday";
    const auto result = identification::identify(campaign::bc_setup(), read, {"C.backlash"});
    REQUIRE_FALSE(result.notes.empty());
    CHECK_THAT(result.notes[0], Catch::Contains("C of monday came travelling -"));
}

TEST_CASE("a side is found for an effect that is fitted beside the base", "[identification]") {
    const setup::Setup setup = campaign::bc_setup();
    const setup::Setup truth = campaign::with_effect(setup, "C.backlash=60urad");
    for (const int side : {-1, 1}) {
        const records::ReadingTable read = circles(truth, static_cast<signed char>(side));
        const effects::Catalogue catalogue =
            effects::make_catalogue(setup, effects::extent_of(setup, read));
        const effects::Effect& backlash = *effects::find_effect(catalogue, "C.backlash");
        for (const int start : {-1, 1}) {
            emulator::Replay replay(setup, read);
            std::vector<std::size_t> open;
            for (std::size_t k = 0; k < replay.unknown_sides().size(); ++k) {
                open.push_back(k);
                replay.assume_side(k, static_cast<signed char>(start));
            }
            const identification::BaseModel base =
                identification::fit_base(setup, read, replay, catalogue, {});
            const std::vector<identification::FoundSide> found =
                identification::choose_sides_beside(base, read, {{&backlash, backlash.zeros(), {}}},
                                                    open, replay);
            REQUIRE(found.size() == 1);  // B has no gap, nothing asks for its side
            INFO(side << " from " << start);
            CHECK(found[0].side == side);
            CHECK(found[0].told());
        }
    }
}

TEST_CASE("the noise counts as given only where it is given for every reading",
          "[identification]") {
    const setup::Setup setup = campaign::bc_setup();
    records::ReadingTable read = circles(setup, 1);
    setup::Setup silent = setup;
    silent.model.noise_um.clear();
    silent.model.noise_urad.clear();
    const auto given = [&] {
        return identification::row_noise(silent, read, emulator::Replay(silent, read)).given;
    };
    for (records::Reading& row : read.rows) row.sigma_mm = 1e-3;
    CHECK(given());
    read.rows.front().sigma_mm.reset();
    CHECK_FALSE(given());
    for (records::Reading& row : read.rows) row.sigma_mm.reset();
    CHECK_FALSE(given());
}

TEST_CASE("nothing free is a model too", "[identification]") {
    setup::Setup setup = campaign::bc_setup();
    setup.model.modelled.clear();
    for (setup::Artefact& artefact : setup.artefacts) artefact.free_center = false;
    setup.ballbar->free_cup = setup.ballbar->free_length = false;
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_sphere_map(table, setup, 6, 5);
    const records::ReadingTable read = campaign::measured(setup, table, 4);
    const identification::Identification result = identification::identify(setup, read, {});
    CHECK(result.parameters.empty());
    CHECK(result.dof == 18);
    CHECK(result.rms_after_um == result.rms_before_um);
    CHECK(result.rms_after_um == Approx(0.8).epsilon(0.4));
}

TEST_CASE("a large gap is refused as a slip of units unless it is meant", "[identification]") {
    setup::Setup setup = campaign::bc_setup();
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_sphere_map(table, setup, 20, 5);
    records::ReadingTable read = campaign::measured(setup, table, 4);
    *read.rows.back().value_mm += 5.6 * 1.5;
    CHECK_THROWS_AS(identification::identify(setup, read, {}), InputError);
    setup.model.allow_large = true;
    CHECK_FALSE(identification::identify(setup, read, {}).notes.empty());
    setup.model.allow_large = false;
    read.rows.back().sigma_mm = 1.0;
    const identification::Identification meant = identification::identify(setup, read, {});
    REQUIRE_FALSE(meant.notes.empty());
    CHECK_THAT(meant.notes[0], Catch::Contains("a residual of 8.") && Catch::Contains("accepted"));
}

TEST_CASE("play sideways depends on the side as a gap along the axis does", "[identification]") {
    const setup::Setup setup = campaign::bc_setup();
    const records::ReadingTable read = circles(setup, 1);
    const emulator::Replay replay(setup, read);
    REQUIRE_FALSE(replay.unknown_sides().empty());
    const auto sees = [&](const effects::EffectFunction& add) {
        effects::Effect effect;
        effect.add = add;
        return identification::sees_side(replay, 0, *identification::usual_model(effect, {}));
    };
    const std::size_t axis = index_of(replay.unknown_sides()[0].axis);
    CHECK(sees([axis](const AxisSample& sample, const emulator::Contact&, std::span<const double>,
                      kinematics::Perturbation& out) {
        out.motion[axis].shift_mm.x() = 1e-3 * sample.travel[axis];
    }));
    CHECK_FALSE(
        sees([axis](const AxisSample&, const emulator::Contact&, std::span<const double>,
                    kinematics::Perturbation& out) { out.motion[axis].shift_mm.x() = 1e-3; }));
}

}  // namespace trunnion
