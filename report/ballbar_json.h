// The single-set-up ballbar procedure as JSON.
#pragma once

#include <string>
#include <vector>

#include "ballbar/test/ballbar_procedure.h"
#include "base/read_file.h"

namespace trunnion::report {

/// `{"schema":"trunnion.ballbar/1",...}` of formats.md.
std::string ballbar_json(const ballbar::test::BallbarResult& result,
                         const std::vector<FileRead>& inputs = {});

}  // namespace trunnion::report
