// The telescoping ballbar: ball-to-ball length between a cup in the spindle and a pivot on the
// table.
#pragma once

#include <vector>

#include "geometry/pose.h"
#include "kinematics/machine.h"

namespace trunnion::ballbar {

/// The mounted bar.
struct Ballbar {
    Vector3 cup_S_mm = Vector3(0, 0, -120);  ///< tool-cup ball centre in S
    Vector3 pivot_W_mm = Vector3::Zero();    ///< centre-pivot ball centre in W
    double length_mm = 100.0;                ///< nominal ball-to-ball length
    double range_mm = 1.0;                   ///< travel of the transducer to each side
};

/// Vector from the cup ball to the pivot ball, in M, mm.
Vector3 cup_to_pivot_M(const kinematics::MachinePose& poses, const Ballbar& bar);

/// Ball-to-ball length - nominal length, mm.
double length_deviation_mm(const kinematics::MachinePose& poses, const Ballbar& bar);

inline bool in_range(double deviation_mm, const Ballbar& bar) {
    return deviation_mm >= -bar.range_mm && deviation_mm <= bar.range_mm;
}

/// Times (s) in [from_s, to_s) at which an instrument with sampling rate `rate_hz`, started at
/// `start_s`, takes a reading.
std::vector<double> sample_times(double start_s, double rate_hz, double from_s, double to_s);

}  // namespace trunnion::ballbar
