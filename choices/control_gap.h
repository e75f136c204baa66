// Option, parameter or stale store of the control that explains a log of its axes.
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

/// A block, and the distance between log and control there.
struct GapPlace {
    std::string program;  ///< empty: the main program
    int line = 0;
    std::string block;   ///< its text
    double apart = 0.0;  ///< mm or deg, the larger one
    int log_line = 0;    ///< in the log's file
};

/// The gap on left-out rows, before and after, as rms.
struct GapShrink {
    double before_um = 0.0, after_um = 0.0;
    double shrink = 0.0;           ///< of the excess over the noise, 0 to 1
    double low = 0.0, high = 0.0;  ///< 95 % interval, from resampling of blocks
};

struct GapCause {
    std::string name;                   ///< "tcp_frame=rotary_zero", "G54"
    std::string what;                   ///< one sentence
    std::vector<FittedNumber> numbers;  ///< of a store; empty for an option
    double probability = 0.0;           ///< with those of its rivals less than 1: it may be none
    std::vector<std::string> rivals;    ///< alternatives that explain the log equally well
    double share = 0.0;      ///< part of the gap that it removes, beside the other causes
    std::size_t blocks = 0;  ///< number of blocks that it changes
    GapPlace first, worst;
    GapShrink heldout;
    bool known = true;  ///< false: what no choice and no store explains
};

/// The cause, or one of its rivals.
bool is_claimed(const GapCause& cause);

/// A block with part of the gap.
struct GapBlock {
    GapPlace worst;
    double share = 0.0;
    double p_value = 1.0;  ///< probability of this size by noise alone
};

struct ControlGap {
    GapVerdict verdict = GapVerdict::no_gap;
    LogNoise noise = LogNoise::assumed;
    double rms_um = 0.0, noise_um = 0.0, excess_um = 0.0, p_value = 1.0;
    std::size_t rows = 0, blocks = 0;
    GapPlace first, worst;
    std::vector<GapBlock> where;   ///< blocks with the largest parts
    std::vector<GapCause> causes;  ///< in the order of their share
    double after_rms_um = 0.0;
    double explained = 0.0;  ///< fraction of the mean square beyond noise, on left-out blocks
    GapShrink after;
    std::vector<GapBlock> left;       ///< blocks with the largest remaining parts
    std::vector<std::string> unseen;  ///< options and stores that this program does not determine
    GapPlace ends_before;       ///< the log has no moves from this block on; line 0: it has all
    bool stands_there = false;  ///< and shows that the other control stopped before it
    std::string stopped;        ///< alarm that stops the program on this control; empty: none
    setup::Setup setup;         ///< with the causes
    std::vector<std::string> notes;
};

struct GapQuestion {
    const setup::Setup& setup;
    const records::PositionLog& log;
    const interpreter::ProgramText& program;
    std::uint64_t max_blocks = 0;
    std::function<void(const char*)> watch;  ///< called with the name of each stage
};

/// Runs the program with each row of the table of options, and with each store fitted to the log;
/// takes the one that explains most, and repeats from there until no candidate is confirmed by the
/// left-out blocks. Throws InputError for a log of another program, PathEnded.
ControlGap control_gap(const GapQuestion& question, interpreter::ProgramSource& programs,
                       const std::function<std::vector<interpreter::ProgramText>()>& texts);

}  // namespace trunnion::choices
