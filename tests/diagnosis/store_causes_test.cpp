// Stores in force beside the machine's gap: shares, rivals and words, on made-up parts.
#include "diagnosis/store_causes.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/support/campaign.h"

namespace trunnion {
namespace {

using diagnosis::Verdict;
using effects::EffectKind;

/// G54 X is 0.05 mm off, which moves each of four readings by 10 um; `left_um` of that stays.
diagnosis::StoreGap gap_of_g54(double left_um = 0.0) {
    diagnosis::StoreGap gap;
    gap.places = 18.0;
    gap.changes.push_back({EffectKind::pivot_g54, {"G54 X", 0, 0, 0, 12.0}, 0.05, 1e-4, 100.0});
    gap.before_um = {10.0, -10.0, 10.0, -10.0};
    gap.after_um = {left_um, -left_um, left_um, -left_um};
    return gap;
}

/// A machine without a gap of its own.
diagnosis::Diagnosis quiet() {
    diagnosis::Diagnosis d;
    d.rms_um = d.noise_um = 1.0;
    d.before_um = d.after_um = {1.0, 1.0, -1.0, -1.0};
    d.setup = campaign::bc_setup();
    return d;
}

diagnosis::Diagnosis with(const diagnosis::StoreGap& gap, diagnosis::Diagnosis d) {
    add_store_gap(campaign::bc_setup(), gap, nullptr, d);
    return d;
}

}  // namespace

TEST_CASE("a store in force is explained, or has rivals that do the same", "[diagnosis][stores]") {
    diagnosis::StoreGap gap = gap_of_g54();
    diagnosis::Diagnosis d = with(gap, quiet());
    CHECK(d.verdict == Verdict::explained);
    REQUIRE(d.causes.size() == 1);
    CHECK(d.causes.front().effect == "pivot.g54");
    CHECK(d.causes.front().share == Approx(1.0));
    CHECK(d.causes.front().probability == Approx(19.0 / 20.0));
    CHECK(d.causes.front().rivals.empty());
    CHECK(d.rms_um == Approx(std::sqrt(101.0)));
    CHECK(d.before_um[1] == Approx(-9.0));
    CHECK(d.after_um[1] == Approx(1.0));
    CHECK(d.setup.stores.work.standard[0].value[0] ==
          Approx(campaign::bc_setup().stores.work.standard[0].value[0] + 0.05));
    gap.rivals = {EffectKind::pivot_p1970x};
    d = with(gap, quiet());
    CHECK(d.verdict == Verdict::ambiguous);
    CHECK(d.causes.front().probability == Approx(0.5));
    CHECK(d.causes.front().rivals == std::vector<std::string>{"pivot.p1970x"});
}

TEST_CASE("a store beside a machine's gap has its share of both", "[diagnosis][stores]") {
    diagnosis::Diagnosis machine = quiet();
    machine.rms_um = std::sqrt(1.0 + 100.0);  // as large as the store's
    machine.explained = 1.0;
    machine.after = {machine.rms_um, 1.0, 1.0, 1.0, 0.9, 1.0};
    diagnosis::Cause backlash;
    backlash.effect = "C.backlash";
    backlash.share = 1.0;
    machine.causes = {backlash};
    for (const Verdict verdict : {Verdict::explained, Verdict::ambiguous}) {
        machine.verdict = verdict;
        const diagnosis::Diagnosis d = with(gap_of_g54(), machine);
        CHECK(d.verdict == verdict);
        REQUIRE(d.causes.size() == 2);
        for (const diagnosis::Cause& cause : d.causes) CHECK(cause.share == Approx(0.5));
        CHECK(d.explained == Approx(1.0));
        CHECK(d.after.shrink == Approx(1.0));
    }
    machine.verdict = Verdict::unexplained;  // half of the whole remains
    machine.explained = 0.0;
    CHECK(with(gap_of_g54(), machine).explained == Approx(0.5));
}

TEST_CASE("what no store explains is unknown, and the words say which is meant",
          "[diagnosis][stores]") {
    const diagnosis::Diagnosis d = with(gap_of_g54(6.0), quiet());  // 0.36 of the squares stay
    CHECK(d.verdict == Verdict::partly_explained);
    CHECK(d.explained == Approx(0.64));
    REQUIRE(d.causes.size() == 2);
    CHECK(d.causes.back().effect == "unknown");
    CHECK(d.causes.back().share == Approx(0.36));
    CHECK(with(gap_of_g54(8.0), quiet()).verdict == Verdict::unexplained);
    diagnosis::StoreGap gap = gap_of_g54();
    gap.changes.push_back({EffectKind::tool_length, {"H1", 0, 1, -1, 150.0}, -0.02, 1e-4, 1.0});
    CHECK(words_of(gap) ==
          "G54 X is 12.0500 in force, 12.0000 in the setup; "
          "H1 is 149.9800 in force, 150.0000 in the setup");
    const auto cause = with(gap, quiet()).causes.front();
    CHECK_THAT(cause.what, Catch::Contains("G54 X") && !Catch::Contains("H1"));
    gap.changes.clear();
    CHECK(words_of(gap) == "no store explains the positions of these points");
    CHECK(diagnosis::mean_square_of({}) == 0.0);
}

}  // namespace trunnion
