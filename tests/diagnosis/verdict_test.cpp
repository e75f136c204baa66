// The verdict and its words, and readings that are left out as wild.
#include "diagnosis/verdict/verdict.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "base/random.h"
#include "base/units.h"
#include "diagnosis/diagnosis.h"
#include "diagnosis/prepare/outliers.h"

namespace trunnion {

using diagnosis::Verdict;

TEST_CASE("the part of the gap and the rivals decide the verdict", "[diagnosis]") {
    diagnosis::Claim sure, rivalled, unsure;
    sure.probability = 0.95;
    unsure.probability = 0.4;
    rivalled.rivals = {"C.backlash"};
    rivalled.share = 0.05;
    diagnosis::Claim background = rivalled;
    background.share = 0.04;
    diagnosis::Judgement j;
    j.part = 0.9;
    CHECK(verdict_of(j, {rivalled}) == Verdict::no_gap);
    j.gap = true;
    CHECK(verdict_of(j, {sure}) == Verdict::explained);
    CHECK(verdict_of(j, {sure, rivalled}) == Verdict::ambiguous);
    CHECK(verdict_of(j, {unsure}) == Verdict::ambiguous);  // explained, but by what?
    CHECK(verdict_of(j, {sure, background}) == Verdict::explained);
    j.part = 0.79;
    CHECK(verdict_of(j, {sure}) == Verdict::partly_explained);
    CHECK(verdict_of(j, {rivalled}) == Verdict::partly_explained);
    j.part = 0.49;
    CHECK(verdict_of(j, {sure}) == Verdict::unexplained);
}

TEST_CASE("verdicts and sources of the noise have the words of the report", "[diagnosis]") {
    const auto word = [](auto value) { return std::string(diagnosis::to_string(value)); };
    CHECK(word(Verdict::no_gap) == "no-gap");
    CHECK(word(Verdict::explained) == "explained");
    CHECK(word(Verdict::partly_explained) == "partly-explained");
    CHECK(word(Verdict::ambiguous) == "ambiguous");
    CHECK(word(Verdict::unexplained) == "unexplained");
    CHECK(word(diagnosis::NoiseSource::repeats) == "repeats");
    CHECK(word(diagnosis::NoiseSource::given) == "given");
    CHECK(word(diagnosis::NoiseSource::assumed) == "assumed");
}

TEST_CASE("few and scattered readings are wild, many or neighbours are an effect", "[diagnosis]") {
    constexpr int rows = 400;
    SeededNoise random(6);
    Eigen::VectorXd quiet(rows);
    for (double& v : quiet) v = std::clamp(random.normal(), -3.0, 3.0);
    std::vector<bool> used(rows, true);
    std::vector<records::Device> devices(rows, records::Device::ballbar);
    const auto wild = [&](int first, int step, int count) {
        Eigen::VectorXd left = quiet;
        for (int k = 0; k < count; ++k) left(first + k * step) = k % 2 ? 12.0 : -12.0;
        return diagnosis::wild_readings({left, Eigen::VectorXd::Zero(left.size()), devices}, used,
                                        0.04 * rows);
    };
    CHECK(wild(0, 1, 0).empty());
    CHECK(wild(20, 100, 3) == std::vector<std::size_t>{20, 120, 220});
    CHECK(wild(10, 24, 16).size() == 16);  // 4 %
    CHECK(wild(10, 22, 17).empty());       // more
    CHECK(wild(100, 1, 12).empty());       // side by side
    CHECK(wild(100, 1, 8).size() == 8);    // too few to be told from chance
    // A tenth of the table is of a probe: its readings count among themselves.
    CHECK(wild(2, 4, 10).empty());
    std::fill_n(devices.begin(), 40, records::Device::sphere);
    CHECK(wild(2, 4, 10).size() == 10);
    CHECK(wild(2, 1, 10).empty());
    used[120] = false;
    CHECK(wild(20, 100, 3) == std::vector<std::size_t>{20, 220});
}

TEST_CASE("more spoiled readings than four of a hundred by chance are a gap", "[diagnosis]") {
    const auto are_spoiled = [](std::size_t readings, std::size_t spoiled) {
        std::vector<bool> used(readings, true);
        std::fill_n(used.begin(), spoiled, false);
        return diagnosis::are_spoiled(used);
    };
    CHECK_FALSE(are_spoiled(100, 0));
    CHECK_FALSE(are_spoiled(100, 8));
    CHECK(are_spoiled(100, 9));
    CHECK_FALSE(are_spoiled(2500, 120));
    CHECK(are_spoiled(2500, 121));
}

// With ten readings a driver of six columns would explain nearly anything.
TEST_CASE("where the gap is needs five readings more than a driver has columns", "[diagnosis]") {
    for (const Eigen::Index rows : {12, 200}) {
        SeededNoise random(7);
        const auto noise = [&](Eigen::Index columns) {
            Eigen::MatrixXd m(rows, columns);
            for (double& v : m.reshaped()) v = random.normal();
            return m;
        };
        const Eigen::MatrixXd known = noise(2), driver = noise(6);
        const Eigen::VectorXd data = driver * Eigen::VectorXd::Constant(6, 30.0) + noise(1).col(0);
        diagnosis::Design design(known, data, static_cast<double>(rows));
        design.add_features(noise(1));
        diagnosis::ColumnGroup group;
        group.kind = diagnosis::GroupKind::driver;
        group.name = "time";
        group.text = "drifts with time";
        group.component = "machine frame";
        const Eigen::Index first = design.add_features(driver);
        for (Eigen::Index k = 0; k < 6; ++k) group.features.push_back(first + k);
        design.add_beside(std::move(group), 1);
        const auto where = diagnosis::where_of(design, 1.0);
        REQUIRE(where.size() == (rows > 100 ? 1 : 0));
        if (rows < 100) continue;
        CHECK(where.front().by == "time");
        CHECK(where.front().share > 0.99);
        CHECK(where.front().text == "100 % of the gap drifts with time (machine frame)");
    }
}

// Neighbours 15 degrees apart differ by such an error as much as by noise.
TEST_CASE("readings without repeats and stated noise, far beyond the usual, are a gap",
          "[diagnosis]") {
    std::vector<std::string> notes;
    const setup::Setup setup = setup::parse_setup(
        "[machine]\nname = \"m\"\nchain = \"w b C t\"\n[machine.axis.C]\n"
        "direction = [0, 0, 1]\npoint_mm = [0, 0, 0]\n[[artefact]]\nname = \"R1\"\n"
        "kind = \"target\"\ntool_mm = [0, 0, 0]\n",
        "m.toml", notes);
    const auto verdict = [&](double size_rad, double noise_rad) {
        SeededNoise noise(4);
        records::ReadingTable table;
        table.axes = {Axis::C};
        for (int k = 0; k < 24; ++k) {
            records::Reading row;
            const double c_rad = rad_from_deg(15.0 * k);
            row.index = k;
            row.time_s = 5.0 * k;
            row.test = "turn";
            row.device = records::Device::angle;
            row.angular = true;
            row.feature = "R1";
            row.direction_M = Vector3(0.0, 0.0, 1.0);
            row.commanded[Axis::C] = c_rad;
            row.value_mm = size_rad * (2.0 * std::cos(7.0 * c_rad + 1.0) + std::cos(4.0 * c_rad) +
                                       std::cos(3.0 * c_rad - 2.0)) +
                           noise_rad * noise.normal();
            table.rows.push_back(row);
        }
        diagnosis::DiagnosisOptions options;
        options.plan_next = false;
        return diagnosis::diagnose(setup, table, options).verdict;
    };
    CHECK(verdict(160e-6, 8e-6) != Verdict::no_gap);
    CHECK(verdict(0.0, 3e-6) == Verdict::no_gap);
    CHECK(verdict(0.0, 60e-6) == Verdict::unexplained);  // nobody knows
}

}  // namespace trunnion
