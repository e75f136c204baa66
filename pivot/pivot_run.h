// Runs the programs of the four-function test on the emulated control and machine.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "pivot/pivot_prints.h"
#include "pivot/pivot_verdict.h"

namespace trunnion::pivot {

/// Result of a simulated test; the simulator knows the machine and thus the correct stores.
struct PivotDemonstration {
    PivotPlan plan;
    std::string printed;             ///< output of all programs, in their order
    std::vector<PivotMap> maps;      ///< expected: by the actual machine
    PivotVerdict verdict;            ///< from the prints only
    setup::RotaryStores true_right;  ///< correct values of the stores
};

/// The maps predicted by a known machine, computed without running a program.
std::vector<PivotMap> modelled_maps(const PivotPlan& plan, const kinematics::Machine& machine,
                                    const Vector3& tip_S_mm);

/// Runs `programs` (by file name, as written by pivot_programs) on the setup; `folders` contain
/// O8100. Throws Alarm with position when a program raises one, InputError when the machine is
/// unsuitable.
PivotDemonstration demonstrate_pivot(const setup::Setup& setup,
                                     const std::map<std::string, std::string>& programs,
                                     const std::vector<std::string>& folders,
                                     unsigned long long seed);

}  // namespace trunnion::pivot
