// The layers `text` and `words`: the text of the main programs and of all called programs.
#pragma once

#include <memory>

#include "regression/describe.h"
#include "regression/recorded_run.h"

namespace trunnion::regression {

/// One side: its main program, and the programs opened by its run (empty if it cannot call any).
struct WrittenSide {
    const interpreter::ProgramText* main = nullptr;
    const std::vector<OpenedProgram>* opened = nullptr;
    const setup::Setup* setup = nullptr;
};

/// The keys of one program in a layer, text or words.
std::unique_ptr<LineKeys> written_keys(const interpreter::ProgramText& program, Layer layer,
                                       const setup::Setup& setup);

/// True when all programs are equal in that layer; on one setup both runs are then the same.
bool written_alike(Layer layer, const WrittenSide& a, const WrittenSide& b,
                   std::uint64_t& compared);

/// Adds a difference for each range that is written differently.
void describe_written(Layer layer, const WrittenSide& a, const WrittenSide& b, std::size_t most,
                      Comparison& result);

}  // namespace trunnion::regression
