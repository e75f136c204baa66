// Findings of `check` in every form they can be written in.
#pragma once

#include <string>
#include <vector>

#include "check/check.h"

namespace trunnion::report {

/// format: text, json, junit, sarif, github; throws InputError for any other. `files`: all files
/// that were checked, each a JUnit case.
std::string format_findings(const std::vector<check::Finding>& findings,
                            const std::vector<std::string>& files, const std::string& format);

}  // namespace trunnion::report
