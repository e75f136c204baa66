// Axis samples of the rows of a table: sides, velocities and distances by the rules of the
// format (samples.cpp, walk.cpp).
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "records/smoothed_motion.h"
#include "records/travel.h"

namespace trunnion::records {

/// True when rows of the device are so dense that their differences are velocities.
bool is_continuous(Device device);

/// AxisSample of each row, from positions and times only (formats.md, "Readings").
///   side (travel)   sign of the axis's last motion in the session, including rows without device;
///                   kept while the axis is at rest; before its first motion from `# side` (first
///                   session), else `side_unknown` and 0
///   continuous rows velocity (q[i+1] - q[i-1]) / (t[i+1] - t[i-1]) within the test, one-sided at
///                   its ends, those of each repetition after another test; travel is its sign, 0
///                   at an exact reversal point
///   acceleration    cubic through five rows of the test, continuous rows only; the same for jerk
///   smooth_..       what the time constants of the drives add to these (smoothed_motion.h)
///   since_reversal  distance from the reversal point (between dense rows: the vertex of the
///                   parabola through three); restarts at a row of another test that directly
///                   follows
///                   a reading, because the path between them is unknown; before the first reversal
///                   it
///                   exceeds `no_reversal_seen`
///   path_mm         path length of X Y Z since the first row of the test
std::vector<AxisSample> samples_of(const ReadingTable& table, const TimeConstants& constants = {});
/// The same for rows of one session that continue `history`.
std::vector<AxisSample> samples_of(std::span<const Reading> rows, const std::vector<Axis>& axes,
                                   TravelHistory history, const AxisNames& names = {},
                                   const TimeConstants& constants = {});
/// The samples that the `chosen` rows (indices, in order) have among all rows of the table, without
/// the memory of those of the others.
std::vector<AxisSample> samples_among(const ReadingTable& table,
                                      std::span<const std::size_t> chosen,
                                      const TimeConstants& constants = {});

/// Velocity, acceleration and jerk (mm/s.., rad/s..) of the axis of an `axis` row.
struct LoggedMotion {
    std::optional<Vector3> motion;    ///< as in its AxisSample; none for other rows
    std::optional<Vector3> smoothed;  ///< behind the time constant of its drive, if there is one
};
/// The same motion as in the samples of the rows, in a tenth of the memory.
std::vector<LoggedMotion> logged_motion(const ReadingTable& table,
                                        const TimeConstants& constants = {});

/// The commanded motion of an axis in every pass of the table, with the rows of the pass.
std::vector<CommandedPath> logged_paths(const ReadingTable& table, Axis axis);

/// True when the path from one row to the next is unknown.
bool way_unknown(const Reading& from, const Reading& to);

}  // namespace trunnion::records
