// A program with the machine's known errors taken out of its positions.
#pragma once

#include <string>
#include <vector>

#include "emulator/run.h"

namespace trunnion {

struct CompensationOptions {
    double tolerance_mm = 5e-5;  ///< deviation of the path between the points that are met exactly
    int decimals = 6;            ///< of the words written
};

/// One motion block of the program written.
struct CompensatedBlock {
    int line = 0;                          ///< of the original
    Vector3 meant_W_mm = Vector3::Zero();  ///< tip at its end, as the control believed it
};

struct CompensatedProgram {
    std::string program;  ///< flat: what the original executed, without loops and calls
    std::vector<CompensatedBlock> blocks;
    RunResult original, executed;  ///< of the original and of the program written
    double worst_before_mm = 0.0;  ///< largest tip error at a block's end of the original
    double worst_after_mm = 0.0;   ///< the same for the program written, executed
    std::vector<std::string> notes;
};

/// Executes the program on the setup's control and writes, for each move, axis words that put the
/// physical tip (errors and effects of the setup) where the control believed the tip to be. Rotary
/// axes keep their positions. Lines and arcs stay lines and arcs, split where one does not hold the
/// tolerance; moves under G43.4, and arcs in inclined planes, become short lines. Throws InputError
/// for programs that measure (G31) and for machines without X, Y and Z.
CompensatedProgram compensate_program(const Setup& setup, ProgramSource& programs,
                                      const ProgramChoice& program, const EffectModels& effects,
                                      const CompensationOptions& options = {});

}  // namespace trunnion
