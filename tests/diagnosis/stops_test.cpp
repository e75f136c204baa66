// Several targets read at one stop of the axes: what the machine does not repeat moves all of them,
// and is no proof of an effect.
#include <catch2/catch.hpp>
#include <random>

#include "diagnosis/diagnosis.h"
#include "effects/settings.h"
#include "emulator/replay.h"
#include "tests/support/said.h"

namespace trunnion {
namespace {

constexpr int targets = 6;

setup::Setup bench(const std::string& errors = "") {
    std::string text =
        "[machine]\nname = \"m\"\nchain = \"w b X Y Z t\"\n"
        "[[instrument]]\nname = \"CMM\"\nfree = [\"pose\"]\n"
        "[model]\nmodelled = []\nnoise_um = { point = 20 }\n" +
        errors;
    const char* const at[targets] = {"0, 0, 0",   "16, -9, 0", "32, 0, 0",
                                     "33, 19, 0", "16, 29, 0", "0, 19, 0"};
    for (int t = 0; t < targets; ++t)
        text += "[[artefact]]\nname = \"T" + std::to_string(t + 1) +
                "\"\nkind = \"target\"\ntool_mm = [" + at[t] + "]\nfree = [\"tool\"]\n";
    std::vector<std::string> notes;
    return setup::parse_setup(text, "s.toml", notes);
}

/// Twelve stops, each of which misses its place by `stop_mm` in each direction.
records::ReadingTable read(const setup::Setup& real, double stop_mm, unsigned seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> even(-120.0, 120.0);
    records::ReadingTable table;
    table.path = "stops.csv";
    table.axes = {Axis::X, Axis::Y, Axis::Z};
    std::vector<double> moved;
    for (int stop = 0; stop < 12; ++stop) {
        AxisPositions at;
        for (const Axis axis : table.axes) at[axis] = even(random);
        const Vector3 miss = stop_mm * Vector3(normal(random), normal(random), normal(random));
        for (int k = 0; k < 3 * targets; ++k) {
            records::Reading row;
            row.index = static_cast<int>(table.rows.size());
            row.time_s = 600.0 * stop + 10.0 * (k / 3);
            row.test = "points";
            row.device = records::Device::point;
            row.feature = "T" + std::to_string(1 + k / 3);
            row.instrument = "CMM";
            row.direction_M = Vector3::Unit(k % 3);
            row.commanded = at;
            moved.push_back(row.direction_M.dot(miss) + 0.02 * normal(random));
            table.rows.push_back(row);
        }
    }
    table.optional_columns = {"instrument"};
    table = emulator::predicted(real, table, effects::active_models(real));
    for (std::size_t i = 0; i < moved.size(); ++i) *table.rows[i].value_mm += moved[i];
    return table;
}

double shared(const diagnosis::Diagnosis& d) {
    return d.noise.point.shared + d.noise.point.turned;
}

}  // namespace

TEST_CASE("stops that the machine does not repeat are no effect", "[diagnosis]") {
    for (unsigned seed = 1; seed <= 3; ++seed) {
        const diagnosis::Diagnosis d = diagnosis::diagnose(bench(), read(bench(), 0.06, seed));
        INFO(seed << " " << said(d));
        CHECK(shared(d) > 0.8);
        for (const diagnosis::Cause& c : d.causes) CHECK(c.probability.value() < 0.5);
    }
}

TEST_CASE("a squareness is found beside stops that scatter", "[diagnosis]") {
    const setup::Setup real = bench("[effects]\n\"XY.squareness\" = { angle_rad = 4e-3 }\n");
    for (unsigned seed = 1; seed <= 3; ++seed) {
        const diagnosis::Diagnosis d = diagnosis::diagnose(bench(), read(real, 0.06, seed));
        INFO(seed << " " << said(d));
        CHECK(probability_of(d, "XY.squareness") > 0.5);
        for (const diagnosis::Cause& c : d.causes)
            CHECK((c.effect == "XY.squareness" || c.probability < 0.9));
    }
}

TEST_CASE("stops of a good machine share nothing", "[diagnosis]") {
    for (unsigned seed = 1; seed <= 3; ++seed) {
        const diagnosis::Diagnosis d = diagnosis::diagnose(bench(), read(bench(), 0.0, seed));
        INFO(seed << " " << said(d));
        CHECK(shared(d) == 0.0);
        CHECK(d.verdict == diagnosis::Verdict::no_gap);
    }
}

}  // namespace trunnion
