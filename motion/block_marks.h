// Data that a block attaches to its moves: feed, spindle, coolant, tool and source position.
#pragma once

#include <cstdint>
#include <string>

namespace trunnion::motion {

/// Feed as programmed and as used by the axes.
struct FeedState {
    double programmed = 0.0;      ///< F as written: mm/min or inch/min, per revolution, or 1/min
    double mm_min = 0.0;          ///< active feed (G94, G95); 0: none
    double seconds_per_mm = 0.0;  ///< 60 / mm_min, 0 without feed
    bool inverse_time = false;    ///< G93
    bool in_block = false;        ///< the block contains F
};

/// State attached to the moves sent out. A buffered move keeps the marks of its own block.
struct BlockMarks {
    FeedState feed;
    double spindle_rpm = 0.0;  ///< signed: negative for M4
    bool coolant = false;
    bool gap_free = true;  ///< false: exact stop at the end (G9, G61)
    int tool = 0;          ///< T number of the tool in the spindle
    int line = 0;
    std::uint64_t byte = 0;
    const std::string* program = nullptr;  ///< file name
};

}  // namespace trunnion::motion
