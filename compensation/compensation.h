// A program with the machine's known errors taken out of its positions.
#pragma once

#include <string>
#include <vector>

#include "emulator/run.h"
#include "emulator/trace.h"

namespace trunnion::compensation {

struct CompensationOptions {
    double tolerance_mm = 5e-5;  ///< deviation of the path between the points that are met exactly
    int decimals = 6;            ///< of the words written
    double largest_turn_rad = 2e-3;  ///< a rotary axis is turned by at most this; 0: never
    Budget budget = {};              ///< of each of the two runs; used up: no program is written
};

/// One motion block of the program written.
struct CompensatedBlock {
    /// An axis may have to end inside its gap, or goes past it first where nothing is cut.
    enum class End : unsigned char { exact, in_gap, past_gap };
    int line = 0;                  ///< of the original
    int written_line = 0;          ///< of the program written
    emulator::BelievedTool meant;  ///< at its end, as the control believed it
    bool turned = false;           ///< the rotaries correct the tool's direction
    End end = End::exact;
};

struct CompensatedProgram {
    std::string program;  ///< flat: what the original executed, without loops and calls
    std::vector<CompensatedBlock> blocks;
    BudgetLimit limit = BudgetLimit::none;  ///< which one ended the work: `program` is empty then
    controller::RunResult original, executed;  ///< of the original and of the program written
    /// Largest errors at a block's end: of the tip; of the direction where the rotaries correct it;
    /// of the direction where they keep their words.
    struct Worst {
        double tip_mm = 0.0, turned_rad = 0.0, kept_rad = 0.0;
        void include(const Worst& other);
    };
    Worst before;  ///< of the original
    Worst after;   ///< of the program written, executed
    Worst in_gap;  ///< the same where an axis has turned round and is still inside its gap
    std::vector<std::string> notes;
};

/// Executes the program on the setup's control and writes, for each move, axis words that put the
/// physical tip (errors and effects of the setup) where the control believed the tip to be. Under
/// tool centre point control and where rotary axes turn, both of them also bring the tool into the
/// direction that the control believed; elsewhere (three axes, positioned planes, whose axes may be
/// clamped) they keep their words and the direction keeps its error. Backlash follows the way of
/// the corrected axes, in the order of the program: TipCorrector::corrected. Lines and arcs stay
/// lines and arcs, split where one does not hold the tolerance; moves under G43.4, and arcs in
/// inclined planes, become short lines. Cycles become the moves they are made of; tapping gets a
/// note. G31 goes out with a corrected target as long as the program never asks where it touched.
/// Throws InputError for programs that do (what they do next cannot be written beforehand) and for
/// machines without X, Y and Z.
CompensatedProgram compensate_program(const setup::Setup& setup,
                                      interpreter::ProgramSource& programs,
                                      const emulator::ProgramChoice& program,
                                      const emulator::EffectModels& effects,
                                      const CompensationOptions& options = {});

}  // namespace trunnion::compensation
