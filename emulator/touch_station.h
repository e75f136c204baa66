// The probe in the spindle and the spheres on the table: answers G31 moves.
#pragma once

#include <optional>

#include "emulator/path_sampler.h"
#include "emulator/physical_machine.h"
#include "setup/setup.h"
#include "base/random.h"
#include "probe/touch_probe.h"

namespace trunnion {

struct Touch {
    double s = 0.0;  ///< of the move, where the skip latched
    AxisPositions stopped;
    const Artefact* sphere = nullptr;
    Vector3 direction_M = Vector3::Zero();  ///< of the approach; zero when no linear axis moved
    double value_mm = 0.0;  ///< along direction_M from the commanded end to the latch
};

class TouchStation {
  public:
    /// `setup` must outlive the station.
    TouchStation(const Setup& setup, std::uint64_t seed);

    /// The probe is in the spindle: no tool called yet, or the one the setup names.
    bool mounted(const AxisMove& move) const;
    /// The first sphere that the stylus meets on the path.
    std::optional<Touch> touch(const PathSampler& path, const PhysicalMachine& machine);

  private:
    std::optional<Touch> latched(const PathSampler& path, const PhysicalMachine& machine,
                                 Contact contact, double contact_s);

    const Setup& setup_;
    SeededNoise noise_;
};

}  // namespace trunnion
