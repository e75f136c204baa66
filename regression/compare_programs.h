// Compares the machining of two programs, in layers from the text to its result.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "interpreter/program_source.h"
#include "regression/comparison.h"
#include "regression/recorded_run.h"
#include "setup/setup.h"

namespace trunnion::regression {

struct CompareOptions {
    Tolerances tolerances;
    std::optional<Layer> by;  ///< empty: from the top until one layer is equal
    std::vector<std::string> program_folders;
    std::size_t most_differences = 1000;
    std::uint64_t max_blocks = 0;
    std::string call;      ///< both programs are called by this block ("G65 P9814 D25.4")
    bool devices = false;  ///< the setups' probes and artefacts answer G31
    std::function<bool()> go_on = {};  ///< false, from any thread, ends a run as a limit
};

/// Compares two programs on one or two setups (the same object: one). Errors in NC programs are
/// results. Without `by` the layers are text, words, blocks, then path and functions (only these if
/// the setups differ); effects and functions if neither program moves anything. If both stop with
/// the same alarm, the words show the change.
Comparison compare_programs(const interpreter::ProgramText& a, const setup::Setup& setup_a,
                            const interpreter::ProgramText& b, const setup::Setup& setup_b,
                            const CompareOptions& options);

/// A recorded path (a golden) against a program, in the layer `path`.
Comparison compare_with_golden(const PathRecord& golden, const std::string& golden_path,
                               const interpreter::ProgramText& program, const setup::Setup& setup,
                               const CompareOptions& options);

}  // namespace trunnion::regression
