// Positions that a control logged while it ran a program: a trace, a servo log, readings.
#pragma once

#include <string>
#include <string_view>

#include "records/position_log.h"
#include "setup/setup.h"

namespace trunnion::imports {

/// Reads any table with a column for each axis (`x_mm`, `X cmd [mm]`, `B actual`): commanded
/// positions where there are some, else actual ones. `line`, `block`, `N` tell the block of a row,
/// `program` its program; a column `motion` says which rows are ends of moves: all but SAMPLE rows.
/// Throws InputError (path, line, column) for a table without positions, an axis that the machine
/// lacks, a block that is no whole number. The text need not outlive the log.
records::PositionLog read_position_log(std::string_view text, const std::string& path,
                                       const setup::Setup& setup);

}  // namespace trunnion::imports
