// A plate measured at points: the part lies as it was clamped, so that its pose is free.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <string>

#include "diagnosis/diagnosis.h"
#include "diagnosis/groups/candidate_groups.h"
#include "effects/settings.h"
#include "emulator/replay.h"
#include "tests/support/diagnosed.h"
#include "tests/support/said.h"

namespace trunnion {
namespace {

setup::Setup bench(const std::string& noise_um = "1.5") {
    std::vector<std::string> notes;
    return setup::parse_setup(
        "[machine]\nname = \"m\"\nchain = \"w b X Y Z t\"\n"
        "[[artefact]]\nname = \"R1\"\nkind = \"target\"\ntool_mm = [0, 0, -150]\n"
        "[[instrument]]\nname = \"CMM\"\nframe = \"W\"\nfree = [\"pose\"]\n"
        "[model]\nmodelled = []\nnoise_um = { point = " +
            noise_um + " }\n",
        "s.toml", notes);
}

/// A grid of 6 x 5 points on two days, three coordinates each.
records::ReadingTable grid() {
    records::ReadingTable table;
    table.path = "plate.csv";
    table.axes = {Axis::X, Axis::Y, Axis::Z};
    for (int k = 0; k < 180; ++k) {
        records::Reading row;
        row.index = k;
        row.time_s = 60.0 * (k / 3);
        row.test = "plate";
        row.session = k < 90 ? "a" : "b";
        row.device = records::Device::point;
        row.feature = "R1";
        row.instrument = "CMM";
        row.direction_M = Vector3::Unit(k % 3);
        row.commanded[Axis::X] = 35.0 * (k % 90 / 15);
        row.commanded[Axis::Y] = 40.0 * (k / 3 % 5);
        table.rows.push_back(row);
    }
    table.optional_columns = {"session", "instrument"};
    return table;
}

}  // namespace

TEST_CASE("a dependence on a product of two positions has its usual size at the corners",
          "[diagnosis]") {
    const setup::Setup setup = bench();
    const records::ReadingTable read = emulator::predicted(setup, grid(), {});
    const diagnosis::Prepared prepared = diagnosis::prepare(setup, read);
    const diagnosis::Whitener whitener(prepared.replay, prepared.blocks, {},
                                       prepared.base.sigma_mm);
    const auto rows = static_cast<Eigen::Index>(prepared.replay.size());
    diagnosis::Design design(Eigen::MatrixXd(rows, 0), Eigen::VectorXd::Zero(rows),
                             static_cast<double>(rows));
    diagnosis::add_driver_groups(design, prepared, whitener, 0);
    int found = 0;
    for (std::size_t k = 0; k < design.groups().size(); ++k) {
        if (design.group(k).name != "X and Y" || design.group(k).is_whole) continue;
        ++found;
        const Eigen::MatrixXd columns = design.columns(k) * 1.5e-3;  // sigma
        for (Eigen::Index c = 0; c < columns.cols(); ++c)
            CHECK(columns.col(c).cwiseAbs().maxCoeff() == Approx(5e-3));
    }
    CHECK(found == 1);
}

// The slope of a line is squareness by definition (ISO 230-1); a bow of the scatter beside it must
// not turn all of it into straightness.
TEST_CASE("squareness with a bow beside it is not called straightness without a rival",
          "[diagnosis]") {
    const setup::Setup setup = bench();
    for (unsigned seed = 1; seed <= 6; ++seed) {
        setup::Setup real = setup;
        real.effects.push_back({"XY.squareness", {{"angle_rad", {70e-6}}}});
        real.effects.push_back(
            {"Y.straightness", {{"EXY_p2_mm", {-9e-3}}, {"EZY_p2_mm", {-7e-3}}}});
        records::ReadingTable read =
            emulator::predicted(real, grid(), effects::active_models(real));
        std::mt19937_64 engine(seed);
        std::normal_distribution<double> noise(0.0, 1.5e-3);
        for (records::Reading& row : read.rows) *row.value_mm += noise(engine);
        diagnosis::DiagnosisOptions options;
        options.plan_next = false;
        const diagnosis::Diagnosis d = diagnosis::diagnose(setup, read, options);
        INFO(seed << ": " << said(d));
        bool named = false;
        for (const diagnosis::Cause& c : d.causes) {
            named = named || c.effect == "XY.squareness" ||
                    std::find(c.rivals.begin(), c.rivals.end(), "XY.squareness") != c.rivals.end();
            if (c.effect == "Y.straightness" && c.share > 0.5) CHECK(c.probability < 0.95);
        }
        CHECK(named);
    }
}

// A plane with a bow along Y that depends on X: no motion of single axes makes it. (A slope along Y
// that depends on X is X.angular, a roll.)
TEST_CASE("an error over a plane is located at the product of two positions", "[diagnosis]") {
    const setup::Setup setup = bench();
    for (unsigned seed = 1; seed <= 4; ++seed) {
        records::ReadingTable read =
            emulator::predicted(setup, grid(), effects::active_models(setup));
        std::mt19937_64 engine(seed);
        std::normal_distribution<double> noise(0.0, 1.5e-3);
        for (records::Reading& row : read.rows) {
            const double u = row.commanded[Axis::X] / 87.5 - 1.0;
            const double v = row.commanded[Axis::Y] / 80.0 - 1.0;
            const double bows = (1.5 * u * u - 0.5) * (1.5 * v * v - 0.5);
            *row.value_mm += 12e-3 * bows * row.direction_M.z() + noise(engine);
        }
        diagnosis::DiagnosisOptions options;
        options.plan_next = false;
        const diagnosis::Diagnosis d = diagnosis::diagnose(setup, read, options);
        INFO(seed << ": " << said(d));
        CHECK(d.verdict == diagnosis::Verdict::unexplained);
        REQUIRE_FALSE(d.causes.empty());
        CHECK(d.causes.front().effect == "unknown");
        CHECK_THAT(d.causes.front().what, Catch::Contains("X and Y"));
    }
}

// Through one tool length the angles of Y are its scale and its squareness: other names of the
// same.
TEST_CASE("angles seen through one arm have the scale and the squareness as rivals",
          "[diagnosis]") {
    const setup::Setup setup = bench();
    setup::Setup real = setup;
    real.effects.push_back({"Y.angular", {{"EAY_p1_rad", {50e-6}}, {"EBY_p1_rad", {70e-6}}}});
    for (unsigned seed = 1; seed <= 4; ++seed) {
        records::ReadingTable read =
            emulator::predicted(real, grid(), effects::active_models(real));
        std::mt19937_64 engine(seed);
        std::normal_distribution<double> noise(0.0, 1.5e-3);
        for (records::Reading& row : read.rows) *row.value_mm += noise(engine);
        const diagnosis::Diagnosis d = diagnosed(setup, read);
        INFO(seed << ": " << said(d));
        for (const diagnosis::Cause& c : d.causes) {
            if (c.effect != "Y.angular") continue;
            CHECK(c.probability < 0.9);
            for (const char* name : {"Y.scale", "XY.squareness"})
                CHECK(std::find(c.rivals.begin(), c.rivals.end(), name) != c.rivals.end());
        }
        CHECK(d.explained > 0.8);
    }
}

// The heights of a bed, few points and much noise: as tables over X they hold at these places only,
// as a bow and a twist everywhere.
TEST_CASE("where the tables of a few points fail elsewhere, their textbook forms are written",
          "[diagnosis]") {
    const setup::Setup setup = bench();
    const auto bed = [](int side, double pitch_mm, double noise_mm, unsigned seed) {
        records::ReadingTable table = grid();
        std::mt19937_64 engine(seed);
        std::normal_distribution<double> noise(0.0, noise_mm);
        records::Reading row = table.rows.front();
        table.rows.clear();
        row.session = "";
        row.direction_M = Vector3::UnitZ();
        for (int k = 0; k < side * side; ++k) {
            row.index = k;
            row.time_s = 10.0 * k;
            row.commanded[Axis::X] = pitch_mm * (k % side);
            row.commanded[Axis::Y] = pitch_mm * (k / side);
            const double x = row.commanded[Axis::X] / 100.0 - 1.0,
                         y = row.commanded[Axis::Y] / 100.0 - 1.0;
            row.value_mm = 0.1 * x * x + 0.08 * x * y + noise(engine);
            table.rows.push_back(row);
        }
        return table;
    };
    for (unsigned seed = 1; seed <= 5; ++seed) {
        const diagnosis::Diagnosis d = diagnosed(setup, bed(5, 50.0, 0.015, seed));
        const records::ReadingTable fresh = bed(9, 25.0, 0.0, 99);
        INFO(seed << ": " << said(d));
        CHECK(left_beside(d.setup, fresh) < 0.5 * left_beside(setup, fresh));
    }
}

// Usual is 10 um; this instrument is far better, and nobody says so.
TEST_CASE("a spoiled coordinate is set aside where nobody states the noise", "[diagnosis]") {
    setup::Setup setup = bench();
    setup.model.noise_um.clear();
    records::ReadingTable table = grid();
    for (records::Reading& row : table.rows) row.session = "a";
    table.rows.resize(60);
    setup::Setup real = setup;
    real.effects.push_back(
        effects::parse_injection("X.scale: scale_ppm=12", effects::make_catalogue(setup)));
    records::ReadingTable read = emulator::predicted(real, table, effects::active_models(real));
    std::mt19937_64 engine(3);
    std::normal_distribution<double> noise(0.0, 2e-4);
    for (records::Reading& row : read.rows) *row.value_mm += noise(engine);
    *read.rows[30].value_mm += 0.015;
    const diagnosis::Diagnosis d = diagnosis::diagnose(setup, read);
    INFO(said(d));
    CHECK(d.outliers == 1);
    CHECK(d.verdict != diagnosis::Verdict::no_gap);
    CHECK(d.noise_um.value() < 0.4);
}

// The form of a plate that no axis has: of 4.5 um where 3 um are stated it is no noise, although
// nothing repeats.
TEST_CASE("readings that are alike at near places are a gap, and what is stated is told",
          "[diagnosis]") {
    const setup::Setup setup = bench("3");
    for (const bool formed : {true, false}) {
        std::mt19937_64 engine(7);
        std::uniform_real_distribution<double> at(0.0, 600.0);
        std::normal_distribution<double> noise(0.0, formed ? 3e-3 : 4.5e-3);
        records::ReadingTable table;
        table.path = "plate.csv";
        table.axes = {Axis::X, Axis::Y, Axis::Z};
        for (int k = 0; k < 320; ++k) {
            records::Reading row;
            row.index = k;
            row.time_s = 60.0 * (k / 2);
            row.test = "plate";
            row.device = records::Device::point;
            row.feature = "R1";
            row.instrument = "CMM";
            row.direction_M = Vector3::Unit(k % 2);
            if (k % 2 == 0) {
                row.commanded[Axis::X] = at(engine);
                row.commanded[Axis::Y] = at(engine);
            } else {
                row.commanded = table.rows.back().commanded;
            }
            const double x = row.commanded[Axis::X], y = row.commanded[Axis::Y];
            row.value_mm =
                noise(engine) +
                (formed ? 6.5e-3 * std::sin(x / 45.0 + k % 2) * std::cos(y / 40.0) : 0.0);
            table.rows.push_back(row);
        }
        table.optional_columns = {"instrument"};
        const diagnosis::Diagnosis d = diagnosed(setup, table);
        INFO(formed << " " << d.noise_um << " " << said(d));
        CHECK((d.verdict == diagnosis::Verdict::no_gap) == !formed);
        REQUIRE(d.stated_um);
        CHECK(*d.stated_um == Approx(3.0));
        const auto alike = std::any_of(d.causes.begin(), d.causes.end(), [](const auto& c) {
            return c.what.find("near places") != std::string::npos;
        });
        CHECK(alike == formed);
    }
}

}  // namespace trunnion
