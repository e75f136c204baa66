// A setup that is written without causes is the refit of its set-up, whatever was found meanwhile.
#include <catch2/catch.hpp>
#include <cmath>

#include "diagnosis/diagnosis_report.h"
#include "diagnosis/round.h"
#include "diagnosis/verdict/contenders.h"
#include "diagnosis/verdict/verdict.h"
#include "diagnosis/written_setup.h"
#include "tests/support/campaign.h"

namespace trunnion {
namespace {

/// What is written of readings without a gap, after a model bent the residual of the base by
/// `bend_mm` sin(k) in the k-th reading.
setup::Setup written_after(const setup::Setup& setup, const records::ReadingTable& readings,
                           double bend_mm) {
    using namespace diagnosis;
    Prepared p = prepare(setup, readings);
    Round round{std::vector<bool>(p.replay.size(), true), {}, p.base.sigma_mm, false};
    round.noise = belief_of(p, p.base.residual_mm, round);
    KeySearch keys(p.replay, p.base);
    Searched s = search_of(p, round, keys, nullptr, {});
    const Challenged found = unchallenged(std::move(s.model));
    FoldColumns rows(s.design, {p.folds, round.used});
    const Judgement judgement = judged(rows, p, found.model, round.noise);
    REQUIRE_FALSE(judgement.gap);
    for (Eigen::Index k = 0; k < p.base.residual_mm.size(); ++k)
        p.base.residual_mm(k) += bend_mm * std::sin(static_cast<double>(k));
    return written_setup({p, s.design, s.setting, found.model, judgement, round.noise, round.used,
                          round.used, found})
        .setup;
}

double apart_mm(const setup::Setup& a, const setup::Setup& b, const char* error) {
    const auto name = *kinematics::parse_error_name(error);
    return std::abs(a.machine.errors.location(name) - b.machine.errors.location(name));
}

}  // namespace

TEST_CASE("a model that is not written bends nothing in the setup without causes", "[diagnosis]") {
    setup::Setup setup = campaign::bc_setup();
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_sphere_map(table, setup, 20, 5);
    campaign::add_ballbar(table, setup, 24);
    const records::ReadingTable readings =
        campaign::measured(campaign::real_machine(setup), table, 4);
    const setup::Setup plain = written_after(setup, readings, 0.0);
    CHECK(apart_mm(plain, written_after(setup, readings, 0.02), "EX0B") < 1e-9);
    // What is known beforehand stays known: the true value is 12 um.
    setup.model.calibration["EX0B"] = {0.0115, 1e-6};
    const setup::Setup calibrated = written_after(setup, readings, 0.02);
    CHECK(calibrated.machine.errors.location(*kinematics::parse_error_name("EX0B")) ==
          Approx(0.0115).margin(1e-5));
}

}  // namespace trunnion
