// Assignment of logged positions to points of a control's path, and their distances.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "choices/control_path.h"

namespace trunnion::choices {

/// The data of a log used for pairing: positions in mm and deg, and a block key for each row.
struct LogView {
    struct Row {
        offsets::ControlPosition at;
        int key = -1;         ///< number of its block, -1: not given
        double weight = 1.0;  ///< 1 / standard uncertainty, per mm or deg
        int line = 0;         ///< in the log's file
        bool end = false;     ///< end of a move: belongs to a node, not to a segment
        bool cut = false;     ///< rows are missing between this one and the next
        int repeated = 0;     ///< rows at the same place, left out
    };
    std::vector<Row> rows;
    std::vector<Axis> axes;      ///< axes in the log
    bool ends = false;           ///< all rows are ends of moves
    bool begins_within = false;  ///< the log begins within the program: what comes before its first
                                 ///< row is not judged
    bool from_zero = false;      ///< the control started at its machine zero, not at the first row
    bool whole = false;       ///< its last row is the end of the program; else it may be anywhere
    bool marked = false;      ///< every end of a move has a row
    int keys = 0;             ///< number of blocks named by the log; 0: none
    bool even = false;        ///< samples at equal times, so those of a motion tell of its ends
    double lost = 1.0;        ///< most distances of samples from one row to the next on a steady
                              ///< way: single rows are missing; 1: none
    double period_min = 0.0;  ///< of samples, at most; 0: not known. A feed that takes several
                              ///< of them has a row
    double spacing = 0.0;     ///< mm or deg: least distance of samples that is assumed everywhere
    double rounding = 0.0;    ///< mm or deg: half the printed increment if no other noise hides it;
                              ///< an axis at rest has the same one in all its rows
    double freedom = std::numeric_limits<double>::infinity();  ///< numbers of which the noise is
                                                               ///< known
    /// Number of a block of the program; -1: not named by the log.
    std::function<int(const PathBlock&)> key_of;
};

/// A row with its point of the path: from node - 1 (fraction 0) to node (1).
struct Pair {
    std::size_t row = 0;
    std::uint32_t node = 0;
    double fraction = 1.0;
    offsets::ControlPosition apart;  ///< log - control, mm and deg; axes without a column: 0
    bool slides = false;             ///< the point is the nearest one on the segment, or as far
                                     ///< as an earlier row, so it contains no information along
                                     ///< the direction of travel
};

/// Pairs in order within each block: the rows of a block are matched with the path of its line by
/// least squares (dynamic time warping). Samples are compared with segments, ends of moves with
/// ends. Moves not sampled by the log are included: a point of the path far from all samples is
/// paired with the nearest chord of the samples, minus the distance of samples (of those on the
/// motion that ends there, if it has two in a log of even samples; no distance is subtracted for an
/// end of a move if the log marks ends; nothing is judged where rows are missing). A sample may
/// stand behind one before it on the same segment only within noise. A degree counts as a
/// millimetre. Points after the last logged position are ignored. Throws PathEnded.
std::vector<Pair> pair_up(const LogView& log, const ControlPath& path);

}  // namespace trunnion::choices
