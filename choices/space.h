// Distances between positions in the axes of a log.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "offsets/control_position.h"

namespace trunnion::choices {

/// Positions of some axes only. A degree counts as a millimetre.
class Space {
  public:
    using ControlPosition = offsets::ControlPosition;

    explicit Space(const std::vector<Axis>& axes) {
        for (const Axis axis : axes) index_.push_back(index_of(axis));
    }
    double square(const ControlPosition& a, const ControlPosition& b) const {
        double sum = 0.0;
        for (const std::size_t i : index_)
            sum += (a.value[i] - b.value[i]) * (a.value[i] - b.value[i]);
        return sum;
    }
    /// Fraction of the point on the line a-b nearest to p.
    double nearest(const ControlPosition& a, const ControlPosition& b,
                   const ControlPosition& p) const {
        double along = 0.0, length = 0.0;
        for (const std::size_t i : index_) {
            const double way = b.value[i] - a.value[i];
            along += (p.value[i] - a.value[i]) * way;
            length += way * way;
        }
        return length > 0.0 ? std::clamp(along / length, 0.0, 1.0) : 1.0;
    }
    ControlPosition between(const ControlPosition& a, const ControlPosition& b, double s) const {
        ControlPosition out;
        for (const std::size_t i : index_)
            out.value[i] = a.value[i] + s * (b.value[i] - a.value[i]);
        return out;
    }
    ControlPosition apart(const ControlPosition& log, const ControlPosition& control) const {
        ControlPosition out;
        for (const std::size_t i : index_) out.value[i] = log.value[i] - control.value[i];
        return out;
    }
    /// Adds the coordinates to a list of points.
    void append(const ControlPosition& p, std::vector<double>& out) const {
        for (const std::size_t i : index_) out.push_back(p.value[i]);
    }
    std::size_t axes() const { return index_.size(); }

  private:
    std::vector<std::size_t> index_;
};

}  // namespace trunnion::choices
