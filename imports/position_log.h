// Positions logged by a control while it ran a program: a trace, a servo log, readings.
#pragma once

#include <string>
#include <string_view>

#include "records/position_log.h"
#include "setup/setup.h"

namespace trunnion::imports {

/// Reads any table with a column for each axis (`x_mm`, `X cmd [mm]`, `B actual`): commanded
/// positions if present, else actual ones. `line`, `block`, `N` give the block of a row, `program`
/// its program; with a column `motion` all rows except SAMPLE are ends of moves. Throws InputError
/// (path, line, column) for a table without positions, an axis that the machine lacks, a block that
/// is not an integer, or times that run backwards. The text need not outlive the log.
records::PositionLog read_position_log(std::string_view text, const std::string& path,
                                       const setup::Setup& setup);

}  // namespace trunnion::imports
