// Heights over a surface that was clamped once: they are surface minus axis.
#include <algorithm>
#include <catch2/catch.hpp>
#include <random>

#include "diagnosis/diagnosis.h"
#include "tests/support/said.h"

namespace trunnion {
namespace {

setup::Setup printer() {
    std::vector<std::string> notes;
    return setup::parse_setup(
        "[machine]\nname = \"m\"\nchain = \"w b X Y Z t\"\n"
        "[[artefact]]\nname = \"nozzle\"\nkind = \"target\"\ntool_mm = [0, 0, 0]\n"
        "[[instrument]]\nname = \"probe\"\nframe = \"W\"\nfree = [\"pose\"]\n"
        "[model]\nmodelled = []\nnoise_um = { point = 3 }\n",
        "s.toml", notes);
}

/// A mesh of 6 x 6 heights over a bed that is bowed along X; `all`: the points in three directions,
/// as a tracker reads a target.
records::ReadingTable mesh(bool all) {
    std::mt19937_64 engine(3);
    std::normal_distribution<double> noise_mm(0.0, 0.003);
    records::ReadingTable table;
    table.path = "mesh.csv";
    table.axes = {Axis::X, Axis::Y, Axis::Z};
    for (int k = 0; k < 36; ++k)
        for (int d = all ? 0 : 2; d < 3; ++d) {
            records::Reading row;
            row.index = static_cast<int>(table.rows.size());
            row.time_s = 60.0 * k;
            row.test = "mesh";
            row.device = records::Device::point;
            row.feature = "nozzle";
            row.instrument = "probe";
            row.direction_M = Vector3::Unit(d);
            row.commanded[Axis::X] = 40.0 * (k % 6);
            row.commanded[Axis::Y] = 40.0 * (k / 6);
            const double u = (k % 6) / 2.5 - 1.0;
            const double off_mm[] = {0.0, 0.0, 0.06 * u * u};
            row.value_mm = off_mm[d] + noise_mm(engine);
            table.rows.push_back(row);
        }
    table.optional_columns = {"instrument"};
    return table;
}

const diagnosis::Cause* bow_of_x(const diagnosis::Diagnosis& d) {
    for (const diagnosis::Cause& c : d.causes)
        if (c.effect == "X.straightness") return &c;
    return nullptr;
}

}  // namespace

TEST_CASE("the bed under a probe is a rival of the axis over it", "[diagnosis]") {
    diagnosis::DiagnosisOptions options;
    options.plan_next = false;
    for (const bool all : {false, true}) {
        const diagnosis::Diagnosis d = diagnosis::diagnose(printer(), mesh(all), options);
        INFO(all << ": " << said(d));
        const diagnosis::Cause* bow = bow_of_x(d);
        REQUIRE(bow);
        const bool rivalled =
            std::find(bow->rivals.begin(), bow->rivals.end(), "artefact.form") != bow->rivals.end();
        CHECK(rivalled != all);
        CHECK((bow->probability <= 0.5) != all);
        CHECK((d.verdict == diagnosis::Verdict::ambiguous || all));
        CHECK((bow->what.find("measured surface") != std::string::npos) != all);
    }
}

}  // namespace trunnion
