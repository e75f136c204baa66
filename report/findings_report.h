// Findings of `check` in every form they can be written in.
#pragma once

#include <string>
#include <vector>

#include "base/read_file.h"
#include "check/check.h"

namespace trunnion::report {

/// `format`: text, json, junit, sarif or github; throws InputError for any other. `files`: all that
/// were checked, one JUnit case each. `inputs` are listed in the JSON.
std::string format_findings(const std::vector<check::Finding>& findings,
                            const std::vector<std::string>& files, const std::string& format,
                            const std::vector<FileRead>& inputs = {});

}  // namespace trunnion::report
