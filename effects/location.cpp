// Location errors: the actual position and orientation of the axis lines.
#include <fmt/format.h>

#include "effects/models.h"

namespace trunnion::effects {
namespace {

/// One location error: 0..5 = X Y Z A B C of an axis.
struct Place {
    kinematics::AxisGeometry axis;
    int direction;
};

/// Rotary axis: two positions and two tilts perpendicular to its line. Linear axes X, Y, Z: the
/// squareness errors XY, YZ and ZX are effects of their own. Linear axis with another name: two
/// tilts.
std::vector<Place> places_of(const kinematics::Chain& chain) {
    std::vector<Place> places;
    for (const kinematics::AxisGeometry& axis : chain.axes())
        for (int k = axis.rotary ? 0 : 3; k < 6; ++k)
            if (k % 3 != main_direction(axis) && (axis.rotary || !is_letter(axis)))
                places.push_back({axis, k});
    return places;
}

EffectParameter parameter_of(const Place& place) {
    const bool shift = place.direction < 3;
    const char direction = "XYZABC"[place.direction], *unit = shift ? "mm" : "rad";
    EffectParameter p{fmt::format("E{}0{}_{}", direction, place.axis.name, unit), unit,
                      shift ? 0.05 : 3e-4};
    p.location = kinematics::ErrorName{direction, true, place.axis.axis};
    return p;
}

/// Contribution of one location error to the error motion of its axis.
void add_place(const Place& place, double value, const AxisSample& sample,
               kinematics::Perturbation& out) {
    SmallMotion& motion = out.motion[index_of(place.axis.axis)];
    const int k = place.direction;
    if (k < 3)
        motion.shift_mm(k) += value;
    else if (place.axis.rotary)
        motion.tilt_rad(k - 3) += value;
    else  // inclines the direction of travel, not the slide
        motion.shift_mm += value * sample.position[place.axis.axis] *
                           Vector3::Unit(k - 3).cross(place.axis.direction);
}

}  // namespace

Effect location_effect(const kinematics::Chain& chain, bool pivots) {
    Effect effect{identity_of(EffectKind::location),
                  "The rotary axes do not lie where the simulation has them",
                  "assembly, a crash, thermal growth since the last calibration",
                  pivots ? "enter the identified values in the setup and in the control's pivot "
                           "parameters"
                         : "enter the identified values in the setup, and in what steers the "
                           "machine if that has a model of its axes; else align the axes",
                  "constant error motion: x' = q + d + exp(e x) Rot (x - q), d and e at home",
                  {},
                  {}};
    const std::vector<Place> places = places_of(chain);
    for (const Place& place : places) effect.parameters.push_back(parameter_of(place));
    effect.add = [places](const AxisSample& sample, const emulator::Contact&,
                          std::span<const double> value, kinematics::Perturbation& out) {
        for (std::size_t j = 0; j < places.size(); ++j) add_place(places[j], value[j], sample, out);
    };
    return effect;
}

}  // namespace trunnion::effects
