// The layers `text` and `words`: what is written, in the main programs and in all that they call.
#pragma once

#include <memory>

#include "regression/describe.h"
#include "regression/recorded_run.h"

namespace trunnion::regression {

/// One side: its main program, and what its run opened (empty where nothing can be called).
struct WrittenSide {
    const interpreter::ProgramText* main = nullptr;
    const std::vector<OpenedProgram>* opened = nullptr;
    const setup::Setup* setup = nullptr;
};

/// The keys of one program in a layer, text or words.
std::unique_ptr<LineKeys> written_keys(const interpreter::ProgramText& program, Layer layer,
                                       const setup::Setup& setup);

/// True when all programs are written alike in that layer; then, on one setup, both runs are the
/// same.
bool written_alike(Layer layer, const WrittenSide& a, const WrittenSide& b,
                   std::uint64_t& compared);

/// Adds a difference for each stretch that is written differently.
void describe_written(Layer layer, const WrittenSide& a, const WrittenSide& b, std::size_t most,
                      Comparison& result);

}  // namespace trunnion::regression
