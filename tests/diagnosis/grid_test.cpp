// Targets read at the places of a grid, layer by layer: what follows the position of an axis is an
// error of it, whatever the folds, the stops and the sides of its axes are.
#include <catch2/catch.hpp>
#include <map>
#include <set>

#include "base/random.h"
#include "diagnosis/diagnosis.h"
#include "diagnosis/prepare/prepare.h"
#include "effects/settings.h"
#include "emulator/replay.h"
#include "tests/support/said.h"

namespace trunnion {
namespace {

setup::Setup machine(const std::string& more = "") {
    std::vector<std::string> notes;
    return setup::parse_setup(
        "[machine]\nname = \"mill\"\nchain = \"w b Y X Z t\"\n"
        "[[artefact]]\nname = \"R1\"\nkind = \"target\"\ntool_mm = [20, -15, -120]\n"
        "[[artefact]]\nname = \"R2\"\nkind = \"target\"\ntool_mm = [60, 40, -200]\n"
        "[[instrument]]\nname = \"TR\"\norigin_mm = [1000, 500, 200]\n"
        "rotation_deg = [0, 0, 0]\nfree = [\"pose\"]\n"
        "[model]\nmodelled = []\nnoise_um = { point = 2 }\n" +
            more,
        "s.toml", notes);
}

/// 5 x 5 x 3 places, X first, always upwards; two targets in three directions at each.
records::ReadingTable grid() {
    records::ReadingTable table;
    table.path = "grid.csv";
    table.axes = {Axis::Y, Axis::X, Axis::Z};
    for (int place = 0; place < 75; ++place)
        for (const char* target : {"R1", "R2"})
            for (int d = 0; d < 3; ++d) {
                records::Reading row;
                row.index = static_cast<int>(table.rows.size());
                row.time_s = 5.0 * row.index;
                row.test = "volume";
                row.device = records::Device::point;
                row.feature = target;
                row.instrument = "TR";
                row.direction_M = Vector3::Unit(d);
                row.commanded[Axis::X] = -350.0 + 175.0 * (place % 5);
                row.commanded[Axis::Y] = -300.0 + 150.0 * (place / 5 % 5);
                row.commanded[Axis::Z] = -200.0 + 150.0 * (place / 25);
                table.rows.push_back(row);
            }
    return table;
}

/// A bow over the travel of an axis, -1..1.
double bow(double part) {
    return 1.5 * part * part - 0.5;
}

}  // namespace

TEST_CASE("no fold holds all stops at a place of an axis", "[diagnosis][grid]") {
    records::ReadingTable table = grid();
    for (records::Reading& row : table.rows) row.value_mm = 0.0;
    const diagnosis::Prepared p = diagnosis::prepare(machine(), table);
    for (const Axis axis : {Axis::X, Axis::Y, Axis::Z}) {
        std::map<double, std::set<int>> folds;
        for (std::size_t i = 0; i < p.replay.size(); ++i)
            folds[p.replay.sample(i).position[axis]].insert(
                p.folds.fold[static_cast<std::size_t>(p.folds.group[i])]);
        for (const auto& [place, own] : folds) {
            INFO(place);
            CHECK(own.size() >= 3);
        }
    }
}

// With all stops of a place left out at once, the angle predicted none of them, and what the stops
// share was taken for noise: "no gap".
TEST_CASE("an angle of two targets is no scatter of the stops", "[diagnosis][grid]") {
    for (const std::uint64_t seed : {1, 2}) {
        records::ReadingTable table = grid();
        SeededNoise random(seed);
        for (records::Reading& row : table.rows) {
            // ECX turns the tool's offset about the axis of X, which Y does not carry.
            const double angle_rad = 60e-6 * bow(row.commanded[Axis::X] / 350.0);
            const Vector3 tool =
                row.feature == "R1" ? Vector3(20, -15, -120) : Vector3(60, 40, -200);
            const Vector3 moved = angle_rad * Vector3::UnitZ().cross(tool);
            row.value_mm = moved.dot(row.direction_M) + 2e-3 * random.normal();
        }
        const diagnosis::Diagnosis d = diagnosis::diagnose(machine(), table);
        INFO(said(d));
        CHECK(d.verdict == diagnosis::Verdict::explained);
        CHECK(probability_of(d, "X.angular") > 0.8);
    }
}

// Y moves down from layer to layer only: it reaches its first place from the other side than the
// rest.
TEST_CASE("a straightness in layers is no play sideways", "[diagnosis][grid]") {
    for (const std::uint64_t seed : {1, 2}) {
        records::ReadingTable table = grid();
        SeededNoise random(seed);
        for (records::Reading& row : table.rows) {
            const double part = row.commanded[Axis::Y] / 300.0;
            const double up_mm = 0.020 * bow(part) + 0.010 * 0.5 * part * (5.0 * part * part - 3.0);
            row.value_mm = up_mm * row.direction_M.z() + 2e-3 * random.normal();
        }
        const diagnosis::Diagnosis d = diagnosis::diagnose(machine(), table);
        INFO(said(d));
        CHECK(probability_of(d, "Y.straightness") > 0.9);
        CHECK(probability_of(d, "Y.lateral_play") < 0.5);
    }
}

}  // namespace trunnion
