// Feed in force.
#pragma once

namespace trunnion {

/// Feed as programmed and as the axes need it.
struct FeedState {
    double programmed = 0.0;      ///< F as written: mm or inch a minute, a turn, or 1/min
    double mm_min = 0.0;          ///< in force (G94, G95); 0: none
    double seconds_per_mm = 0.0;  ///< 60 / mm_min, 0 when there is none
    bool inverse_time = false;    ///< G93
    bool in_block = false;        ///< the block has F
};

}  // namespace trunnion
