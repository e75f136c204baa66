// Rough match of the log's way with the control's, from coarse to fine: the nodes that a row may
// belong to.
#pragma once

#include <cstddef>
#include <vector>

namespace trunnion::choices {

/// Inclusive ranges of one list, one for each element of another; both ends never fall.
struct Spans {
    std::vector<std::size_t> low, high;
};

/// Ends at which one way may be longer than the other.
struct OpenEnds {
    bool start = false, end = false;
};

/// Points with `axes` coordinates each, one after the other, and their distance along the way.
class Way {
  public:
    /// Points within `ball` of the last one that counts are its noise: they add no length.
    Way(std::vector<double> points, std::size_t axes, double ball);

    double length() const { return along_.back(); }
    std::size_t size() const { return along_.size(); }
    std::size_t axes() const { return axes_; }
    const std::vector<double>& along() const { return along_; }
    /// Points at equal distances along the way, the last one within one step of its end.
    std::vector<double> spaced(double step) const;

  private:
    double square(std::size_t a, std::size_t b) const;

    std::vector<double> points_;
    std::size_t axes_;
    std::vector<double> along_;         ///< of each point
    std::vector<std::size_t> corners_;  ///< points that count
};

/// Nodes that each row may belong to, with margins `wide` times the usual ones. Linear in the
/// number of rows and nodes, apart from a first look with a fixed number of points. Throws
/// PathEnded.
Spans matched_ways(const Way& rows, const Way& nodes, const OpenEnds& open, std::size_t wide);

/// Throws PathEnded when the work must end; looks only at some of the counts.
void end_if_asked(std::size_t count);

}  // namespace trunnion::choices
