// Which logged position belongs to which place of a control's path, and how far they lie apart.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "choices/control_path.h"

namespace trunnion::choices {

/// What of a log the pairing works with: positions in mm and deg, a block key for each row.
struct LogView {
    struct Row {
        offsets::ControlPosition at;
        int key = -1;         ///< number of its block, -1: not told
        double weight = 1.0;  ///< 1 / standard uncertainty, per mm or deg
        int line = 0;         ///< of the log's file
        bool end = false;     ///< the end of a move: it belongs to a node, not to a way
    };
    std::vector<Row> rows;
    std::vector<Axis> axes;  ///< that the log tells
    bool ends = false;       ///< all rows are ends of moves
    int keys = 0;            ///< how many blocks the log names; 0: it tells no blocks
    /// Number of a block of the program; -1: the log does not name it.
    std::function<int(const PathBlock&)> key_of;
};

/// A row beside a place of the path: from node - 1 (fraction 0) to node (1).
struct Pair {
    std::size_t row = 0;
    std::uint32_t node = 0;
    double fraction = 1.0;
    offsets::ControlPosition apart;  ///< log - control, mm and deg; axes without a column: 0
    bool slides = false;             ///< the place along the segment is the nearest one, so that
                                     ///< nothing is said about the direction of travel
};

/// Pairs in order within each block: a block's rows go with what its line did, first to last, by
/// least squares (dynamic time warping). Samples are compared with the way itself, ends of moves
/// with ends. Moves that the log passed over count too: a place of the path that no sample came
/// near is paired with the nearest of the samples' chords, less the distance of samples. A degree
/// counts as a millimetre. Nothing behind the last logged position counts.
std::vector<Pair> pair_up(const LogView& log, const ControlPath& path);

/// Sum of squares of all pairs of a row, each axis divided by its uncertainty; one value a row.
std::vector<double> row_losses(const LogView& log, const std::vector<Pair>& pairs);

}  // namespace trunnion::choices
