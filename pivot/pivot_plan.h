// Positions of the rotary axes in the four-function test of a machine.
#pragma once

#include <string>
#include <vector>

#include "setup/program_language.h"
#include "setup/right_stores.h"
#include "setup/setup.h"

namespace trunnion::pivot {

/// The two groups of stores that define the rotary axes for a positioning function.
enum class PivotGroup : unsigned char { g54, p1970x };
std::string name_of(PivotGroup group);  ///< "G54", "P1970x"

/// A positioning function, in the order of the paper.
struct PivotFunction {
    std::string name;  ///< DPP, RTDFO, RTCP, TW
    PivotGroup group = PivotGroup::g54;
    int program = 0;  ///< O number
};
const std::vector<PivotFunction>& pivot_functions();
/// nullptr for an unknown name.
const PivotFunction* find_pivot_function(std::string_view name);

/// One error map: an arc of one rotary axis, the other at rest. First and second as in 19681,
/// 19686.
struct PlannedMap {
    bool first_moves = true;
    double fixed_deg = 0.0, start_deg = 0.0, step_deg = 15.0;
    int count = 0;
    bool turns_table_only = false;  ///< functions of G54 take part: the head is at zero

    double first_deg(int k) const { return first_moves ? start_deg + step_deg * k : fixed_deg; }
    double second_deg(int k) const { return first_moves ? fixed_deg : start_deg + step_deg * k; }
};

/// Input of the programs for one machine.
struct PivotPlan {
    setup::RotaryStores stores;  ///< active
    std::vector<PivotFunction> functions;
    std::vector<PlannedMap> maps;  ///< those of the G54 functions last
    setup::ProgramLanguage language = setup::ProgramLanguage::fanuc;
    Vector3 sphere_mm = Vector3::Zero();  ///< approximate, rotary axes at zero, machine coordinates
                                          ///< of the stylus ball
    double sphere_diameter_mm = 25.4, ball_diameter_mm = 6.0;
    double safe_z_mm = 450.0;
    int tool_offset = 1;

    Axis first() const { return stores.pivot.first.axis; }
    Axis second() const { return stores.pivot.second.axis; }
    /// Number (from 1) of the first map of a function; 0 when it has none.
    int first_map(const PivotFunction& function) const;
};

/// Arcs of the tilting axis with the rotating axis at 0, 90 and 180 degrees, and one arc of the
/// rotating axis, limited to the travel of all axes. Throws InputError when 19680-19690 do not
/// describe two real rotary axes, when the setup has no probe or sphere, or when no arc reaches the
/// sphere.
PivotPlan plan_pivot_test(const setup::Setup& setup);

}  // namespace trunnion::pivot
