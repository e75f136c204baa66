// An artefact that moved against a machine that jumped.
#include <algorithm>
#include <catch2/catch.hpp>

#include "diagnosis/diagnosis.h"
#include "tests/support/campaign.h"

namespace trunnion {
namespace {

/// Maps of the spheres, then circles of the ballbar; `turned`: turns of both rotary axes, too.
records::ReadingTable campaign_of(const setup::Setup& setup, bool turned) {
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_sphere_map(table, setup, 40, 3);
    campaign::add_ballbar(table, setup, 36);
    if (!turned)
        std::erase_if(table.rows, [](const records::Reading& row) {
            return row.test.find("_bar_") != std::string::npos;
        });
    return table;
}

/// Readings of one machine before the first row of a test, of another from there on.
records::ReadingTable changed_at(const std::string& test, const records::ReadingTable& table,
                                 const setup::Setup& before, const setup::Setup& after) {
    records::ReadingTable list = campaign::measured(before, table, 5);
    const records::ReadingTable later = campaign::measured(after, table, 5);
    bool changed = false;
    for (std::size_t i = 0; i < list.rows.size(); ++i) {
        changed = changed || list.rows[i].test == test;
        if (changed) list.rows[i].value_mm = later.rows[i].value_mm;
    }
    return list;
}

const diagnosis::Cause& first_of(const diagnosis::Diagnosis& d) {
    REQUIRE(!d.causes.empty());
    return d.causes.front();
}

bool has_jump_as_rival(const diagnosis::Cause& cause) {
    return std::find(cause.rivals.begin(), cause.rivals.end(), "machine.jump") !=
           cause.rivals.end();
}

}  // namespace

TEST_CASE("a jump of the machine that one artefact sees is a rival of that artefact's move",
          "[diagnosis][jump]") {
    const setup::Setup setup = campaign::bc_setup();
    const setup::Setup before = campaign::real_machine(setup);
    setup::Setup after = before;
    after.ballbar->cup_S_mm += Vector3(0.0, -0.003, 0.0);
    const diagnosis::Diagnosis d = diagnosis::diagnose(
        setup, changed_at("plane1_cw_1000", campaign_of(setup, false), before, after));
    const diagnosis::Cause& first = first_of(d);
    CHECK(first.effect == "artefact.moved");
    CHECK(has_jump_as_rival(first));
    CHECK(first.probability.value() < 0.7);
    CHECK(d.verdict == diagnosis::Verdict::ambiguous);
}

TEST_CASE("an artefact that moved between turns of the table has no jump as a rival",
          "[diagnosis][jump]") {
    const setup::Setup setup = campaign::bc_setup();
    const setup::Setup before = campaign::real_machine(setup);
    setup::Setup after = before;
    after.artefacts[2].center_W_mm += Vector3(0.004, -0.006, 0.0);
    const diagnosis::Diagnosis d = diagnosis::diagnose(
        setup, changed_at("C_bar_y_up", campaign_of(setup, true), before, after));
    const diagnosis::Cause& first = first_of(d);
    CHECK(first.effect == "artefact.moved");
    CHECK(!has_jump_as_rival(first));
    CHECK(first.probability.value() > 0.9);
}

TEST_CASE("a jump that all artefacts see is no sure drift, and a drift is no jump",
          "[diagnosis][jump]") {
    const setup::Setup setup = campaign::bc_setup();
    const setup::Setup before = campaign::real_machine(setup);
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_sphere_map(table, setup, 50, 5);
    setup::Setup after = before;
    after.probe->tip_S_mm += Vector3(0.006, -0.004, 0.003);
    for (const double part : {0.5, 0.37, 0.81}) {  // of the test: any time, not one of a grid
        records::ReadingTable jumping = table;
        const auto first = static_cast<std::size_t>(part * static_cast<double>(table.rows.size()));
        for (std::size_t i = first; i < jumping.rows.size(); ++i) jumping.rows[i].test = "second";
        const diagnosis::Diagnosis jump =
            diagnosis::diagnose(setup, changed_at("second", jumping, before, after));
        INFO(part);
        const diagnosis::Cause& taken_for_it = first_of(jump);
        CHECK(jump.verdict != diagnosis::Verdict::explained);
        if (!taken_for_it.known) continue;  // of a size that no drift has
        CHECK(taken_for_it.effect == "thermal.drift");
        CHECK(has_jump_as_rival(taken_for_it));
        CHECK(taken_for_it.probability.value() < 0.5);
    }

    const setup::Setup warming =
        campaign::with_effect(before, "thermal.drift: d_mm=[0.01, 0, 0.02], tau_s=300");
    const diagnosis::Diagnosis drift =
        diagnosis::diagnose(setup, campaign::measured(warming, table, 5));
    const diagnosis::Cause& first = first_of(drift);
    CHECK(first.effect == "thermal.drift");
    CHECK(!has_jump_as_rival(first));
    CHECK(first.probability.value() > 0.9);
}

}  // namespace trunnion
