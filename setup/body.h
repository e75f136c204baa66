// Bodies on the table that a probe meets beside spheres: plates, blocks, pockets, bosses, rings;
// setters, which tools meet.
#pragma once

#include <string>

#include "geometry/pose.h"

namespace trunnion::setup {

/// In its own frame B the top is at z = 0, centred on x = y = 0, and the body is below. Sizes are
/// the physical ones; nominal sizes are in the NC program.
struct Body {
    /// block: a plate, a web, a corner, an edge. pocket: walls around a rectangle. boss: a
    /// cylinder. ring: a bore in a cylinder. setter: the disc of a tool setter, which tools touch.
    enum class Kind : unsigned char { block, pocket, boss, ring, setter };
    std::string name;
    Kind kind = Kind::block;
    Vector3 center_W_mm = Vector3::Zero();  ///< of the centre of the top
    Vector3 tilt_deg = Vector3::Zero();     ///< about the fixed X, then Y, then Z axis of W
    /// Block: its size. Pocket: size of the cavity, z its depth.
    Vector3 size_mm = Vector3(50.0, 50.0, 20.0);
    double diameter_mm = 25.0;      ///< boss, setter, or bore of a ring
    double height_mm = 20.0;        ///< of boss, setter and ring
    double wall_mm = 10.0;          ///< of pocket and ring
    double pretravel_um = 0.0;      ///< setter: way from contact to signal, in every direction
    double repeatability_um = 0.0;  ///< setter: one sigma of a touch along its direction

    Pose pose_WB() const;
    bool operator==(const Body&) const = default;
};

}  // namespace trunnion::setup
