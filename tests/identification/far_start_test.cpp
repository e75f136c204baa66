// Fits that begin far from their solution, with steps that are shortened; known values; two
// ripples.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "identification/identify.h"
#include "tests/support/campaign.h"

namespace trunnion {
namespace {

/// Arcs of the ballbar in three planes about the pivot of the setup.
records::ReadingTable arcs(const setup::Setup& setup, double sweep_deg) {
    records::ReadingTable table = campaign::empty_table(setup);
    for (int plane = 0; plane < 3; ++plane)
        for (int k = 0; k <= 24; ++k) {
            records::Reading row;
            row.test = "plane" + std::to_string(plane);
            row.device = records::Device::ballbar;
            row.feature = "P1";
            row.feed_mm_min = 1000.0;
            row.time_s = 10.0 * k + 1000.0 * plane;
            const double angle_rad = rad_from_deg(sweep_deg) * k / 24.0;
            Vector3 bar_mm = Vector3::Zero();
            bar_mm(plane) = setup.ballbar->length_mm * std::cos(angle_rad);
            bar_mm((plane + 1) % 3) = setup.ballbar->length_mm * std::sin(angle_rad);
            campaign::aim(row, setup, setup.find_artefact("P1")->center_W_mm + bar_mm,
                          setup.ballbar->cup_S_mm);
            table.rows.push_back(row);
        }
    return table;
}

}  // namespace

TEST_CASE("short arcs about a pivot that stands far from where the setup has it are fitted",
          "[identification]") {
    setup::Setup setup = campaign::bc_setup();
    setup.model.modelled = {};
    setup.model.allow_large = true;
    for (const double sweep_deg : {30.0, 90.0})
        for (const double off_mm : {55.0, 60.0, 65.0, 70.0}) {
            setup::Setup truth = setup;
            truth.artefacts[2].center_W_mm += off_mm * Vector3(1.0, -0.5, 0.4);
            const records::ReadingTable table = arcs(setup, sweep_deg);
            const identification::Identification fit =
                identification::identify(setup, campaign::measured(truth, table, 1), {});
            INFO(sweep_deg << " deg, " << off_mm << " mm: " << fit.rms_after_um << " um");
            CHECK(fit.rms_after_um < 0.35);  // the noise of the ballbar is 0.3 um
        }
}

TEST_CASE("a fit that ends before it is at its solution says so", "[identification]") {
    setup::Setup setup = campaign::bc_setup();
    setup.model.modelled = {};
    setup.model.allow_large = true;
    for (const double off_mm : {30.0, 200.0}) {
        setup::Setup truth = setup;
        truth.artefacts[2].center_W_mm += off_mm * Vector3(1.0, -0.5, 0.4);
        const identification::Identification fit =
            identification::identify(setup, campaign::measured(truth, arcs(setup, 30.0), 1), {});
        const bool told =
            std::any_of(fit.notes.begin(), fit.notes.end(), [](const std::string& note) {
                return note.find("has not settled") != std::string::npos;
            });
        INFO(off_mm << " mm: " << fit.rms_after_um << " um");
        CHECK(told == (fit.rms_after_um > 10.0));
        CHECK(told == (off_mm > 100.0));
    }
}

TEST_CASE("a calibrated value draws the fit from wherever it begins", "[identification]") {
    setup::Setup setup = campaign::bc_setup();
    const setup::Setup truth = campaign::real_machine(setup);
    const kinematics::ErrorName name = *kinematics::parse_error_name("EX0B");
    setup.model.calibration["EX0B"] = {-0.005, 1e-5};
    setup.machine.errors.location(name) = truth.machine.errors.location(name);
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_sphere_map(table, setup, 24, 3);
    const identification::Identification fit =
        identification::identify(setup, campaign::measured(truth, table, 1), {});
    int found = 0;
    for (const identification::FitParameter& p : fit.parameters) {
        if (p.name != "EX0B_mm") continue;
        ++found;
        CHECK(p.value == Approx(-0.005).margin(1e-4));
    }
    CHECK(found == 1);
}

TEST_CASE("the period of a small ripple is found beside a large one", "[identification]") {
    const setup::Setup setup = campaign::bc_setup();
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_ballbar(table, setup);
    for (const auto& [x_mm, y_mm] : {std::pair{10.0, 13.0}, {40.0, 23.0}}) {
        setup::Setup truth = campaign::with_effect(
            setup, "X.cyclic: cos_mm=0.02, period_mm=" + std::to_string(x_mm));
        truth = campaign::with_effect(truth,
                                      "Y.cyclic: cos_mm=0.001, period_mm=" + std::to_string(y_mm));
        const identification::Identification fit = identification::identify(
            setup, campaign::measured(truth, table, 1), {"location", "X.cyclic", "Y.cyclic"});
        for (const identification::FitParameter& p : fit.parameters)
            if (p.name == "period_mm")
                CHECK(p.value == Approx(p.effect == "X.cyclic" ? x_mm : y_mm).epsilon(2e-3));
        CHECK(fit.rms_after_um < 0.35);  // the noise of the ballbar is 0.3 um
    }
}

}  // namespace trunnion
