// What changed between sessions, as sentence, lines and JSON.
#include "report/session_changes.h"

#include <catch2/catch.hpp>
#include <limits>
#include <nlohmann/json.hpp>

#include "report/diagnosis_json.h"

namespace trunnion {
namespace {

/// Two sessions with one change, part of a cause of this probability (0: of none).
diagnosis::Diagnosis changed(double probability, double sigma_mm = 2e-4) {
    diagnosis::Diagnosis d;
    d.verdict = diagnosis::Verdict::ambiguous;
    d.sessions = {{"monday", 40, 5.0, 1.0}, {"friday", 40, 9.0, 1.0}};
    diagnosis::SessionChange change;
    change.parameter.effect = "X.backlash";
    change.parameter.name = "gap_mm";
    change.parameter.unit = "mm";
    change.parameter.value = 0.012;
    change.parameter.sigma = sigma_mm;
    change.since = "friday";
    change.probability = probability;
    change.claimed = probability >= 0.5;
    d.changes.push_back(change);
    diagnosis::Cause cause;
    cause.effect = "X.backlash";
    cause.since = probability > 0.0 ? "friday" : "";
    cause.probability = probability;
    d.causes.push_back(cause);
    return d;
}

}  // namespace

TEST_CASE("a change that is not seen has a sigma of null", "[report][over]") {
    for (const double sigma_mm :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        const diagnosis::Diagnosis d = changed(0.0, sigma_mm);
        const auto json = nlohmann::json::parse(report::diagnosis_json(d, {}));
        CHECK(json["over"]["changes"][0]["sigma"].is_null());
        CHECK(json["over"]["changes"][0]["change"] == 0.012);
        CHECK_THAT(report::changes_text(d), Catch::Contains("not seen"));
    }
}

TEST_CASE("the machine changed where a change is claimed, and only there", "[report][over]") {
    const std::string sure = report::changes_text(changed(0.97));
    CHECK_THAT(sure, Catch::Contains("the machine changed: X.backlash since friday") &&
                         Catch::Contains("\n* X.backlash gap"));
    const std::string unsure = report::changes_text(changed(0.13));
    CHECK_THAT(unsure, !Catch::Contains("the machine changed"));
    CHECK_THAT(unsure, Catch::Contains("is certain: perhaps it is") &&
                           Catch::Contains("probability 0.13") &&
                           Catch::Contains("\n? X.backlash gap"));
    CHECK_THAT(report::changes_section(changed(0.13)), Catch::Contains("<td>perhaps</td>"));
    const std::string none = report::changes_text(changed(0.0));
    CHECK_THAT(none, Catch::Contains("No change of the machine between the sessions is found.") &&
                         Catch::Contains("\n  X.backlash gap"));
}

}  // namespace trunnion
