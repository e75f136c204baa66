// The page of a diagnosis: plain words first, shop units, rivals beside the claim, nothing broken.
#include "report/diagnosis_page.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "report/diagnosis_json.h"
#include "report/diagnosis_text.h"
#include "report/diagnosis_words.h"

namespace trunnion {
namespace {

diagnosis::Diagnosis one_cause() {
    diagnosis::Diagnosis d;
    d.verdict = diagnosis::Verdict::ambiguous;
    d.rms_um = 2.0;
    d.noise_um = 0.5;
    d.readings = 4;
    d.before_um = {2.0, -2.0, 2.0, -2.0};
    d.after_um = {0.5, -0.5, 0.4, -0.4};
    diagnosis::Cause cause;
    cause.effect = "C.backlash";
    cause.share = 0.93;
    cause.probability = 0.6;
    cause.rivals = {"C.zero & co"};
    cause.what = "The axis stops short";
    cause.usual_cause = "worn worm gear";
    cause.remedy = "readjust the preload";
    cause.parameters = {{"C.backlash", "gap_rad", "rad", -1, 4e-5, 8.123e-5, 9e-7},
                        {"C.backlash", "dp_mm", "mm", 1, 0.03, 0.0412, std::nan("")}};
    cause.heldout = {2.0, 0.55, 0.5, 0.9, 0.85, 0.95};
    d.causes = {cause};
    d.after = cause.heldout;
    return d;
}

std::size_t count(const std::string& text, const std::string& word) {
    std::size_t n = 0;
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
        ++n;
    return n;
}

}  // namespace

TEST_CASE("values stand in the units of the shop, digits as sure as sigma") {
    const diagnosis::Diagnosis d = one_cause();
    const report::ShopValue gap = report::shop_value(d.causes[0].parameters[0]);
    CHECK(gap.name == "gap");
    CHECK(gap.value == "81.23");
    CHECK(gap.sigma == "0.90");
    CHECK(gap.unit == "µrad");
    const report::ShopValue dp = report::shop_value(d.causes[0].parameters[1]);
    CHECK(dp.name == "dp y");
    CHECK(dp.value == "41.2");
    CHECK(dp.unit == "µm");
    CHECK(report::main_size(d.causes[0]) == "gap 81.23 ± 0.90 µrad");
}

TEST_CASE("a wave has the size of its amplitude") {
    diagnosis::Cause cause;
    cause.effect = "C.positioning";
    cause.parameters = {{cause.effect, "cos4_rad", "rad", -1, 1e-6, -30e-6, 2e-6},
                        {cause.effect, "sin4_rad", "rad", -1, 1e-6, 40e-6, 1e-6}};
    CHECK(report::main_size(cause) == "amplitude4 50.0 ± 2.0 µrad");
    cause.parameters[0].name = "cos3_rad";
    CHECK(report::main_size(cause) == "sin4 40.0 ± 1.0 µrad");
}

TEST_CASE("what no cause explains has its words on the page, no empty section") {
    diagnosis::Diagnosis d = one_cause();
    d.verdict = diagnosis::Verdict::unexplained;
    d.causes.front() = {};
    d.causes.front().effect = "unknown";
    d.causes.front().known = false;
    d.causes.front().what = "A gap with structure: it comes and goes with time (along <Az>)";
    const std::string html = report::diagnosis_page(d, "r.csv").body_html;
    CHECK_THAT(html, Catch::Contains("comes and goes with time (along &lt;Az&gt;)."));
    d.outliers = 2;
    d.excess_um = 0.0;
    const std::string spoiled = report::diagnosis_page(d, "r.csv").body_html;
    CHECK_THAT(spoiled, Catch::Contains("<h3>unknown</h3>"));
    CHECK_THAT(spoiled, !Catch::Contains("How far the gap shrinks"));
}

TEST_CASE("rivals are said of the cause that has them") {
    diagnosis::Diagnosis d = one_cause();
    CHECK_THAT(report::verdict_sentence(d), Catch::Contains("cannot tell C.backlash from its"));
    diagnosis::Cause sure = d.causes[0];
    sure.effect = "X.backlash";
    sure.rivals.clear();
    sure.probability = 0.97;
    d.causes.insert(d.causes.begin(), sure);
    CHECK_THAT(report::verdict_sentence(d),
               Catch::Contains("most of it by X.backlash, but these readings cannot tell "
                               "C.backlash from its rivals"));
    CHECK_THAT(report::answer(d), Catch::Contains("cannot tell C.backlash from its rivals"));
}

TEST_CASE("of two causes of one name the one in free form is said to be a table") {
    diagnosis::Diagnosis d = one_cause();
    diagnosis::Cause table = d.causes[0];
    table.parameters.clear();
    table.points = {{"gap", 0.0, 1e-5, 1e-6, "mm", "rad"}, {"gap", 9.0, 2e-5, 1e-6, "mm", "rad"}};
    d.causes.push_back(table);
    CHECK(report::cause_name(d, d.causes[0]) == "C.backlash");
    CHECK(report::cause_name(d, d.causes[1]) == "C.backlash as a table");
    CHECK_THAT(report::diagnosis_text(d), Catch::Contains("\nC.backlash as a table  "));
    CHECK_THAT(report::diagnosis_page(d, "r.csv").body_html,
               Catch::Contains("<h3>C.backlash</h3>") &&
                   Catch::Contains("<h3>C.backlash as a table</h3>"));
    d.causes.erase(d.causes.begin());
    CHECK(report::cause_name(d, d.causes[0]) == "C.backlash");
    // Two in free form are told apart by their errors.
    d.causes = {table, table};
    d.causes[1].points = {{"EXX", 0.0, 1e-5, 1e-6, "mm", "mm"},
                          {"EYX", 0.0, 1e-5, 1e-6, "mm", "mm"}};
    CHECK(report::cause_name(d, d.causes[0]) == "C.backlash (gap)");
    CHECK(report::cause_name(d, d.causes[1]) == "C.backlash (EXX, EYX)");
}

TEST_CASE("the page shows each probability, and what is not claimed explains nothing") {
    diagnosis::Diagnosis d = one_cause();
    d.causes[0].rivals.clear();
    diagnosis::Cause faint = d.causes[0];
    faint.effect = "J3.axial";
    faint.probability = 0.11;
    faint.share = 0.21;
    d.causes.push_back(faint);
    const char* listed = "Listed, but not claimed (probability below 0.5): J3.axial (0.11).";
    for (const auto verdict :
         {diagnosis::Verdict::explained, diagnosis::Verdict::ambiguous,
          diagnosis::Verdict::partly_explained, diagnosis::Verdict::unexplained}) {
        d.verdict = verdict;
        CHECK_THAT(report::answer(d), Catch::Contains("C.backlash (93 %, probability 0.60)") &&
                                          Catch::Contains(listed) &&
                                          !Catch::Contains("J3.axial (21 %"));
    }
    d.causes[1].rivals = {"J3.zero"};
    d.verdict = diagnosis::Verdict::ambiguous;
    const char* rest = "; for the rest these readings cannot tell J3.axial from its rivals";
    CHECK_THAT(report::verdict_sentence(d), Catch::Contains("by C.backlash" + std::string(rest)));
    CHECK_THAT(report::answer(d), Catch::Contains(rest));
    const std::string html = report::diagnosis_page(d, "r.csv").body_html;
    CHECK_THAT(html, Catch::Contains("<th>Probability</th>") && Catch::Contains("<td>0.60</td>") &&
                         Catch::Contains("<td>0.11<br><span class=\"note\">not claimed") &&
                         Catch::Contains("Probability 0.11, not claimed.") &&
                         Catch::Contains("21 %, not claimed"));
    d.causes.erase(d.causes.begin());
    d.causes[0].rivals.clear();
    d.verdict = diagnosis::Verdict::unexplained;
    CHECK_THAT(report::answer(d), Catch::Contains("No known effect is claimed") &&
                                      Catch::Contains(listed) && !Catch::Contains("looks like"));
    d.verdict = diagnosis::Verdict::partly_explained;
    CHECK_THAT(report::answer(d), Catch::Contains("but by what is uncertain"));
    for (const auto verdict : {diagnosis::Verdict::explained, diagnosis::Verdict::ambiguous}) {
        d.verdict = verdict;
        CHECK_THAT(report::answer(d),
                   Catch::Contains("uncertain: perhaps J3.axial (probability 0.11)"));
        CHECK_THAT(report::verdict_sentence(d), Catch::Contains("but by what is uncertain"));
    }
}

TEST_CASE("where nothing is claimed, a cause and its rivals are alternatives") {
    diagnosis::Diagnosis d = one_cause();
    d.causes[0].probability = 0.4;
    CHECK_THAT(report::verdict_sentence(d),
               Catch::Contains("cannot tell C.backlash (probability 0.40) from its rivals"));
    CHECK_THAT(
        report::answer(d),
        Catch::Contains("uncertain: C.backlash (probability 0.40), or one of its rivals (C"));
}

TEST_CASE("what is a cause or a rival is not said to be unseen") {
    diagnosis::Diagnosis d = one_cause();
    d.unseen = {"C.backlash", "C.zero & co", "X.scale"};
    CHECK_THAT(report::diagnosis_page(d, "r.csv").body_html,
               Catch::Contains("<dt>Not to be seen here</dt><dd>X.scale.</dd>"));
    CHECK_THAT(report::diagnosis_json(d), Catch::Contains("\"unseen\": [\n  \"X.scale\"\n ]"));
    d.unseen.pop_back();
    CHECK_THAT(report::diagnosis_page(d, "r.csv").body_html, !Catch::Contains("Not to be seen"));
}

TEST_CASE("an improbable cause is not said to be the cause: its rivals are") {
    diagnosis::Diagnosis d = one_cause();
    d.causes[0].probability = 0.004;
    CHECK_THAT(report::verdict_sentence(d), Catch::Contains("rather by a rival of C.backlash"));
    CHECK_THAT(report::answer(d),
               Catch::Contains("hardly C.backlash") &&
                   Catch::Contains("rather one of its rivals (" + d.causes[0].rivals[0]));
    CHECK_THAT(report::diagnosis_text(d), Catch::Contains("probability < 0.01") &&
                                              Catch::Contains("rather one of its rivals, or"));
}

TEST_CASE("the answer says where the gap shrinks") {
    diagnosis::Diagnosis d = one_cause();
    CHECK_THAT(report::answer(d), !Catch::Contains("measured places"));
    d.between_places = false;
    CHECK_THAT(report::answer(d), Catch::Contains("in the fit, at the measured places."));
}

TEST_CASE("the page says size, cause, rivals and shrink, and is whole") {
    const std::string page = report::page_html(report::diagnosis_page(one_cause(), "a <b>.csv"));
    for (const char* text :
         {"2.00 µm rms", "C.backlash", "93 %", "C.zero &amp; co", "a &lt;b&gt;.csv", "90 %",
          "85 to 95 %", "worn worm gear", "readjust the preload", "gap 81.23"})
        CHECK_THAT(page, Catch::Contains(text));
    CHECK_THAT(page, !Catch::Contains("nan") && !Catch::Contains("inf\""));
    for (const char* tag : {"table", "svg", "ul", "dl", "h2", "p", "tr", "td"})
        CHECK(count(page, std::string("<") + tag + ">") +
                  count(page, std::string("<") + tag + " ") ==
              count(page, std::string("</") + tag + ">"));
}

TEST_CASE("a page without a gap says so and shows no cause") {
    diagnosis::Diagnosis d;
    d.rms_um = d.noise_um = 0.8;
    const std::string page = report::page_html(report::diagnosis_page(d, "x.csv"));
    CHECK_THAT(page, Catch::Contains("No gap.") && !Catch::Contains("Which effect"));
}

}  // namespace trunnion
