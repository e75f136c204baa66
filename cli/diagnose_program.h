// diagnose --program: the gap between a control's log of a program and the emulated control.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cli/page_options.h"

namespace trunnion::cli {

struct ProgramDiagnosis {
    std::string log, setup, program, out;
    std::vector<std::string> folders;
    std::uint64_t max_blocks = 10'000'000;
    PageOptions page;
    const CLI::App* command = nullptr;
    double limit_um = -1.0;  ///< negative: no limit
    bool json = false;
};

int diagnose_program(const ProgramDiagnosis& options);

}  // namespace trunnion::cli
