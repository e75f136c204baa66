// Runs the four programs of programs/pivot and turns what they print into maps.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "pivot/pivot_maps.h"
#include "effects/settings.h"
#include "interpreter/program_folders.h"
#include "emulator/run.h"
#include "base/alarm.h"
#include "base/units.h"

namespace trunnion {

namespace {

const Artefact& sphere_of(const Setup& setup) {
    for (const Artefact& artefact : setup.artefacts)
        if (artefact.kind == Artefact::Kind::sphere) return artefact;
    throw InputError("no [[artefact]] of kind \"sphere\" to probe", {setup.path});
}

/// What an operator would enter before the programs: #500-#506 of programs/pivot/common.nc.
std::map<int, double> operator_data(const Setup& setup) {
    if (!setup.probe) throw InputError("no [probe] to measure with", {setup.path});
    const Artefact& sphere = sphere_of(setup);
    const AxisGeometry* z = setup.machine.chain.find(Axis::Z);
    std::map<int, double> data{
        {500, sphere.center_W_mm.x()},        {501, sphere.center_W_mm.y()},
        {502, sphere.center_W_mm.z()},        {503, sphere.diameter_mm},
        {504, setup.probe->ball_diameter_mm}, {506, setup.probe->tool > 0 ? setup.probe->tool : 1}};
    if (z && z->max) data[505] = *z->max - 20.0;
    return data;
}

std::string print_of(const Setup& setup, ProgramFolders& programs, int program,
                     const RunOptions& options) {
    const RunLog log = run_program(setup, programs, program, options);
    if (log.result.alarm) throw *log.result.alarm;
    return log.printed;
}

void add_expected(const PivotStores& stores, const Vector3& sphere_W_mm, PivotMap& map) {
    for (PivotArc& arc : map.arcs) {
        std::vector<PivotPoint> expected = arc.points;
        for (PivotPoint& p : expected)
            p.error_mm = expected_error_mm(stores, arc.store == "G54", sphere_W_mm,
                                           rad_from_deg(p.b_deg), rad_from_deg(p.c_deg));
        arc.expected_radius_mm = fit_arc_radius_mm(expected, map.moving);
    }
}

double worst_um(const std::vector<PivotMap>& maps, const std::string& store) {
    double worst = 0.0;
    for (const PivotMap& map : maps)
        for (const PivotArc& arc : map.arcs)
            for (const PivotPoint& p : arc.points)
                if (arc.store == store) worst = std::max(worst, um_from_mm(p.error_mm.norm()));
    return worst;
}

std::string sentence(const PivotStores& s, const std::vector<PivotMap>& maps) {
    const Vector3 apart_um = 1e3 * (s.g54 - s.p - s.d);
    const std::string off = fmt::format(
        "G54.2 and DPP parts are off by up to {:.1f} µm, G43.4 and tilted-plane parts by up to "
        "{:.1f} µm.",
        worst_um(maps, "G54"), worst_um(maps, "P1970x"));
    // The step from B to C is seen by 1970x alone; G54 takes the axes to meet in one point.
    const Vector3 step_um = 1e3 * (s.d - s.d_true);
    if (apart_um.norm() < 0.05 && step_um.norm() < 0.05) return "G54 and P1970x agree; " + off;
    return fmt::format(
        "G54 and P1970x disagree by ({:.1f}, {:.1f}, {:.1f}) µm in sum, and the step from B to C "
        "in P1970x is "
        "off by ({:.1f}, {:.1f}, {:.1f}) µm; {}",
        apart_um.x(), apart_um.y(), apart_um.z(), step_um.x(), step_um.y(), step_um.z(), off);
}

}  // namespace

PivotDemonstration demonstrate_pivot(const Setup& setup,
                                     const std::vector<std::string>& program_folders,
                                     unsigned long long seed) {
    PivotDemonstration demo;
    demo.stores = pivot_stores(setup);
    ProgramFolders programs(program_folders);
    RunOptions options;
    options.variables = operator_data(setup);
    options.effects = active_models(setup);
    std::string printed;
    for (std::size_t k = 0; k < pivot_functions.size(); ++k) {
        options.seed = 4 * seed + k;  // each program gets its own repeatability
        printed += print_of(setup, programs, pivot_functions[k].program, options);
    }
    demo.maps = parse_pivot_prints(printed);
    for (PivotMap& map : demo.maps) add_expected(demo.stores, sphere_of(setup).center_W_mm, map);
    demo.verdict = sentence(demo.stores, demo.maps);
    return demo;
}

}  // namespace trunnion
