// Error maps of the four positioning functions: what pivot 2021 measures, from printed results.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "setup/setup.h"
#include "geometry/axes.h"
#include "geometry/pose.h"

namespace trunnion {

/// The positioning functions in the paper's order, and the store each takes the pivot from.
struct PivotFunction {
    std::string name;   ///< DPP, RTDFO, RTCP, TW
    std::string store;  ///< "G54" or "P1970x"
    int program = 0;    ///< O number in programs/pivot
};
extern const std::vector<PivotFunction> pivot_functions;

/// One indexation: found minus expected sphere centre along X Y Z of M, the sphere zeroed at B0 C0.
struct PivotPoint {
    double b_deg = 0.0, c_deg = 0.0;
    Vector3 error_mm = Vector3::Zero();
};

/// One arc measured with one function.
struct PivotArc {
    std::string function, store;
    std::vector<PivotPoint> points;
    double radius_mm = 0.0;           ///< of the least-squares circle, see fit_arc_radius_mm
    double expected_radius_mm = 0.0;  ///< the same from the closed form
};

/// One error map: an arc of one axis, the other standing.
struct PivotMap {
    int number = 0;
    std::string name;
    Axis moving = Axis::B;
    Axis fixed = Axis::C;
    double fixed_deg = 0.0;
    std::vector<PivotArc> arcs;  ///< one for each function, in the order of pivot_functions
};

/// What the stores say and what is true, mm in M.
struct PivotStores {
    Vector3 g54 = Vector3::Zero();     ///< G54 + external
    Vector3 p = Vector3::Zero();       ///< 19700-19702
    Vector3 d = Vector3::Zero();       ///< 19703-19705
    Vector3 p_true = Vector3::Zero();  ///< point of the first rotary axis, location errors included
    Vector3 d_true = Vector3::Zero();  ///< from there to the point of the second
};

struct PivotDemonstration {
    PivotStores stores;
    std::vector<PivotMap> maps;
    std::string verdict;  ///< one plain sentence
};

/// Reads the stores of a setup whose table carries B, then C. Throws InputError for any other
/// machine.
PivotStores pivot_stores(const Setup& setup);

/// Found minus expected centre of a sphere that stands at `sphere_W_mm` and was zeroed at home;
/// `g54` picks the closed form e_G (DPP, RTDFO) or e_P (RTCP, TW) of docs/notation.md. Axes need
/// not intersect. Angles as commanded, table axes turning against the tool as in
/// machines/bc_table.toml.
Vector3 expected_error_mm(const PivotStores& stores, bool g54, const Vector3& sphere_W_mm,
                          double b_rad, double c_rad);

/// Radius of the least-squares circle on which an error turns with the moving axis: the errors in
/// the plane normal to it are fitted by centre + R(theta) * vector with theta known.
double fit_arc_radius_mm(const std::vector<PivotPoint>& points, Axis moving);

/// Maps from what the four programs printed (lines "DPP MAP1 B.. C.. X.. Y.. Z.."), in any order.
std::vector<PivotMap> parse_pivot_prints(std::string_view printed);

/// Runs the four programs of programs/pivot on the setup's control and machine.
/// Throws Alarm with its place when a program alarms, InputError when the machine does not suit.
PivotDemonstration demonstrate_pivot(const Setup& setup,
                                     const std::vector<std::string>& program_folders,
                                     unsigned long long seed);

}  // namespace trunnion
