// Which choice, parameter or stale store of the control explains a log of its axes.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "choices/log_view.h"
#include "choices/store_fit.h"

namespace trunnion::choices {

enum class GapVerdict : unsigned char {
    no_gap,
    explained,
    partly_explained,
    ambiguous,
    unexplained
};
const char* to_string(GapVerdict verdict);

/// A block and how far log and control lie apart there.
struct GapPlace {
    std::string program;  ///< empty: the main program
    int line = 0;
    std::string block;   ///< its text
    double apart = 0.0;  ///< mm or deg, whichever is more
    int log_line = 0;    ///< of the log's file
};

/// Rows that took no part: the rest of the gap, as rms.
struct GapShrink {
    double before_um = 0.0, after_um = 0.0;
    double shrink = 0.0;           ///< of the excess over the noise, 0 to 1
    double low = 0.0, high = 0.0;  ///< 95 %, from drawing blocks anew
};

struct GapCause {
    std::string name;                   ///< "tcp_frame=rotary_zero", "G54"
    std::string what;                   ///< one sentence
    std::vector<FittedNumber> numbers;  ///< of a store; none for a choice
    double probability = 0.0;
    std::vector<std::string> rivals;  ///< explain the log as well
    double share = 0.0;               ///< of the gap that it takes away, beside the other causes
    std::size_t blocks = 0;           ///< that it changes
    GapPlace first, worst;
    GapShrink heldout;
};

/// A block with a part of the gap.
struct GapBlock {
    GapPlace worst;
    double share = 0.0;
    double p_value = 1.0;  ///< that noise alone is so large there
};

struct ControlGap {
    GapVerdict verdict = GapVerdict::no_gap;
    LogNoise noise = LogNoise::assumed;
    double rms_um = 0.0, noise_um = 0.0, excess_um = 0.0, p_value = 1.0;
    std::size_t rows = 0, blocks = 0;
    GapPlace first, worst;
    std::vector<GapBlock> where;   ///< blocks with the most of it
    std::vector<GapCause> causes;  ///< in the order of their share
    double after_rms_um = 0.0;
    double explained = 0.0;  ///< of the mean square beyond noise, on blocks left out
    GapShrink after;
    std::vector<GapBlock> left;       ///< blocks with the most of what stays
    std::vector<std::string> unseen;  ///< choices and stores that this program cannot tell
    std::string stopped;              ///< alarm that ends the program on this control; empty: none
    setup::Setup setup;               ///< with the causes
    std::vector<std::string> notes;
};

struct GapQuestion {
    const setup::Setup& setup;
    const records::PositionLog& log;
    const interpreter::ProgramText& program;
    std::uint64_t max_blocks = 0;
    std::function<void(const char*)> watch;  ///< told each stage
};

/// Runs the program with each row of the table of choices and with each store fitted to the log,
/// takes the one that explains most, begins again with it, and ends when nothing passes the blocks
/// left out. Throws InputError for a log of another program.
ControlGap control_gap(const GapQuestion& question, interpreter::ProgramSource& programs,
                       const std::function<std::vector<interpreter::ProgramText>()>& texts);

}  // namespace trunnion::choices
