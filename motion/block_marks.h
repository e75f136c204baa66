// What a block gives its moves: feed, spindle, coolant, tool and the place in the program.
#pragma once

#include <cstdint>
#include <string>

namespace trunnion::motion {

/// Feed as programmed and as the axes need it.
struct FeedState {
    double programmed = 0.0;      ///< F as written: mm or inch a minute, a turn, or 1/min
    double mm_min = 0.0;          ///< in force (G94, G95); 0: none
    double seconds_per_mm = 0.0;  ///< 60 / mm_min, 0 when there is none
    bool inverse_time = false;    ///< G93
    bool in_block = false;        ///< the block has F
};

/// In force for the moves that go out. A move that waits keeps those of its own block.
struct BlockMarks {
    FeedState feed;
    double spindle_rpm = 0.0;  ///< signed: negative is M4
    bool coolant = false;
    bool gap_free = true;  ///< false: exact stop at the end (G9, G61)
    int tool = 0;          ///< T in the spindle
    int line = 0;
    std::uint64_t byte = 0;
    const std::string* program = nullptr;  ///< name of the file
};

}  // namespace trunnion::motion
