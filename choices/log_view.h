// A position log with its program: blocks, uncertainty, start.
#pragma once

#include <set>
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
    bool late = false;          ///< the numbers of blocks were late or early, and are moved
    bool by_number = false;     ///< the numbers of blocks are N numbers, else lines
    bool lines_from_0 = false;  ///< they are lines, and seem to be counted from 0
    PathOptions path;           ///< options for a path to be compared with this log
    LogNoise noise = LogNoise::assumed;
    bool dense = false;        ///< neighbouring rows showed the noise
    double sigma = 0.0;        ///< mean standard uncertainty of a position, mm or deg
    double least_sigma = 0.0;  ///< that of the printed increment
    double half_step = 0.0;    ///< half of that increment, mm or deg
    std::set<int> foreign;     ///< N numbers of rows that are set aside: the program lacks them
    std::vector<std::string> notes;
};

/// `texts`: the main program first, then the programs that it calls. The uncertainty is that of the
/// log, else (dense samples) the scatter about a smooth motion from third differences, at least
/// that of the printed increment, and never below `least_sigma`. A column `block` contains N
/// numbers if most of its values are N numbers of the program, else line numbers. Rows with another
/// N number are set aside, with a note; more than half of them, or a line that the program does not
/// have, throws InputError with the log's line.
LogOfProgram log_of_program(const records::PositionLog& log,
                            const std::vector<interpreter::ProgramText>& texts,
                            std::uint64_t max_blocks = 0);

/// Another uncertainty for all rows, at least that of the printed increment.
void set_sigma(LogOfProgram& log, double sigma);

/// Where the control stood before the program: where the axes stand first in a log of samples.
void set_start(const records::PositionLog& log, LogOfProgram& out);

constexpr double least_sigma = 5e-5;         ///< mm or deg: below the resolution of any control
constexpr double least_sample_sigma = 1e-4;  ///< of samples: because of the chords of curves

}  // namespace trunnion::choices
