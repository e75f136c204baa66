// Readings of a run as they come, with the moves between them that tell directions of approach.
#pragma once

#include <set>
#include <span>
#include <string>

#include "records/samples.h"
#include "records/stops.h"
#include "records/told_lines.h"

namespace trunnion::emulator {

/// The table grows row by row; the history of travel grows with it, so that a reading is taken on
/// the rows that are written.
class ReadingLog {
  public:
    /// `sides`: of the axes before their first motion.
    ReadingLog(std::vector<Axis> axes, const AxisSides& sides, std::string test);

    /// Name of the rows to come.
    void set_test(std::string test);
    /// The same for a pass of a continuous device: a name given before gets a number.
    void set_pass(const std::string& test);
    /// A move that nothing reads. Kept only as far as it changes an axis's last direction of
    /// travel.
    void passed(const AxisPositions& to, double time_s, PositioningMode mode);

    /// The sample of a row that would be added now.
    AxisSample sample_of(records::Reading row) const;
    /// Adds a row: numbers it, names its test, writes the kept moves before it as device-less rows.
    void add(records::Reading row);

    /// Rows of the test in force at the end of the table, and their samples.
    std::span<records::Reading> pass();
    std::vector<AxisSample> pass_samples() const;

    const std::string& test() const { return test_; }
    std::size_t size() const { return table_.rows.size(); }
    bool empty() const { return table_.rows.empty() && stops_.empty(); }
    /// The table, with a column for each quantity that a row sets beside its usual value.
    records::ReadingTable take();

  private:
    void append(records::Reading row);
    std::size_t pass_begin() const;

    records::ReadingTable table_;
    std::string test_;
    std::set<std::string> names_;     ///< given so far
    records::Stops stops_;            ///< since the last row
    records::TravelHistory history_;  ///< of all rows
    /// Where the way before is not known: the first row of this stretch, and the history there.
    std::size_t stretch_ = 0;
    records::TravelHistory before_stretch_;
};

}  // namespace trunnion::emulator
