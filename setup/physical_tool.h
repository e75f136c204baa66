// The tools as they are, beside what the control believes of them.
#pragma once

#include <map>
#include <string>

#include "geometry/pose.h"

namespace trunnion::setup {

/// A cylinder with a flat end; positions are relative to the gauge point, in S.
struct PhysicalTool {
    double length_mm = 0.0;  ///< gauge point to tip
    double diameter_mm = 0.0;
    /// Of the tool's axis beside the spindle's, at spindle angle 0; it turns with the spindle.
    double runout_x_mm = 0.0, runout_y_mm = 0.0;

    /// Centre of the tip in S. A turning tool is the volume that its cutting edges sweep, which is
    /// centred on the spindle axis.
    Vector3 tip_S_mm(double spindle_rad, bool turns) const;
    /// Of what touches: turning, larger by the runout.
    double radius_mm(bool turns) const;
    bool operator==(const PhysicalTool&) const = default;
};

using PhysicalTools = std::map<int, PhysicalTool>;  ///< by T

}  // namespace trunnion::setup
