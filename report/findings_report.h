// Findings of `check` in every form they can be written in.
#pragma once

#include <string>
#include <vector>

#include "base/read_file.h"
#include "check/check.h"

namespace trunnion::report {

/// format: text, json, junit, sarif, github; throws InputError for another. `files` are all that
/// were looked at: a JUnit case each; `inputs` stand in the JSON.
std::string format_findings(const std::vector<check::Finding>& findings,
                            const std::vector<std::string>& files, const std::string& format,
                            const std::vector<FileRead>& inputs = {});

}  // namespace trunnion::report
