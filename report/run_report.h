// A run as JSON and as text.
#pragma once

#include <string>
#include <vector>

#include "base/read_file.h"
#include "emulator/run.h"

namespace trunnion::report {

/// trunnion.run/1, one object; `programs`: the files that the run read, with their SHA-256;
/// `inputs`: all files that it read, the setup among them.
std::string run_json(const emulator::RunLog& log, const std::vector<kinematics::AxisGeometry>& axes,
                     const std::vector<interpreter::ProgramText>& programs,
                     const std::vector<FileRead>& inputs = {});
/// One line: status, blocks, moves, time, path.
std::string run_summary(const emulator::RunLog& log);
/// "#100 = 1.5" lines; a vacant variable has no value.
std::string variables_text(const emulator::RunLog& log);

}  // namespace trunnion::report
