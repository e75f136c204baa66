// Compensation of a program for the known errors of the machine.
#pragma once

#include <string>
#include <vector>

#include "emulator/run.h"
#include "emulator/trace.h"

namespace trunnion::compensation {

struct CompensationOptions {
    double tolerance_mm = 5e-5;  ///< deviation of the path between the points that are met exactly
    int decimals = 6;            ///< of the words written
    double largest_turn_rad = 2e-3;  ///< maximum correction of a rotary axis; 0: none
    Budget budget = {};              ///< for each of the two runs; when used up, no program is
                                     ///< written
};

/// One motion block of the compensated program.
struct CompensatedBlock {
    /// in_gap: an axis ends inside its gap. past_gap: it first passes through the gap where nothing
    /// is cut.
    enum class End : unsigned char { exact, in_gap, past_gap };
    int line = 0;                  ///< of the original program
    int written_line = 0;          ///< in the compensated program
    emulator::BelievedTool meant;  ///< believed tool at its end
    bool turned = false;           ///< the rotary axes correct the tool direction
    End end = End::exact;
};

struct CompensatedProgram {
    std::string program;  ///< flat: the executed blocks of the original, without loops and calls
    std::vector<CompensatedBlock> blocks;
    BudgetLimit limit = BudgetLimit::none;     ///< the limit that ended the work; `program` is then
                                               ///< empty
    controller::RunResult original, executed;  ///< of the original and of the compensated program
    /// Largest errors at block ends: tip position; tool direction where the rotary axes correct it;
    /// tool direction where they keep their words.
    struct Worst {
        double tip_mm = 0.0, turned_rad = 0.0, kept_rad = 0.0;
        void include(const Worst& other);
    };
    Worst before;  ///< of the original program
    Worst after;   ///< of the compensated program
    Worst in_gap;  ///< the same where an axis has reversed and is still inside its gap
    std::vector<std::string> notes;
};

/// Executes the program on the setup's control. Writes, for each move, axis words that put the
/// physical tip (with errors and effects of the setup) on the believed tip. Tool direction: under
/// tool centre point control and where rotary axes turn, both rotary axes also correct it.
/// Elsewhere (three axes, positioned planes with possibly clamped axes) they keep their words, and
/// the error of the direction remains. Backlash follows the motion of the corrected axes, in
/// program order: TipCorrector::corrected. Lines and arcs remain lines and arcs, divided where
/// necessary for the tolerance. Moves under G43.4, and arcs in inclined planes, become short lines.
/// Cycles become their single moves; tapping gives a note. G31 is written with a corrected target
/// if the program never reads the touched position. Throws InputError for programs that read it
/// (their continuation cannot be written in advance) and for machines without X, Y and Z.
CompensatedProgram compensate_program(const setup::Setup& setup,
                                      interpreter::ProgramSource& programs,
                                      const emulator::ProgramChoice& program,
                                      const emulator::EffectModels& effects,
                                      const CompensationOptions& options = {});

}  // namespace trunnion::compensation
