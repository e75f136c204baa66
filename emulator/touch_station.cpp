#include "emulator/touch_station.h"

#include "base/units.h"

namespace trunnion {

TouchStation::TouchStation(const Setup& setup, std::uint64_t seed) : setup_(setup), noise_(seed) {}

bool TouchStation::mounted(const AxisMove& move) const {
    if (!setup_.probe) return false;
    return setup_.probe->tool == 0 || move.tool == 0 || move.tool == setup_.probe->tool;
}

std::optional<Touch> TouchStation::touch(const PathSampler& path, const PhysicalMachine& machine) {
    const ProbeSettings& settings = *setup_.probe;
    const Vector3 way =
        path.move.parallel.linear(path.move.to) - path.move.parallel.linear(path.move.from);
    Contact contact;
    contact.device = Device::touch;
    contact.extension_mm = path.shop.extension_mm;
    const Vector3 tip_S_mm = settings.tip_with(path.shop.extension_mm);
    if (way.norm() > 0.0) contact.direction_M = way.normalized();
    std::optional<double> first;
    for (std::size_t i = 0; i < setup_.artefacts.size(); ++i) {
        const Artefact& artefact = setup_.artefacts[i];
        if (artefact.kind != Artefact::Kind::sphere) continue;
        Contact here = contact;
        here.artefact = static_cast<int>(i);
        const auto separation = [&](double s) -> Vector3 {
            const PhysicalState state = machine.at(path.at(s), here);
            return state.poses.pose_MS * (tip_S_mm + state.extra.tip_shift_mm) -
                   state.poses.pose_MW * (artefact.center_W_mm + state.extra.work_shift_mm);
        };
        const double reach_mm = 0.5 * (settings.ball_diameter_mm + artefact.diameter_mm);
        const auto s = first_contact(separation, reach_mm);
        if (s && (!first || *s < *first)) {
            first = s;
            contact.artefact = here.artefact;
        }
    }
    if (!first) return std::nullopt;
    return latched(path, machine, contact, *first);
}

std::optional<Touch> TouchStation::latched(const PathSampler& path, const PhysicalMachine& machine,
                                           Contact contact, double contact_s) {
    const ProbeSettings& settings = *setup_.probe;
    const PhysicalState state = machine.at(path.at(contact_s), contact);
    contact.direction_W = state.poses.pose_MW.rotation.transpose() * contact.direction_M;
    const double reading_mm = machine.at(path.at(contact_s), contact).extra.reading_mm;
    const double noise_mm = mm_from_um(settings.repeatability_um) * noise_.normal();
    const double over_mm = mm_from_um(settings.pretravel_um) + reading_mm + noise_mm;
    const auto gauge = [&](double s) { return path.move.parallel.linear(path.move.at(s)); };
    const auto s = latch(gauge, contact_s, over_mm);
    if (!s) return std::nullopt;
    Touch touch;
    touch.s = *s;
    touch.stopped = path.move.at(*s);
    touch.sphere = &setup_.artefacts[static_cast<std::size_t>(contact.artefact)];
    touch.direction_M = contact.direction_M;
    touch.value_mm = contact.direction_M.dot(path.move.parallel.linear(touch.stopped) -
                                             path.move.parallel.linear(path.move.to));
    return touch;
}

}  // namespace trunnion
