// Sentence above the causes of a control's gap.
#include <catch2/catch.hpp>

#include "report/control_gap_report.h"

namespace trunnion {

TEST_CASE("what no cause explains is not told as a cause", "[report]") {
    choices::ControlGap gap;
    gap.verdict = choices::GapVerdict::partly_explained;
    gap.explained = 0.99;
    gap.causes.resize(2);
    gap.causes[0].name = "G54";
    gap.causes[0].probability = 0.9;
    gap.causes[1].name = "unknown";
    gap.causes[1].known = false;
    const std::string partly = report::verdict_sentence(gap);
    CHECK_THAT(partly, Catch::Contains("G54 explains 99 % of it") &&
                           Catch::Contains("what stays is more than noise") &&
                           !Catch::Contains("unknown"));
    gap.causes.pop_back();
    gap.verdict = choices::GapVerdict::explained;
    CHECK_THAT(report::verdict_sentence(gap), !Catch::Contains("more than noise"));
    gap.verdict = choices::GapVerdict::ambiguous;
    gap.causes[0].probability = 0.33;
    gap.causes[0].rivals = {"H1", "external"};
    CHECK_THAT(report::verdict_sentence(gap),
               Catch::Contains("G54 (or a rival) explains 99 % of it"));
    gap.causes[0].rivals.clear();
    CHECK_THAT(report::verdict_sentence(gap),
               Catch::Contains("One of several choices or stores explains 99 % of it") &&
                   !Catch::Contains("G54"));
}

TEST_CASE("the declared number of a store has the digits of the found one", "[report]") {
    choices::FittedNumber number;
    number.name = "G54.X";
    number.unit = "mm";
    number.from = 10.05;
    number.to = 10.0;
    number.sigma = 0.000033;
    CHECK(report::number_words(number) == "G54.X from 10.05 to 10.000000 ± 0.000033 mm");
    number.from = 10.004;
    number.sigma = 0.0012;
    CHECK(report::number_words(number) == "G54.X from 10.004 to 10.0000 ± 0.0012 mm");
    number.from = 0.0;
    CHECK(report::number_words(number) == "G54.X from 0 to 10.0000 ± 0.0012 mm");
}

}  // namespace trunnion
