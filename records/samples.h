// Axis samples of the rows of a table: sides, velocities and distances by the contract's rules.
#pragma once

#include <span>
#include <vector>

#include "records/readings.h"
#include "records/travel.h"

namespace trunnion::records {

/// Rows of the device come so dense that their differences are velocities.
bool is_continuous(Device device);

/// AxisSample of each row, from positions and times alone (formats.md, "Readings").
///   side (travel)   sign of the axis's last motion in the session, device-less rows included; an
///                   axis that stands keeps it; before its first motion what `# side` says (first
///                   session), else `side_unknown` and 0
///   continuous rows velocity (q[i+1] - q[i-1]) / (t[i+1] - t[i-1]) within the test, one-sided at
///                   its ends; travel is its sign, 0 at an exact turning point
///   acceleration    parabola through five rows of the test, continuous rows only
///   since_reversal  from where the axis turned (between dense rows: the vertex of the parabola
///                   through three); it begins anew at a row of another test that follows a reading
///                   directly, because nobody tells the way between them; before the first turn it
///                   is beyond `no_reversal_seen`
///   path_mm         way of X Y Z since the first row of the test
std::vector<AxisSample> samples_of(const ReadingTable& table);
/// The same for rows of one session that follow what `history` saw.
std::vector<AxisSample> samples_of(std::span<const Reading> rows, const std::vector<Axis>& axes,
                                   TravelHistory history, const AxisNames& names = {});

/// Nobody tells the way from one row to the next.
bool way_unknown(const Reading& from, const Reading& to);

}  // namespace trunnion::records
