// Ten files in the shapes that instruments, controls and people write: each comes in as it is, and
// identify finds what its writer put in (tests/imports/like_real/make_sets.py, which shares nothing
// with the product), within 5 %.
#include <algorithm>
#include <catch2/catch.hpp>
#include <fstream>
#include <sstream>

#include "base/units.h"
#include "identification/identify.h"
#include "imports/import.h"
#include "records/readings.h"

namespace trunnion {
namespace {

using imports::ImportKind;

const std::string folder = TRUNNION_SOURCE_DIR "/tests/imports/like_real/";

std::string text_of(const std::string& name) {
    std::ifstream file(folder + name, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    REQUIRE(!text.str().empty());
    return text.str();
}

/// What make_sets.py wrote down: "set key value unit".
double truth(const std::string& set, const std::string& key) {
    std::istringstream lines(text_of("truth.txt"));
    std::string a, b, unit;
    double value = 0.0;
    while (lines >> a >> b >> value >> unit)
        if (a == set && b == key) return value;
    FAIL("no truth of " << set << ' ' << key);
    return 0.0;
}

struct Import {
    ImportKind kind;
    std::string file, setup;
    std::vector<std::string> told = {};
};

/// The readings of a file, and what effects they show.
class Result {
  public:
    Result(const Import& import, const std::vector<std::string>& effects) {
        std::vector<std::string> notes;
        const setup::Setup setup = setup::load_setup(folder + import.setup, notes);
        const std::vector<imports::ImportFile> files{{import.file, text_of(import.file)}};
        imported_ =
            imports::import_readings(import.kind, {setup, files, imports::Facts(import.told), {}});
        notes.clear();
        table_ = records::parse_readings(imported_.readings, "r.csv", notes,
                                         setup.machine.chain.names());
        REQUIRE(notes.empty());
        found_ = identification::identify(setup, table_, effects);
    }

    std::size_t rows() const { return table_.rows.size(); }
    const records::ReadingTable& table() const { return table_; }
    const identification::Identification& found() const { return found_; }
    const imports::Imported& imported() const { return imported_; }

    /// In the unit of the parameter.
    double value(const std::string& effect, const std::string& name) const {
        for (const identification::FitParameter& p : found_.parameters)
            if (p.effect == effect && p.name == name) {
                CHECK(std::isfinite(p.sigma));
                return p.value;
            }
        FAIL("no " << effect << ' ' << name);
        return 0.0;
    }

  private:
    imports::Imported imported_;
    records::ReadingTable table_;
    identification::Identification found_;
};

auto within_five_percent(double value) {
    return Approx(value).epsilon(0.05);
}

}  // namespace

TEST_CASE("a laser's table with prose above and results below, ';' and decimal comma",
          "[imports][like_real]") {
    const Result laser({ImportKind::iso230_2, "laser_x.csv", "bench.toml"}, {"X.backlash"});
    CHECK(1e3 * laser.value("X.backlash", "gap_mm") ==
          within_five_percent(truth("laser_x", "backlash_um")));
    CHECK(laser.rows() == 5 * 2 * (10 + 1));
    CHECK(laser.table().rows.back().session == "2024-03-12");
    CHECK_THAT(laser.imported().summary[0], Catch::Contains("X, 5 runs both ways at 10 targets"));
}

TEST_CASE("a list of a value a line: two axes on two days, positions beside errors",
          "[imports][like_real]") {
    const Result laser({ImportKind::iso230_2, "laser_list.csv", "bench.toml"},
                       {"X.backlash", "Y.backlash"});
    CHECK(1e3 * laser.value("X.backlash", "gap_mm") ==
          within_five_percent(truth("laser_list", "X.backlash_um")));
    CHECK(1e3 * laser.value("Y.backlash", "gap_mm") ==
          within_five_percent(truth("laser_list", "Y.backlash_um")));
    CHECK(laser.table().rows.front().session == "2024-03-14");
    CHECK(laser.table().rows.back().session == "2024-03-15");
}

TEST_CASE("a control's trace in three sections, with a row of units and values missing",
          "[imports][like_real]") {
    const Result mill({ImportKind::axis_log, "mill_log.csv", "bench.toml"}, {"servo.mismatch"});
    CHECK(1e3 * mill.value("servo.mismatch", "tau_x_s") ==
          within_five_percent(truth("mill_log", "X.tau_ms")));
    CHECK(1e3 * mill.value("servo.mismatch", "tau_z_s") ==
          within_five_percent(truth("mill_log", "Z.tau_ms")));
    CHECK(mill.rows() == 3 * (2 * 600 - 2));
    CHECK(mill.table().rows.back().test == "log_3");
}

TEST_CASE("a sampler's numbers without names, with an overrun between", "[imports][like_real]") {
    const Result log({ImportKind::axis_log,
                      "sampler.txt",
                      "bench.toml",
                      {"columns=n, X cmd [mm], X act [mm], flag", "step_s=0.004"}},
                     {"servo.mismatch"});
    CHECK(1e3 * log.value("servo.mismatch", "tau_x_s") ==
          within_five_percent(truth("sampler", "tau_ms")));
    CHECK(log.rows() == 1500);
}

TEST_CASE("a plate without heights, whose points lie turned", "[imports][like_real]") {
    const Result plate({ImportKind::points, "plate_wide.tsv", "bench.toml"}, {});
    CHECK(plate.rows() == 2 * 47);
    CHECK(deg_from_rad(plate.value("setup", "CMM.c_rad")) ==
          within_five_percent(truth("plate_wide", "turned_deg")));
    REQUIRE(plate.found().set_up_words.size() == 1);
    CHECK_THAT(plate.found().set_up_words[0], Catch::Contains("turned by 0.029"));
}

TEST_CASE("a CMM's report with a line for each coordinate", "[imports][like_real]") {
    const Result plate({ImportKind::points, "plate_lines.csv", "bench.toml"},
                       {"X.scale", "Y.scale", "XY.squareness"});
    CHECK(plate.rows() == 3 * 48);
    CHECK(plate.value("X.scale", "scale_ppm") ==
          within_five_percent(truth("plate_lines", "scale_ppm")));
    CHECK(plate.value("Y.scale", "scale_ppm") ==
          within_five_percent(truth("plate_lines", "scale_ppm")));
    CHECK(1e6 * std::abs(plate.value("XY.squareness", "angle_rad")) ==
          within_five_percent(truth("plate_lines", "square_urad")));
}

TEST_CASE("a resolver against a reference over two turns, angles from 0 to 360 again and again",
          "[imports][like_real]") {
    const Result ring({ImportKind::pointing,
                       "resolver.dat",
                       "bench.toml",
                       {"columns=n, C reference [deg], C resolver [deg]", "step_s=1"}},
                      {"C.positioning", "C.backlash"});
    CHECK(1e6 * std::hypot(ring.value("C.positioning", "cos4_rad"),
                           ring.value("C.positioning", "sin4_rad")) ==
          within_five_percent(truth("resolver", "order4_urad")));
    CHECK(1e6 * ring.value("C.backlash", "gap_rad") ==
          within_five_percent(truth("resolver", "backlash_urad")));
}

TEST_CASE("stars all over the sky: how the azimuth axis leans", "[imports][like_real]") {
    const Result sky({ImportKind::pointing, "telescope.csv", "mount.toml"}, {"location"});
    CHECK(sky.rows() == 2 * 120);
    CHECK(1e6 * sky.value("location", "EA0Az_rad") ==
          within_five_percent(truth("telescope", "lean_x_urad")));
    CHECK(1e6 * sky.value("location", "EB0Az_rad") ==
          within_five_percent(truth("telescope", "lean_y_urad")));
}

TEST_CASE("collimation and the zero of the test are one column, and named as such",
          "[imports][like_real]") {
    const Result sky({ImportKind::pointing, "telescope.csv", "mount.toml"},
                     {"location", "chain.collimation"});
    const auto& lists = sky.found().inseparable;
    const auto pair = std::find_if(lists.begin(), lists.end(), [](const auto& group) {
        return group.names == std::vector<std::string>{"chain.collimation.second_rad",
                                                       "zero.across_Alt_rad.2024-02-17"};
    });
    REQUIRE(pair != lists.end());
    CHECK(pair->direction[0] == Approx(1.0));
    CHECK(pair->direction[1] == Approx(-1.0));
    CHECK(1e6 * sky.value("location", "EA0Az_rad") ==
          within_five_percent(truth("telescope", "lean_x_urad")));
}

TEST_CASE("a tracker's points of an arm, joints in columns of their own", "[imports][like_real]") {
    const Result arm({ImportKind::points, "robot.csv", "arm.toml"}, {"J2.zero", "J3.zero"});
    CHECK(arm.rows() == 3 * 90);
    CHECK(1e6 * arm.value("J2.zero", "offset_rad") ==
          within_five_percent(truth("robot", "J2.zero_urad")));
    CHECK(1e6 * arm.value("J3.zero", "offset_rad") ==
          within_five_percent(truth("robot", "J3.zero_urad")));
}

TEST_CASE("both ways of a circle in one file", "[imports][like_real]") {
    const Result bar({ImportKind::ballbar, "ballbar.txt", "bench.toml"},
                     {"XY.squareness", "Y.backlash"});
    CHECK(bar.rows() == 2 * 181);
    CHECK(1e6 * std::abs(bar.value("XY.squareness", "angle_rad")) ==
          within_five_percent(truth("ballbar", "square_urad")));
    CHECK(1e3 * bar.value("Y.backlash", "gap_mm") ==
          within_five_percent(truth("ballbar", "Y.backlash_um")));
}

}  // namespace trunnion
