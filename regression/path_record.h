// A whole path divided into passes, the units of alignment.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "regression/segment_file.h"

namespace trunnion::regression {

/// Rapids to a cut, and the cut: segments first..last, with the cut from cut_first on (empty at the
/// end of a program). A new pass starts at the first rapid after a cut, or with another tool.
struct Pass {
    std::uint64_t first = 1, cut_first = 1, last = 1;
    std::array<double, 3> start_mm{}, end_mm{};  ///< of the cut, or of the rapids if there is no
                                                 ///< cut
    std::array<double, 3> centroid_mm{};         ///< of the cut, weighted by length
    double cut_mm = 0.0, rapid_mm = 0.0;
    std::uint32_t line = 0;
    std::uint16_t tool = 0;
    std::uint16_t modes = 0;      ///< bit n: PositioningMode n occurs
    std::uint16_t cut_modes = 0;  ///< the same in the cut

    bool cuts() const { return last > cut_first; }
};

/// Totals of one tool for the report's table.
struct ToolTotals {
    double cut_mm = 0.0, rapid_mm = 0.0, cut_s = 0.0;
    double feed_min = 0.0, feed_max = 0.0;
    double spindle_min = 0.0, spindle_max = 0.0;
    std::uint64_t passes = 0;
};

/// A path in execution order, with its passes. Segment 0 is the origin, the start of the path.
class PathRecord {
  public:
    /// Adds a segment; segments without length and change of orientation are dropped.
    void add(Segment segment);
    /// Ends the last pass.
    void finish();
    std::uint16_t program_index(const std::string& name);

    const SegmentFile& segments() const { return file_; }
    /// Complete after finish().
    const SpilledArray<Pass>& passes() const { return passes_; }
    const std::vector<std::string>& programs() const { return programs_; }
    const std::map<int, ToolTotals>& totals() const { return totals_; }
    /// Number of motion segments, without the origin.
    std::uint64_t size() const { return file_.size() == 0 ? 0 : file_.size() - 1; }

    /// Present end of the path, and length cut so far.
    const PathPoint& end() const { return end_; }
    double cut_mm() const { return cut_mm_; }
    /// Positioning functions that occur, as in Pass.
    std::uint16_t modes() const { return modes_; }

  private:
    void begin_pass(const Segment& segment);
    void count(const Segment& segment, double length_mm);

    SegmentFile file_;
    SpilledArray<Pass> passes_;
    Pass pass_;  ///< the pass being recorded
    std::vector<std::string> programs_;
    std::map<int, ToolTotals> totals_;
    PathPoint end_;
    double cut_mm_ = 0.0;
    std::uint16_t modes_ = 0;
    bool open_ = false;
};

}  // namespace trunnion::regression
