// A position log beside the program that it was taken of: blocks, uncertainty, start.
#pragma once

#include <string>
#include <vector>

#include "choices/pairing.h"
#include "interpreter/program_source.h"
#include "records/position_log.h"

namespace trunnion::choices {

enum class LogNoise : unsigned char { given, repeats, assumed };
const char* to_string(LogNoise noise);

struct LogOfProgram {
    LogView view;
    PathOptions path;  ///< how a path that is compared with this log is to be made
    LogNoise noise = LogNoise::assumed;
    double sigma = 0.0;  ///< mean standard uncertainty of a position, mm or deg
    std::vector<std::string> notes;
};

/// `texts`: the main program first, then the programs that it calls. The uncertainty is what the
/// log gives, else (dense samples) what scatters about a smooth motion by their third differences,
/// at least that of the printed increment; never below `least_sigma`. N numbers count where every
/// number of a column `block` is one of the program, else the numbers are lines. Throws InputError
/// with the log's line for a block that the program does not have.
LogOfProgram log_of_program(const records::PositionLog& log,
                            const std::vector<interpreter::ProgramText>& texts);

constexpr double least_sigma = 5e-5;         ///< mm or deg: less is beyond any control
constexpr double least_sample_sigma = 1e-4;  ///< of samples: the chords of curves

}  // namespace trunnion::choices
