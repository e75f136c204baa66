// Runs the programs of the four-function test on the emulated control and machine.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "pivot/pivot_prints.h"
#include "pivot/pivot_verdict.h"

namespace trunnion::pivot {

/// What a simulated test led to; the simulator knows the machine, so it also knows what is right.
struct PivotDemonstration {
    PivotPlan plan;
    std::string printed;             ///< all programs, in their order
    std::vector<PivotMap> maps;      ///< expected: by the machine as it is
    PivotVerdict verdict;            ///< from the prints alone
    setup::RotaryStores true_right;  ///< what the stores had to hold
};

/// The maps that a known machine leads to, worked out without running a program.
std::vector<PivotMap> modelled_maps(const PivotPlan& plan, const kinematics::Machine& machine,
                                    const Vector3& tip_S_mm);

/// Runs `programs` (by file name, as pivot_programs writes them) on the setup; `folders` hold
/// O8100. Throws Alarm with its place when a program alarms, InputError when the machine does not
/// suit.
PivotDemonstration demonstrate_pivot(const setup::Setup& setup,
                                     const std::map<std::string, std::string>& programs,
                                     const std::vector<std::string>& folders,
                                     unsigned long long seed);

}  // namespace trunnion::pivot
