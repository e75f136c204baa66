// Readings of a run in sequence, with the moves between them that determine directions of approach.
#pragma once

#include <set>
#include <span>
#include <string>

#include "records/samples.h"
#include "records/stops.h"
#include "records/told_lines.h"

namespace trunnion::emulator {

/// The table and the history of travel grow row by row, so that a reading is evaluated on the rows
/// that are written.
class ReadingLog {
  public:
    /// `sides`: of the axes before their first motion.
    ReadingLog(std::vector<Axis> axes, const AxisSides& sides, std::string test);

    /// Test name of the following rows.
    void set_test(std::string test);
    /// The same for a pass of a continuous device: a name used before gets a number.
    void set_pass(const std::string& test);
    /// A move without reading. Kept only if it changes the last direction of travel of an axis.
    void passed(const AxisPositions& to, double time_s, PositioningMode mode);

    /// The sample of a row if it were added now.
    AxisSample sample_of(records::Reading row) const;
    /// Adds a row: numbers it, sets its test, and writes the moves kept before it as rows without
    /// device.
    void add(records::Reading row);

    /// Rows of the current test at the end of the table, and their samples.
    std::span<records::Reading> pass();
    std::vector<AxisSample> pass_samples(const TimeConstants& constants) const;

    const std::string& test() const { return test_; }
    std::size_t size() const { return table_.rows.size(); }
    bool empty() const { return table_.rows.empty() && stops_.empty(); }
    /// The table, with a column for each quantity that some row sets to a value other than the
    /// default.
    records::ReadingTable take();

  private:
    void append(records::Reading row);
    std::size_t pass_begin() const;

    records::ReadingTable table_;
    std::string test_;
    std::set<std::string> names_;     ///< names used so far
    records::Stops stops_;            ///< since the last row
    records::TravelHistory history_;  ///< of all rows
    /// First row since the path was last unknown, and the history there.
    std::size_t stretch_ = 0;
    records::TravelHistory before_stretch_;
};

}  // namespace trunnion::emulator
