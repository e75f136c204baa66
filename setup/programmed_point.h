// The point on the table that a control meant with positions of its axes: columns px_mm py_mm pz_mm
// of readings.
#pragma once

#include <optional>

#include "geometry/axes.h"
#include "setup/right_stores.h"

namespace trunnion::setup {

/// Offset number of the probe: that of its own tool, 1 where every tool may be the probe.
int probe_offset(const ProbeSettings& probe);
/// Length in that offset, mm. The setup has a probe.
double probe_length_mm(const Setup& setup);

/// Axis positions of a probe (mm, rad) as the stores read them.
class ProgrammedPoint {
  public:
    /// `stores`: those in force; without them no point is known. `setup`: the length of the probe
    /// as the control believes it; `length_mm` instead of it, if known.
    ProgrammedPoint(const Setup& setup, const std::optional<RotaryStores>& stores,
                    std::optional<double> length_mm = {});
    /// With the stores of the setup.
    explicit ProgrammedPoint(const Setup& setup);

    /// Stylus ball centre in W, mm: by G54 under dpp and rtdfo, by 19700 and on under rtcp and tw.
    /// `extension_mm`: of a longer stylus. Empty where no store takes part.
    std::optional<Vector3> at(PositioningMode mode, const AxisPositions& machine,
                              double extension_mm) const;
    const std::optional<RotaryStores>& stores() const { return stores_; }

  private:
    std::optional<RotaryStores> stores_;
    Vector3 tool_mm_ = Vector3::Zero();  ///< from the ball to the gauge point
};

}  // namespace trunnion::setup
