// The commanded motion of an axis behind the time constant of its drive: derivatives that a servo
// loop answers to, of any bandwidth and at any sampling (smoothed_motion.cpp).
#pragma once

#include <span>
#include <vector>

#include "records/readings.h"

namespace trunnion::records {

/// Commanded motion of one axis in one pass, at its distinct times.
struct CommandedPath {
    std::vector<double> time_s, position;
    std::vector<double> velocity;   ///< told by columns, else of the parabola through three rows
    std::vector<std::size_t> rows;  ///< the rows of the pass, if the path is one of a table
    std::vector<std::size_t> at;    ///< of each row of the pass: index of its time
    bool goes_on = false;           ///< certainly moved before its first row: the pass of a bar
};

/// `pass`: indices of the rows of one pass, in order.
CommandedPath commanded_path(std::span<const Reading> rows, const std::vector<std::size_t>& pass,
                             Axis axis, const AxisNames& names);

/// Velocity, acceleration and jerk at each time of the path behind low-passes F = 1 / (1 + s T) of
/// the time constant T > 0: s F + T s^2 F^2 + T^2 s^3 F^3, s^2 F^2 + 2 T s^3 F^3 and s^3 F^3 times
/// the position. Slow motion has its own derivatives. A loop of first order follows with T, T^2
/// and T^3 of them exactly. Exact for the cubics through positions and velocities. Before the
/// first row the axis moved as it does there, or rested if it hardly moves there.
std::vector<Vector3> smoothed_motion(const CommandedPath& path, double time_constant_s);

}  // namespace trunnion::records
