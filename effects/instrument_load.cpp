// Sensor gain, and play that depends on the load.
#include <algorithm>

#include "effects/models.h"

namespace trunnion::effects {

namespace {

/// One gain of all readings, or where the setup has several instruments one of each.
std::vector<EffectParameter> gains_of(const std::vector<setup::Instrument>& instruments) {
    if (instruments.size() < 2) return {{"gain_ppm", "ppm", 10.0, -1, {}, true}};
    std::vector<EffectParameter> list;
    for (const setup::Instrument& instrument : instruments) {
        list.push_back({"gain_" + instrument.name + "_ppm", "ppm", 10.0, -1, {}, true});
        list.back().also_set_by = "gain_ppm";
    }
    return list;
}

}  // namespace

Effect sensor_gain(const std::vector<setup::Instrument>& instruments) {
    return {identity_of(EffectKind::sensor_gain),
            "The instrument reads distances too long or too short, in proportion",
            "wavelength without compensation of air, scale of a tracker, gain of an encoder; in a "
            "servo log a drive that yields to a load that follows the position",
            "calibrate the instrument on a known length; correct for air temperature and pressure",
            "reading + gain_ppm 1e-6 * what is read: position along the component (point, linear), "
            "position of the axis (axis); of several [[instrument]] each has its own "
            "gain_NAME_ppm",
            gains_of(instruments),
            [](const AxisSample& sample, const emulator::Contact& contact,
               std::span<const double> value, kinematics::Perturbation& out) {
                const auto reader = static_cast<std::size_t>(std::max(0, contact.instrument));
                const double gain = 1e-6 * value[value.size() > 1 ? reader : 0];
                if (contact.device == records::Device::point)
                    out.reading_mm += gain * contact.direction_I.dot(contact.turned_I_mm);
                if (contact.device == records::Device::linear)
                    out.reading_mm +=
                        gain * contact.direction_W.dot(contact.believed_WS.translation_mm);
                if (contact.device == records::Device::axis)
                    out.axis[contact.axis] += gain * sample.position[contact.axis];
            },
            SeenBy::any_encoder};
}

Effect linear_play_load(const kinematics::AxisGeometry& axis) {
    return {identity_of(axis, EffectKind::play_load),
            "The play of the axis grows with the load on the table",
            "nut or bearing without preload, gibs that open under weight",
            "restore the preload; measure and cut with the same load",
            "position + gap_mm / 2 * load / 100 kg * sign of travel (cancels in a found sphere "
            "centre)",
            {{"gap_mm", "mm", 5e-3, -1, {}, true}},
            [k = axis.axis](const AxisSample& sample, const emulator::Contact&,
                            std::span<const double> value, kinematics::Perturbation& out) {
                out.axis[k] += 0.5 * value[0] * sample.load_kg / 100.0 * sample.travel[index_of(k)];
            },
            SeenBy::scale};
}

}  // namespace trunnion::effects
