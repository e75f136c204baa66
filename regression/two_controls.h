// Compares the motion of one program on two controls.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "controller/controller.h"

namespace trunnion::regression {

/// A control that reads the program: its configuration and its stores.
struct ControlReading {
    std::string name;  ///< for messages
    controller::ControlConfig config;
    offsets::Stores stores;
};

struct ReadingDifference {
    std::string program;
    int line = 0, column = 0;  ///< from 1, column 0: the whole block
    std::string text;
    double apart = 0.0;  ///< mm or deg, of the axis that differs most; 0 when only one control
                         ///< continues
};

/// Subprograms, opened again for each run.
using OpenPrograms = std::function<std::unique_ptr<interpreter::ProgramSource>()>;

/// Runs the program on both controls without devices and compares block by block. Reported are: a
/// block that changes the difference of the axis positions by more than 0.0001 mm or deg; a block
/// with equal ends whose moves (all those of a cycle) differ by more than 0.001 at three places of
/// their way, or are rapid on one control only; an alarm of one control only; a
/// block after which they execute different blocks, where the comparison ends. A permanent
/// difference (e.g. of a tool length) is reported where it starts.
std::vector<ReadingDifference> compare_controls(const ControlReading& a, const ControlReading& b,
                                                const interpreter::ProgramText& program,
                                                const OpenPrograms& programs);

}  // namespace trunnion::regression
