// check --against: the same setup with another control, option or parameter.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "check/check.h"
#include "interpreter/program_source.h"
#include "setup/setup.h"

namespace trunnion::cli {

/// "hurco", "hurco-bnc", "fanuc", "16i", "30i", "0i-F", a row of choices/choice_table.h
/// ("tcp_frame=start", "5006#6=1"), a parameter "5006=64", or the path of a setup. Throws
/// InputError for anything else.
setup::Setup other_reading(const setup::Setup& setup, const std::string& what);
/// Another reading, and its name in findings.
struct OtherReading {
    const setup::Setup& setup;
    const std::string& name;
};
/// What ends a run of `check`; `go_on` is asked every few thousand blocks.
struct RunLimits {
    std::uint64_t max_blocks = 10'000'000;
    std::function<bool(std::uint64_t blocks)> go_on;
};
/// Findings of rule "reading": blocks of the program that would move differently on `other`.
std::vector<check::Finding> differences_against(const setup::Setup& setup,
                                                const OtherReading& other,
                                                const interpreter::ProgramText& program,
                                                const std::vector<std::string>& folders,
                                                const RunLimits& limits);

}  // namespace trunnion::cli
