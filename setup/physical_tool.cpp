#include "setup/physical_tool.h"

#include <cmath>

namespace trunnion::setup {

Vector3 PhysicalTool::tip_S_mm(double spindle_rad, bool turns) const {
    if (turns) return {0.0, 0.0, -length_mm};
    const double c = std::cos(spindle_rad), s = std::sin(spindle_rad);
    return {c * runout_x_mm - s * runout_y_mm, s * runout_x_mm + c * runout_y_mm, -length_mm};
}

double PhysicalTool::radius_mm(bool turns) const {
    return 0.5 * diameter_mm + (turns ? std::hypot(runout_x_mm, runout_y_mm) : 0.0);
}

}  // namespace trunnion::setup
