// Errors of any shape, zeros of tests, and one verdict from one number.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "diagnosis/diagnosis.h"
#include "diagnosis/groups/ripples.h"
#include "diagnosis/verdict/verdict.h"
#include "tests/support/campaign.h"

namespace trunnion {
namespace {

/// A smooth error of X that no textbook form has, 6 um.
setup::Setup with_form(setup::Setup truth) {
    kinematics::ErrorCurve& curve = truth.machine.errors.axis[index_of(Axis::X)].motion[0];
    for (double q = -400.0; q <= 400.0; q += 10.0) {
        curve.at.push_back(q);
        curve.value.push_back(0.006 * std::sin(q / 35.0) * std::exp(-std::pow(q / 150.0, 2)));
    }
    return truth;
}

records::ReadingTable campaign_of(const setup::Setup& setup) {
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_sphere_map(table, setup, 60, 5);
    campaign::add_ballbar(table, setup, 48);
    return table;
}

void check_one_verdict(const diagnosis::Diagnosis& d) {
    if (d.verdict == diagnosis::Verdict::no_gap) return;
    CHECK((d.verdict == diagnosis::Verdict::unexplained) == (d.explained < 0.5));
    CHECK((d.verdict == diagnosis::Verdict::partly_explained) ==
          (d.explained >= 0.5 && d.explained < 0.8));
    for (const diagnosis::Cause& c : d.causes)
        if (c.effect != "unknown") CHECK(c.probability <= d.explained + 1e-12);
}

}  // namespace

TEST_CASE("a ripple needs places", "[diagnosis]") {
    CHECK_FALSE(diagnosis::shows_period({0, 100, 200, 300, 400}, 10.0));  // five places
    std::vector<double> even, odd;
    for (int k = 0; k < 21; ++k) {
        even.push_back(20.0 * k);
        odd.push_back(20.0 * k + (k % 3) * 2.9);
    }
    CHECK_FALSE(diagnosis::shows_period(even, 10.0));  // the same phase everywhere
    CHECK_FALSE(diagnosis::shows_period(even, 30.0));  // less than two spacings
    CHECK(diagnosis::shows_period(even, 70.0));
    CHECK_FALSE(diagnosis::shows_period(even, 250.0));  // not two periods in the range
    CHECK(diagnosis::shows_period(odd, 11.0));
    CHECK_FALSE(diagnosis::shows_period({}, 10.0));
}

TEST_CASE("an error of any shape is a cause of its own, with its curve", "[diagnosis]") {
    const setup::Setup setup = campaign::bc_setup(),
                       truth = with_form(campaign::real_machine(setup));
    const records::ReadingTable table = campaign_of(setup);
    const diagnosis::Diagnosis d = diagnosis::diagnose(setup, campaign::measured(truth, table, 3));
    check_one_verdict(d);
    CHECK(d.explained > 0.8);
    const auto form = std::find_if(d.causes.begin(), d.causes.end(),
                                   [](const diagnosis::Cause& c) { return !c.points.empty(); });
    REQUIRE(form != d.causes.end());
    CHECK(form->effect == "X.positioning");
    CHECK(form->share > 0.5);
    // What it predicts at places that were not measured.
    records::ReadingTable fresh = campaign::empty_table(setup);
    campaign::add_sphere_map(fresh, setup, 40, 77);
    const records::ReadingTable real =
        emulator::predicted(truth, fresh, effects::active_models(truth));
    const records::ReadingTable with =
        emulator::predicted(d.setup, fresh, effects::active_models(d.setup));
    double left = 0.0, rows = 0.0;
    for (std::size_t i = 0; i < fresh.rows.size(); ++i) {
        if (!real.rows[i].value_mm) continue;
        left += std::pow(*real.rows[i].value_mm - *with.rows[i].value_mm, 2);
        rows += 1.0;
    }
    CHECK(1e3 * std::sqrt(left / rows) < 1.2);
}

TEST_CASE("free forms of one axis of which none is most of it have no textbook name",
          "[diagnosis]") {
    const setup::Setup setup = campaign::bc_setup();
    setup::Setup truth = campaign::real_machine(setup);
    for (const int d : {0, 1}) {  // along X and across it
        kinematics::ErrorCurve& curve =
            truth.machine.errors.axis[index_of(Axis::X)].motion[static_cast<std::size_t>(d)];
        for (double q = -400.0; q <= 400.0; q += 10.0) {
            curve.at.push_back(q);
            curve.value.push_back((d == 0 ? 0.006 : 0.0045) * std::sin(q / 30.0 + d) *
                                  std::exp(-std::pow(q / 150.0, 2)));
        }
    }
    const diagnosis::Diagnosis d =
        diagnosis::diagnose(setup, campaign::measured(truth, campaign_of(setup), 5));
    std::size_t forms = 0;
    for (const diagnosis::Cause& cause : d.causes) {
        INFO(cause.effect << " " << cause.share);
        CHECK(cause.effect == "free form of X");
        forms += cause.points.empty() ? 0 : 1;
    }
    CHECK(forms == 2);
}

TEST_CASE("a named effect stands beside an error of any shape", "[diagnosis]") {
    const setup::Setup setup = campaign::bc_setup();
    const setup::Setup truth =
        campaign::with_effect(with_form(campaign::real_machine(setup)), "X.backlash: gap_mm=0.004");
    const diagnosis::Diagnosis d =
        diagnosis::diagnose(setup, campaign::measured(truth, campaign_of(setup), 4));
    check_one_verdict(d);
    const auto gap = std::find_if(d.causes.begin(), d.causes.end(), [](const diagnosis::Cause& c) {
        return c.effect == "X.backlash";
    });
    REQUIRE(gap != d.causes.end());
    CHECK(gap->parameters.front().value == Approx(0.004).epsilon(0.1));
}

TEST_CASE("a scatter of zeroing is noise, not a cause", "[diagnosis]") {
    const setup::Setup setup = campaign::bc_setup();
    const setup::Setup truth =
        campaign::with_effect(campaign::real_machine(setup), "C.backlash: gap_rad=8e-5");
    records::ReadingTable table = campaign_of(setup);
    for (const bool effect : {false, true}) {
        records::ReadingTable readings =
            campaign::measured(effect ? truth : campaign::real_machine(setup), table, 6);
        std::map<std::string, double> zero;
        SeededNoise random(9);
        for (records::Reading& row : readings.rows)
            if (row.device == records::Device::ballbar)
                *row.value_mm +=
                    zero.try_emplace(row.test, 0.25e-3 * random.normal()).first->second;
        const diagnosis::Diagnosis d = diagnosis::diagnose(setup, readings);
        INFO("effect " << effect);
        check_one_verdict(d);
        if (!effect) CHECK(d.verdict == diagnosis::Verdict::no_gap);
        if (effect) {
            REQUIRE(!d.causes.empty());
            CHECK(d.causes.front().effect == "C.backlash");
            CHECK(d.explained > 0.9);
        }
    }
}

TEST_CASE("the probability of a cause knows how many blocks saw it", "[diagnosis]") {
    diagnosis::BlockLoss without{{4, 4, 4, 4, 4, 4}, {1, 1, 1, 1, 1, 1}}, with = without;
    for (double& s : with.square) s = 1.0;
    with.square[2] = 1.5;
    const diagnosis::Saving saving = diagnosis::saving_of(without, with);
    CHECK(saving.blocks == 6.0);
    CHECK(saving.t > 10.0);
    CHECK(diagnosis::saving_of(without, without).blocks == 0.0);
}

}  // namespace trunnion
