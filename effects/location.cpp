// Location errors of the rotary axes: where their lines really are.
#include <fmt/format.h>

#include "effects/models.h"

namespace trunnion {
namespace {

/// One location error: axis, and 0..5 = X Y Z A B C.
struct Place {
    Axis axis;
    int direction;
};

}  // namespace

Effect location_effect(const Chain& chain) {
    Effect effect{"location",
                  "The rotary axes do not lie where the simulation has them",
                  "assembly, a crash, thermal growth since the last calibration",
                  "enter the identified values in the setup and in the control's pivot parameters",
                  "constant error motion: x' = q + d + exp(e x) Rot (x - q), d and e at home",
                  {},
                  {}};
    std::vector<Place> places;
    for (const AxisGeometry& axis : chain.axes()) {
        if (!axis.rotary) continue;
        for (int k = 0; k < 6; ++k) {
            if (k % 3 == main_direction(axis)) continue;
            places.push_back({axis.axis, k});
            const char* unit = k < 3 ? "mm" : "rad";
            effect.parameters.push_back(
                {fmt::format("E{}0{}_{}", "XYZABC"[k], letter_of(axis.axis), unit),
                 unit,
                 k < 3 ? 0.05 : 3e-4,
                 -1,
                 {},
                 true});
        }
    }
    effect.add = [places](const AxisSample&, const Contact&, std::span<const double> value,
                          Perturbation& out) {
        for (std::size_t j = 0; j < places.size(); ++j) {
            SmallMotion& motion = out.motion[index_of(places[j].axis)];
            const int k = places[j].direction;
            (k < 3 ? motion.shift_mm(k) : motion.tilt_rad(k - 3)) += value[j];
        }
    };
    return effect;
}

}  // namespace trunnion
