// The main job end to end: NC programs on the emulated control find the closed forms, and the
// demonstration fails when belief is wrong in another way.
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "pivot/pivot_maps.h"
#include "base/alarm.h"
#include "base/units.h"

using namespace trunnion;

namespace {

const std::string root = TRUNNION_SOURCE_DIR;
const std::vector<std::string> folders{root + "/programs", root + "/programs/pivot"};

Setup machine_with(double repeatability_um) {
    std::vector<std::string> notes;
    Setup setup = load_setup(root + "/machines/bc_table.toml", notes);
    setup.probe->repeatability_um = repeatability_um;
    return setup;
}

void tell_truth(Setup& setup) {
    for (const Axis axis : {Axis::X, Axis::Y, Axis::Z}) setup.stores.work.standard[0][axis] = 0.0;
    for (int n = 19700; n <= 19705; ++n) setup.stores.parameters.set(n, 0.0);
}

/// Largest difference between measured and expected error of one store's functions, mm.
double worst_miss_mm(const PivotDemonstration& demo, const std::string& store) {
    const Vector3 sphere(120, 0, 80);
    double worst = 0.0;
    for (const PivotMap& map : demo.maps)
        for (const PivotArc& arc : map.arcs)
            for (const PivotPoint& p : arc.points)
                if (arc.store == store)
                    worst = std::max(
                        worst, (p.error_mm - expected_error_mm(demo.stores, store == "G54", sphere,
                                                               rad_from_deg(p.b_deg),
                                                               rad_from_deg(p.c_deg)))
                                   .norm());
    return worst;
}

double worst_error_mm(const PivotDemonstration& demo, const std::string& store) {
    double worst = 0.0;
    for (const PivotMap& map : demo.maps)
        for (const PivotArc& arc : map.arcs)
            for (const PivotPoint& p : arc.points)
                if (arc.store == store) worst = std::max(worst, p.error_mm.norm());
    return worst;
}

/// A copy of a program with one text replaced, in a folder of its own that is searched first.
std::vector<std::string> folders_with(const std::string& name, const std::string& from,
                                      const std::string& to) {
    std::ifstream in(root + "/programs/pivot/" + name);
    std::stringstream text;
    text << in.rdbuf();
    std::string program = text.str();
    REQUIRE(program.find(from) != std::string::npos);
    program.replace(program.find(from), from.size(), to);
    const auto folder =
        std::filesystem::temp_directory_path() / ("trunnion_pivot_" + std::to_string(::getpid()));
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    std::ofstream(folder / name) << program;
    std::vector<std::string> all{folder.string()};
    all.insert(all.end(), folders.begin(), folders.end());
    return all;
}

}  // namespace

TEST_CASE("noise-free probing finds the closed forms in all four functions") {
    const PivotDemonstration demo = demonstrate_pivot(machine_with(0.0), folders, 1);
    REQUIRE(demo.maps.size() == 4);
    CHECK(demo.maps[0].name == "B arc at C0");
    CHECK(demo.maps[3].name == "C arc at B0");
    for (const PivotMap& map : demo.maps) {
        REQUIRE(map.arcs.size() == 4);
        for (const PivotArc& arc : map.arcs) {
            CHECK(arc.points.size() == (map.number == 4 ? 24U : 13U));
            CHECK(std::abs(arc.radius_mm - arc.expected_radius_mm) < 1e-6);
        }
    }
    CHECK(worst_miss_mm(demo, "G54") < 1e-6);
    CHECK(worst_miss_mm(demo, "P1970x") < 1e-6);
    CHECK(worst_error_mm(demo, "G54") > 0.2);
}

TEST_CASE("told the truth all four functions find the sphere where they expect it") {
    Setup setup = machine_with(0.0);
    tell_truth(setup);
    const PivotDemonstration demo = demonstrate_pivot(setup, folders, 1);
    CHECK(worst_error_mm(demo, "G54") < 1e-6);
    CHECK(worst_error_mm(demo, "P1970x") < 1e-6);
    CHECK(demo.verdict.find("agree;") != std::string::npos);
}

TEST_CASE("with repeatability every radius is within three standard errors") {
    const double sigma_um = 0.5;
    const PivotDemonstration demo = demonstrate_pivot(machine_with(sigma_um), folders, 5);
    for (const PivotMap& map : demo.maps)
        for (const PivotArc& arc : map.arcs) {
            // Nine touches of known radius give a centre to sigma / sqrt(2.866) along X and Y, a
            // little better along Z. The error of zeroing turns with the table, so it enters the
            // radius whole; those of the indexations average out, on a half circle with a free
            // centre less.
            const auto n = static_cast<double>(arc.points.size());
            const double effective = map.moving == Axis::C ? n : n * (1.0 - 0.584 * 0.584);
            const double sigma_centre_um = sigma_um / std::sqrt(2.866);
            const double standard_error_um = sigma_centre_um * std::sqrt(1.0 + 1.0 / effective);
            CHECK(um_from_mm(std::abs(arc.radius_mm - arc.expected_radius_mm)) <
                  3.0 * standard_error_um);
            CHECK(arc.radius_mm != arc.expected_radius_mm);
        }
}

TEST_CASE("equal sums in both stores: C arcs agree, B arcs do not") {
    Setup setup = machine_with(0.0);
    const Vector3 sum(-0.07, 0.17, -0.01);  // 19700-19702 plus 19703-19705 of the shipped machine
    for (const Axis axis : {Axis::X, Axis::Y, Axis::Z})
        setup.stores.work.standard[0][axis] = sum[static_cast<Eigen::Index>(index_of(axis))];
    const PivotDemonstration demo = demonstrate_pivot(setup, folders, 1);
    CHECK(std::abs(demo.maps[3].arcs[0].radius_mm - demo.maps[3].arcs[2].radius_mm) < 1e-6);
    CHECK(std::abs(demo.maps[0].arcs[0].radius_mm - demo.maps[0].arcs[2].radius_mm) > 0.02);
    CHECK(worst_miss_mm(demo, "P1970x") < 1e-6);
}

TEST_CASE("the demonstration can fail: swapped stores") {
    Setup setup = machine_with(0.0);
    const PivotDemonstration right = demonstrate_pivot(setup, folders, 1);
    for (const Axis axis : {Axis::X, Axis::Y, Axis::Z}) {
        const int n = 19700 + static_cast<int>(index_of(axis));
        const double g54 = setup.stores.work.standard[0][axis];
        setup.stores.work.standard[0][axis] =
            setup.stores.parameters.get(n) + setup.stores.parameters.get(n + 3);
        setup.stores.parameters.set(n, g54);
        setup.stores.parameters.set(n + 3, 0.0);
    }
    PivotDemonstration swapped = demonstrate_pivot(setup, folders, 1);
    swapped.stores = right.stores;
    CHECK(worst_miss_mm(swapped, "G54") > 0.05);
    CHECK(worst_miss_mm(swapped, "P1970x") > 0.05);
}

TEST_CASE("the demonstration can fail: wrong sign of a rotary direction") {
    Setup setup = machine_with(0.0);
    setup.stores.parameters.set(19684, 0.0);  // B believed to turn the other way
    // So far off that the probe misses the sphere: the cycle's own alarm.
    CHECK_THROWS_AS(demonstrate_pivot(setup, folders, 1), Alarm);
}

TEST_CASE("the demonstration can fail: G54.2 reference angle off by one degree") {
    const auto off = folders_with("O8002.nc", "B0C0\n#591", "B0C1.\n#591");
    CHECK_THROWS_AS(demonstrate_pivot(machine_with(0.0), off, 1), Alarm);
    Setup near = machine_with(0.0);  // a sphere near the C axis: found, but elsewhere
    near.artefacts[0].center_W_mm = Vector3(20, 0, 80);
    const PivotDemonstration demo = demonstrate_pivot(near, off, 1);
    CHECK(std::abs(demo.maps[0].arcs[1].points[0].error_mm.y()) > 0.2);
    CHECK(worst_error_mm(demo, "P1970x") < 0.5);
}

TEST_CASE("a sphere out of reach and a probe that never touches are said") {
    Setup setup = machine_with(0.0);
    setup.artefacts[0].center_W_mm = Vector3(120, 0, 460);
    CHECK_THROWS_AS(demonstrate_pivot(setup, folders, 1), Alarm);
    setup = machine_with(0.0);
    setup.artefacts.clear();
    CHECK_THROWS_AS(demonstrate_pivot(setup, folders, 1), InputError);
}
