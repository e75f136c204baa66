// A diagnosis on a terminal: units of the shop, digits that the sigma supports, short lines.
#include "report/diagnosis_text.h"

#include <catch2/catch.hpp>
#include <limits>
#include <sstream>

#include "report/diagnosis_words.h"

namespace {

using namespace trunnion;

diagnosis::Diagnosis with_parameters(std::vector<identification::FitParameter> parameters) {
    diagnosis::Diagnosis d;
    d.verdict = diagnosis::Verdict::explained;
    diagnosis::Cause cause;
    cause.effect = "C.positioning";
    cause.what = "The axis turns a little more or less than commanded, the same every turn";
    cause.usual_cause = "eccentric encoder, wrong gear ratio, no or stale pitch compensation";
    cause.remedy = "load a compensation table from these values or from an autocollimator";
    cause.parameters = std::move(parameters);
    d.causes.push_back(std::move(cause));
    d.next.push_back({"a", "b",
                      "to tell C.positioning from C.radial: ballbar circles in XY and ZX, then "
                      "with each rotary axis turning, bar along X, Y and Z, out and back",
                      "", 0.0, 0.0, false});
    return d;
}

identification::FitParameter parameter(const std::string& name, double value_rad,
                                       double sigma_rad) {
    identification::FitParameter p;
    p.effect = "C.positioning";
    p.name = name;
    p.unit = "rad";
    p.value = value_rad;
    p.sigma = sigma_rad;
    return p;
}

}  // namespace

TEST_CASE("diagnose prints urad with two digits of sigma, and what is held at 0 in one line") {
    const double none = std::numeric_limits<double>::quiet_NaN();
    const std::string text = report::diagnosis_text(
        with_parameters({parameter("cos2_rad", 4.0639e-5, 3.98e-7),
                         parameter("cos3_rad", 0.0, none), parameter("sin3_rad", 0.0, none)}));
    CHECK_THAT(text, Catch::Contains("40.64 ± 0.40 µrad"));
    CHECK_THAT(text, Catch::Contains("held at 0: cos3, sin3\n"));
    CHECK_THAT(text, !Catch::Contains("e-05"));
}

TEST_CASE("no line of a diagnosis is longer than 90 places") {
    std::istringstream lines(report::diagnosis_text(with_parameters({})));
    for (std::string line; std::getline(lines, line);) {
        INFO(line);
        CHECK(line.size() <= 90);
    }
}

TEST_CASE("where only readings that were set aside are wrong, no text speaks of another gap") {
    diagnosis::Diagnosis d;
    d.verdict = diagnosis::Verdict::unexplained;
    d.readings = 48;
    d.outliers = 6;
    d.rms_um = 0.9;
    d.noise_um = 1.0;
    diagnosis::Cause unknown;
    unknown.effect = "unknown";
    unknown.known = false;
    d.causes.push_back(unknown);
    const std::string text = report::diagnosis_text(d);
    CHECK_THAT(text, Catch::Contains("6 of 48 readings fit nothing and were set aside"));
    CHECK_THAT(text, Catch::Contains("the others show no gap"));
    CHECK_THAT(text, !Catch::Contains("catalogue does not explain"));
    CHECK_THAT(text, !Catch::Contains("after:"));
    CHECK_THAT(report::answer(d), Catch::Contains("6 of 48 readings fit nothing"));
    d.excess_um = 5.0;
    CHECK_THAT(report::diagnosis_text(d), Catch::Contains("catalogue does not explain"));
}

TEST_CASE("where repeats differ more than is stated, no text promises that the rest is alike") {
    diagnosis::Diagnosis d;
    d.verdict = diagnosis::Verdict::unexplained;
    d.only_scatter = true;
    d.rms_um = 38.0;
    d.noise_um = 28.0;
    diagnosis::Cause cause;
    cause.effect = "unknown";
    cause.known = false;
    cause.what = "Repeated readings scatter 70 times as much as is stated of the device";
    d.causes.push_back(cause);
    const std::string text = report::diagnosis_text(d);
    CHECK_THAT(text, Catch::Contains("Repeated readings differ more than is stated; nothing"));
    CHECK_THAT(text, !Catch::Contains("after: rms"));
    CHECK_THAT(report::answer(d), Catch::Contains("28.0 µm rms. Nothing beyond that is certain."));
}

TEST_CASE("a cause that is no better alone has no shrink of its own") {
    diagnosis::Diagnosis d = with_parameters({});
    d.causes.front().heldout.shrink = -1.64;
    CHECK_THAT(report::diagnosis_text(d), Catch::Contains("no better by this alone"));
    d.causes.front().heldout.shrink = 0.5;
    CHECK_THAT(report::diagnosis_text(d), Catch::Contains("shrinks by 50 %"));
    d.causes.front().heldout.shrink = -0.1;
    d.causes.front().probability = 0.9;
    d.causes.push_back(d.causes.front());
    CHECK_THAT(report::diagnosis_text(d),
               Catch::Contains("no better by this alone, only together with others"));
    d.causes.back().known = false;
    CHECK_THAT(report::diagnosis_text(d), !Catch::Contains("only together with others"));
    d.where.push_back({"zero of a cycle", "reading", "", 0.8, 0.0});
    CHECK_THAT(report::diagnosis_text(d), Catch::Contains("only beside zeros that are free"));
}

TEST_CASE("an interval below -100 % says in words that the gap may grow") {
    diagnosis::Diagnosis d = with_parameters({});
    d.after.shrink = 0.2;
    d.after.low = -146.0;
    d.after.high = 0.44;
    CHECK_THAT(report::diagnosis_text(d),
               !Catch::Contains("14600") && Catch::Contains("at most 44; it may also"));
    CHECK_THAT(report::answer(d), Catch::Contains("20 % (at most 44 %; it may also grow to more"));
    d.after.low = -0.4;
    CHECK(report::interval_words(d.after) == "-40 to 44");
    d.after.low = d.after.high = -3.0;
    CHECK_THAT(report::interval_words(d.after), Catch::Contains("it rather grows"));
}

TEST_CASE("a setup without the causes is not said to shrink the gap by them") {
    diagnosis::Diagnosis d = with_parameters({});
    d.after.shrink = 0.12;
    d.writes_causes = false;
    CHECK_THAT(report::diagnosis_text(d), Catch::Contains("has none of them; with it") &&
                                              !Catch::Contains("the causes explain"));
    d.causes.front().probability = 0.9;
    CHECK_THAT(report::diagnosis_text(d), Catch::Contains("the causes explain"));
}

TEST_CASE("small errors beside the causes are told, and called none of them") {
    diagnosis::Diagnosis d = with_parameters({});
    CHECK_THAT(report::diagnosis_text(d), !Catch::Contains("small errors"));
    d.background = {"X.scale", "Y.straightness"};
    CHECK(report::background_words(d) ==
          "beside the causes the written setup has small errors, none of them certain, which "
          "together predict readings that were left out: X.scale, Y.straightness");
    CHECK_THAT(report::diagnosis_text(d), Catch::Contains("small errors, none of them certain"));
}

TEST_CASE("what one measurement tells apart stands in one entry") {
    diagnosis::Diagnosis d = with_parameters({});
    d.next.clear();
    const auto add = [&](const std::string& first, const std::string& second, const char* begin,
                         const char* end) {
        d.next.push_back(
            {first, second, begin + first + " from " + second + end, "", 0.0, 0.0, false});
    };
    add("B.tilt", "B.axial", "to tell ", ": touch a sphere");
    add("C.radial", "C.axial", "to tell ", ": find spheres");
    add("B.tilt", "C.axial", "to tell ", ": touch a sphere");
    add("X.scale", "X.angular", "to tell ", ": touch a sphere");
    add("A.tilt", "A.zero", "no ready measurement tells ", " at this size");
    add("A.tilt", "A.axial", "no ready measurement tells ", " at this size");
    const std::string text = report::diagnosis_text(d);
    CHECK_THAT(text, Catch::Contains("next: to tell B.tilt from B.axial, C.axial; X.scale from "
                                     "X.angular: touch a\n  sphere\n"));
    CHECK_THAT(text, Catch::Contains("next: to tell C.radial from C.axial: find spheres\n"));
    CHECK_THAT(text, Catch::Contains("tells A.tilt from A.zero, A.axial at this size\n"));
}

TEST_CASE("values that are none of them certain are said to be so") {
    diagnosis::Diagnosis d =
        with_parameters({parameter("cos1_rad", 4e-4, 1e-3), parameter("sin1_rad", -8e-4, 1.3e-3)});
    d.causes.front().probability = 0.94;
    const std::string words = "none of these values is certain by itself";
    CHECK_THAT(report::diagnosis_text(d), Catch::Contains(words));
    d.causes.front().parameters[0].sigma = 1e-4;
    CHECK_THAT(report::diagnosis_text(d), !Catch::Contains(words));
}

TEST_CASE("a claimed cause that the written setup lacks is told, where that has others") {
    diagnosis::Diagnosis d = with_parameters({});
    d.causes.front().probability = 0.9;
    const std::string words = "not in the written setup";
    CHECK_THAT(report::diagnosis_text(d), !Catch::Contains(words));
    d.causes.front().written = false;
    CHECK_THAT(report::diagnosis_text(d), Catch::Contains(words));
    d.causes.front().probability = 0.4;  // not claimed
    CHECK_THAT(report::diagnosis_text(d), !Catch::Contains(words));
    d.causes.front().probability = 0.9;
    d.writes_causes = false;  // told once, of all
    CHECK_THAT(report::diagnosis_text(d), !Catch::Contains(words));
}

TEST_CASE("a verdict says where it holds, and does not name for sure what is not") {
    diagnosis::Diagnosis d = with_parameters({});
    d.causes.front().probability = 0.9;
    d.causes.front().share = 0.14;
    CHECK_THAT(report::diagnosis_text(d), !Catch::Contains("most of it"));
    d.causes.front().share = 0.9;
    CHECK_THAT(report::diagnosis_text(d), Catch::Contains("is explained, most of it by"));
    d.causes.front().probability = 0.04;
    CHECK_THAT(report::diagnosis_text(d),
               Catch::Contains("by what is uncertain") && !Catch::Contains("most of it by"));
    d.between_places = false;
    CHECK_THAT(report::diagnosis_text(d), Catch::Contains("is explained at the measured places"));
}
