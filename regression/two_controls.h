// One program on two controls: where would it move differently?
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "controller/controller.h"

namespace trunnion::regression {

/// A way to read programs: what the control is and what its stores hold.
struct ControlReading {
    std::string name;  ///< for messages
    controller::ControlConfig config;
    offsets::Stores stores;
};

struct ReadingDifference {
    std::string program;
    int line = 0, column = 0;  ///< from 1, column 0: the whole block
    std::string text;
    double apart = 0.0;  ///< mm or deg, the axis that differs most; 0 where only one moves on
};

/// Subprograms, opened anew for each run.
using OpenPrograms = std::function<std::unique_ptr<interpreter::ProgramSource>()>;

/// Runs the program on both without devices and goes through their blocks side by side. Told are:
/// a block after which the axes stand apart otherwise than before it, by more than 0.0001 mm or
/// deg; one whose move ends alike but is elsewhere half way, by more than 0.001; an alarm of one
/// control alone; a place from which they run other blocks, where the comparison ends. A difference
/// that stays (a tool length, say) is told where it arises.
std::vector<ReadingDifference> compare_controls(const ControlReading& a, const ControlReading& b,
                                                const interpreter::ProgramText& program,
                                                const OpenPrograms& programs);

}  // namespace trunnion::regression
