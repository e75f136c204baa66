#include "pivot/pivot_plan.h"

#include <algorithm>
#include <cmath>

#include "base/alarm.h"
#include "base/units.h"
#include "positioning/rotary_transform.h"

namespace trunnion::pivot {

std::string name_of(PivotGroup group) {
    return group == PivotGroup::g54 ? "G54" : "P1970x";
}

const std::vector<PivotFunction>& pivot_functions() {
    static const std::vector<PivotFunction> functions{{"DPP", PivotGroup::g54, 8001},
                                                      {"RTDFO", PivotGroup::g54, 8002},
                                                      {"RTCP", PivotGroup::p1970x, 8003},
                                                      {"TW", PivotGroup::p1970x, 8004}};
    return functions;
}

const PivotFunction* find_pivot_function(std::string_view name) {
    for (const PivotFunction& function : pivot_functions())
        if (function.name == name) return &function;
    return nullptr;
}

namespace {

constexpr double step_deg = 15.0;
constexpr double height_mm = 100.0;  ///< height of the tip above the sphere during its motion
constexpr double margin_mm = 5.0;    ///< distance to the travel limits
constexpr int fewest_points = 5;     ///< minimum for an arc

const setup::Artefact& sphere_of(const setup::Setup& setup) {
    for (const setup::Artefact& artefact : setup.artefacts)
        if (artefact.kind == setup::Artefact::Kind::sphere) return artefact;
    throw InputError("no [[artefact]] of kind \"sphere\" to probe", {setup.path});
}

setup::RotaryStores stores_of(const setup::Setup& setup) {
    const auto stores = setup::rotary_stores(setup.machine.chain, setup.stores);
    if (!stores)
        throw InputError(
            "pivot requires a control with two rotary axes (parameters 19680-19690); this one has "
            "none",
            {setup.path});
    if (stores->pivot.first.hypothetical || stores->pivot.second.hypothetical)
        throw InputError("pivot requires two real rotary axes; one of this control is hypothetical",
                         {setup.path});
    return *stores;
}

bool square(const offsets::PivotAxis& axis) {
    return axis.line.cwiseAbs().maxCoeff() > 1.0 - 1e-9;
}

/// No group 7580-7588 can describe rotation about an inclined axis. A Hurco has no G54.2, and its
/// tilted planes are programmed differently.
std::vector<PivotFunction> functions_of(const PivotPlan& plan) {
    const offsets::PivotParameters& pivot = plan.stores.pivot;
    const bool hurco = setup::is_hurco(plan.language);
    std::vector<PivotFunction> functions;
    for (const PivotFunction& f : pivot_functions()) {
        const bool table = pivot.unit != offsets::MechanicalUnit::tool_tool;
        const bool inclined = !square(pivot.first) || !square(pivot.second);
        if (f.group == PivotGroup::g54 && !table) continue;
        if (f.name == "RTDFO" && (inclined || hurco)) continue;
        if (f.name == "TW" && hurco) continue;
        functions.push_back(f);
    }
    return functions;
}

struct Planner {
    const setup::Setup& setup;
    const PivotPlan& plan;
    positioning::RotaryTransform transform;
    Vector3 tool_vector_mm;

    const kinematics::AxisGeometry* geometry(bool first) const {
        return setup.machine.chain.find(first ? plan.first() : plan.second());
    }
    bool within(bool first, double angle_deg) const {
        const kinematics::AxisGeometry* axis = geometry(first);
        const double angle = rad_from_deg(angle_deg);
        return !axis ||
               ((!axis->min || angle >= *axis->min) && (!axis->max || angle <= *axis->max));
    }
    /// True when X Y Z are within travel for the tip `above_mm` above the sphere along the tool.
    bool reaches(const AxisPositions& turned, double above_mm) const {
        const Vector3 n_W = transform.tool_direction_W(turned);
        const AxisPositions q =
            transform.machine_for_tip(plan.sphere_mm + above_mm * n_W, turned, tool_vector_mm);
        return std::all_of(all_axes.begin(), all_axes.begin() + 3, [&](Axis letter) {
            const kinematics::AxisGeometry* axis = setup.machine.chain.find(letter);
            return !axis || ((!axis->min || q[letter] >= *axis->min + margin_mm) &&
                             (!axis->max || q[letter] <= *axis->max - margin_mm));
        });
    }
    bool possible(double first_deg, double second_deg) const {
        if (!within(true, first_deg) || !within(false, second_deg)) return false;
        AxisPositions turned;
        turned[plan.first()] = rad_from_deg(first_deg);
        turned[plan.second()] = rad_from_deg(second_deg);
        return reaches(turned, 0.0) && reaches(turned, height_mm);
    }
    /// The arc reduced to its longest reachable part.
    PlannedMap cut(PlannedMap map) const {
        int best_start = 0, best = 0;
        for (int k = 0, run = 0; k < map.count; ++k) {
            run = possible(map.first_deg(k), map.second_deg(k)) ? run + 1 : 0;
            if (run > best) best = run, best_start = k - run + 1;
        }
        map.start_deg += map.step_deg * best_start;
        map.count = best;
        return map;
    }
    PlannedMap arc(bool first_moves, double fixed_deg, double from_deg, double to_deg) const {
        PlannedMap map;
        map.first_moves = first_moves;
        map.fixed_deg = fixed_deg;
        map.start_deg = from_deg;
        map.step_deg = step_deg;
        map.count = static_cast<int>(std::lround((to_deg - from_deg) / step_deg)) + 1;
        return cut(map);
    }
};

bool along_tool(const offsets::PivotParameters& pivot, const offsets::PivotAxis& axis) {
    return axis.line.cross(pivot.tool_direction).norm() < 1e-9;
}

std::vector<PlannedMap> maps_of(const Planner& planner) {
    const offsets::PivotParameters& pivot = planner.plan.stores.pivot;
    // The axis parallel to the tool rotates, the other one tilts; if both tilt, the second counts
    // as rotating.
    const bool first_tilts = !along_tool(pivot, pivot.first);
    std::vector<PlannedMap> maps;
    for (const double fixed_deg : {0.0, 90.0, 180.0}) {
        const bool there = planner.within(!first_tilts, fixed_deg);
        maps.push_back(planner.arc(first_tilts, there ? fixed_deg : -0.5 * fixed_deg, -90.0, 90.0));
    }
    const bool round = planner.within(!first_tilts, 345.0);
    maps.push_back(planner.arc(!first_tilts, 0.0, round ? 0.0 : -90.0, round ? 345.0 : 90.0));
    std::erase_if(maps, [](const PlannedMap& map) { return map.count < fewest_points; });
    for (PlannedMap& map : maps)
        map.turns_table_only = pivot.unit == offsets::MechanicalUnit::table_table ||
                               (pivot.unit == offsets::MechanicalUnit::mixed && !map.first_moves &&
                                map.fixed_deg == 0.0);
    return maps;
}

}  // namespace

int PivotPlan::first_map(const PivotFunction& function) const {
    for (std::size_t m = 0; m < maps.size(); ++m)
        if (function.group == PivotGroup::p1970x || maps[m].turns_table_only)
            return static_cast<int>(m) + 1;
    return 0;
}

PivotPlan plan_pivot_test(const setup::Setup& setup) {
    if (!setup.probe) throw InputError("no [probe] to measure with", {setup.path});
    PivotPlan plan;
    plan.stores = stores_of(setup);
    plan.language = setup::language_of(setup);
    const setup::Artefact& sphere = sphere_of(setup);
    plan.sphere_mm = sphere.center_W_mm;
    plan.sphere_diameter_mm = sphere.diameter_mm;
    plan.ball_diameter_mm = setup.probe->ball_diameter_mm;
    plan.tool_offset = setup.probe->tool > 0 ? setup.probe->tool : 1;
    if (const kinematics::AxisGeometry* z = setup.machine.chain.find(Axis::Z); z && z->max)
        plan.safe_z_mm = *z->max - 20.0;
    plan.functions = functions_of(plan);
    const double length_mm =
        setup.stores.tools.tool[static_cast<std::size_t>(plan.tool_offset)].length_mm();
    const Planner planner{setup, plan, positioning::RotaryTransform(plan.stores.pivot),
                          length_mm * plan.stores.pivot.tool_direction};
    plan.maps = maps_of(planner);
    std::erase_if(plan.functions, [&](const PivotFunction& f) { return plan.first_map(f) == 0; });
    if (plan.maps.empty())
        throw InputError(
            "the sphere stands where no arc of the rotary axes keeps the linear axes within their "
            "travel",
            {setup.path});
    return plan;
}

}  // namespace trunnion::pivot
