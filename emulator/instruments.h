// The reading of each device in one state of the machine: the table used by the observer.
#pragma once

#include "emulator/effect_model.h"
#include "probe/touch_probe.h"
#include "setup/setup.h"

namespace trunnion::emulator {

/// Poses of the bodies and contributions of the effects at one sample.
struct PhysicalState {
    kinematics::MachinePose poses;
    kinematics::Perturbation
        extra;  ///< contributions of effects; the device uses its tip, work and reading shifts
};

/// Differences of set-up quantities from the setup file, mm and rad.
struct ReplayOffsets {
    std::vector<Vector3> artefact;  ///< by artefact: centre in W, or target of the tool in S
    struct InstrumentError {
        SmallMotion pose;
        double scale = 0.0;
    };
    std::vector<InstrumentError> instruments;
    std::vector<double> zeros;                      ///< tests of linear and angle rows, mm or rad
    std::array<double, axis_count> encoder_zero{};  ///< of axis rows, mm or rad
    Vector3 cup_S = Vector3::Zero();
    double length = 0.0;                          ///< of the ballbar, mm
    setup::ExtensionErrors stylus_S, long_cup_S;  ///< by extension
    /// Offsets of the second and later sessions, replacing all but `zeros`: set-up quantities are
    /// independent in each session. A session without an entry uses the first one.
    std::vector<ReplayOffsets> later_sessions = {};
};

/// One reading in one state.
struct InstrumentView {
    const setup::Setup& setup;
    const ReplayOffsets& offsets;
    const Contact& contact;
    const PhysicalState& state;
};

/// Reading of the contact's device, mm, rad for angle rows and rotary axes (formats.md,
/// "Readings"). For a touch in a state away from the contact, the remaining distance is added as if
/// the machine did not change along it. Throws InputError without position for a device without
/// prediction.
double reading_mm(const InstrumentView& view);

/// From the centre of the contact's sphere to the stylus ball centre, in M, mm.
Vector3 centre_to_tip_M(const InstrumentView& view);
/// Distance from this state to the contact of the stylus ball with the sphere, as if the machine
/// did not change along it.
probe::WayToSphere way_to_contact(const InstrumentView& view);

/// Index in Setup::instruments of the one that reads the row: the first where it names none, -1
/// without any. Throws InputError without position for a name that the setup does not have.
int instrument_of_row(const setup::Setup& setup, const records::Reading& row);

/// The device's contact at the nominal pose of a row. Throws InputError without position when the
/// setup lacks the device or the artefact.
Contact contact_of(const setup::Setup& setup, const kinematics::MachinePose& nominal,
                   const records::Reading& row);

}  // namespace trunnion::emulator
