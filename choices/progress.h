// How far the samples on a motion have come, and where a motion may end between two of them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "choices/pairing.h"
#include "choices/space.h"

namespace trunnion::choices {

/// Of the rows placed on a motion so far.
struct Progress {
    double along_mm = 0.0;   ///< from the start of the present segment: the farthest row
    double stride_mm = 0.0;  ///< largest distance of two successive rows of the motion
    std::uint32_t rows = 0;
    std::uint32_t first = 0;  ///< the first one
    std::uint32_t begin = 0;  ///< node where the motion begins; 0: not known
    double told = 0.0;        ///< cost of that node so far, mm2 or deg2

    /// After the node `k` at the end of a segment, which cost `told`.
    Progress after(std::size_t k, bool end_of_motion, double cost) const {
        Progress out = *this;
        if (end_of_motion) out = {0.0, 0.0, 0, 0, static_cast<std::uint32_t>(k), cost};
        out.along_mm = 0.0;
        return out;
    }
};

/// A place on the segment to a node.
struct Spot {
    double along_mm;
    bool slides;
};

/// Distances between the rows of a log of samples, mm or deg.
class Strides {
  public:
    Strides() = default;
    Strides(const LogView& log, const Space& space);

    /// From a row to the next one; the last has none.
    double next(std::size_t row) const { return next_[row]; }
    /// Up to which the end of a motion may be missed after this row: its motion's own samples tell,
    /// if they are even and there are two; else the samples around, and those of the whole log.
    double allowed(std::size_t row, const Progress& motion) const {
        return std::min(around_[row], own(motion));
    }
    /// The same of its start, when all rows of the motion are known: the way there may have none.
    double allowed_before(const Progress& motion) const { return own(motion); }
    /// With a row at a place, after the row before it. `joined`: no rows are missing between them.
    Progress with_row(Progress now, double along_mm, std::size_t row, bool joined) const {
        now.along_mm = std::max(now.along_mm, along_mm);
        if (now.rows == 0) now.first = static_cast<std::uint32_t>(row);
        if (now.rows++ > 0 && joined) now.stride_mm = std::max(now.stride_mm, next(row - 1));
        return now;
    }

  private:
    /// Few samples need not have the largest distance of the motion among them.
    double own(const Progress& motion) const {
        if (!even_ || motion.rows < 2) return std::numeric_limits<double>::infinity();
        return lost_ * motion.stride_mm * (1.0 + 2.0 / (motion.rows - 1.0));
    }

    std::vector<double> next_, around_;
    bool even_ = false;
    double lost_ = 1.0;  ///< of the log: an end may have lost as many rows as any other place
};

}  // namespace trunnion::choices
