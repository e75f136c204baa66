#include "emulator/instruments.h"

#include "ballbar/ballbar.h"
#include "emulator/displacement.h"
#include "emulator/points.h"

namespace trunnion::emulator {
namespace {

Vector3 shift_of(const setup::ExtensionErrors& errors, const Contact& contact) {
    const auto it = errors.find(contact.extension_mm);
    return it == errors.end() ? Vector3(Vector3::Zero()) : it->second;
}

Vector3 center_W_mm(const InstrumentView& view) {
    const auto k = static_cast<std::size_t>(view.contact.artefact);
    Vector3 center = view.setup.artefacts[k].center_W_mm + view.state.extra.work_shift_mm;
    if (k < view.offsets.artefact.size()) center += view.offsets.artefact[k];
    return center;
}

probe::TouchProbe probe_of(const InstrumentView& view) {
    const setup::ProbeSettings& probe = *view.setup.probe;
    return {probe.tip_with(view.contact.extension_mm) +
                shift_of(view.offsets.stylus_S, view.contact) + view.state.extra.tip_shift_mm,
            probe.ball_diameter_mm};
}

probe::SphereTarget sphere_of(const InstrumentView& view) {
    const auto k = static_cast<std::size_t>(view.contact.artefact);
    return {center_W_mm(view), view.setup.artefacts[k].diameter_mm};
}

double sphere_mm(const InstrumentView& view) {
    return -centre_to_tip_M(view).dot(view.contact.direction_M) + view.state.extra.reading_mm;
}

double touch_mm(const InstrumentView& view) {
    return view.contact.along_mm + way_to_contact(view).way_mm + view.state.extra.reading_mm;
}

double ballbar_mm(const InstrumentView& view) {
    const setup::BallbarSettings& bar = *view.setup.ballbar;
    const Vector3 cup_S_mm = bar.cup_with(view.contact.extension_mm) + view.offsets.cup_S +
                             shift_of(view.offsets.long_cup_S, view.contact) +
                             view.state.extra.tip_shift_mm;
    const ballbar::Ballbar mounted{cup_S_mm, center_W_mm(view),
                                   bar.warm_length_mm() + view.offsets.length};
    return ballbar::length_deviation_mm(view.state.poses, mounted) + view.state.extra.reading_mm;
}

/// One device: its reading, the kind of artefact it reads, and the requirements on the setup.
struct DeviceEntry {
    records::Device device;
    double (*read)(const InstrumentView&);
    setup::Artefact::Kind target;
    bool (*mounted)(const setup::Setup&);
    const char* missing;
};

bool always(const setup::Setup&) {
    return true;
}

constexpr DeviceEntry devices[] = {
    {records::Device::sphere, sphere_mm, setup::Artefact::Kind::sphere,
     [](const setup::Setup& s) { return s.probe.has_value(); }, "a probe row, but no [probe]"},
    {records::Device::touch, touch_mm, setup::Artefact::Kind::sphere,
     [](const setup::Setup& s) { return s.probe.has_value(); }, "a probe row, but no [probe]"},
    {records::Device::ballbar, ballbar_mm, setup::Artefact::Kind::center_pivot,
     [](const setup::Setup& s) { return s.ballbar.has_value(); },
     "a ballbar row, but no [ballbar]"},
    {records::Device::point, point_mm, setup::Artefact::Kind::target, always, ""},
    {records::Device::linear, linear_mm, setup::Artefact::Kind::target, always, ""},
    {records::Device::angle, angle_rad, setup::Artefact::Kind::target, always, ""},
    {records::Device::axis, encoder_mm, setup::Artefact::Kind::target, always, ""},
};

const DeviceEntry& entry_of(records::Device device) {
    for (const DeviceEntry& entry : devices)
        if (entry.device == device) return entry;
    throw InputError("no prediction for device '" + std::string(name_of(device)) + "'");
}

int artefact_index(const setup::Setup& setup, const std::string& name) {
    for (std::size_t k = 0; k < setup.artefacts.size(); ++k)
        if (setup.artefacts[k].name == name) return static_cast<int>(k);
    throw InputError(name.empty() ? "the row names no artefact (column 'feature')"
                                  : "the setup has no artefact named '" + name + "'");
}

}  // namespace

int instrument_of_row(const setup::Setup& setup, const records::Reading& row) {
    if (row.instrument.empty()) return setup.instruments.empty() ? -1 : 0;
    for (std::size_t k = 0; k < setup.instruments.size(); ++k)
        if (setup.instruments[k].name == row.instrument) return static_cast<int>(k);
    throw InputError("the setup has no [[instrument]] named '" + row.instrument + "'");
}

double reading_mm(const InstrumentView& view) {
    return entry_of(view.contact.device).read(view);
}

Vector3 centre_to_tip_M(const InstrumentView& view) {
    return centre_to_tip_M(view.state.poses, probe_of(view), sphere_of(view));
}

probe::WayToSphere way_to_contact(const InstrumentView& view) {
    return probe::way_to_sphere(centre_to_tip_M(view), view.contact.direction_M,
                                probe::reach_mm(probe_of(view), sphere_of(view)));
}

Contact contact_of(const setup::Setup& setup, const kinematics::MachinePose& nominal,
                   const records::Reading& row) {
    const DeviceEntry& entry = entry_of(row.device);
    if (!entry.mounted(setup)) throw InputError(std::string(entry.missing) + " in the setup");
    Contact contact;
    contact.device = row.device;
    if (row.device == records::Device::axis) {
        aim_at_encoder(setup, row, contact);
        return contact;
    }
    contact.artefact = artefact_index(setup, row.feature);
    contact.extension_mm = row.extension_mm;
    contact.direction_M = row.direction_M;
    const setup::Artefact& artefact = setup.artefacts[static_cast<std::size_t>(contact.artefact)];
    if (artefact.kind != entry.target && entry.target == setup::Artefact::Kind::sphere)
        throw InputError("a probe row on '" + artefact.name + "', which is no sphere");
    if (artefact.kind != entry.target && entry.target == setup::Artefact::Kind::target)
        throw InputError(std::string(name_of(row.device)) + " row on '" + artefact.name +
                         "', which is no target");
    if (row.device == records::Device::point) aim_at_point(setup, row, contact);
    if (row.device == records::Device::linear || row.device == records::Device::angle)
        aim_at_displacement(setup, row, contact);
    if (row.device == records::Device::ballbar)
        contact.direction_M =
            ballbar::cup_to_pivot_M(
                nominal, {setup.ballbar->cup_with(row.extension_mm), artefact.center_W_mm})
                .normalized();
    contact.direction_W = nominal.pose_MW.rotation.transpose() * contact.direction_M;
    return contact;
}

}  // namespace trunnion::emulator
