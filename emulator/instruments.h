// What each device reads in one state of the machine: the list that the observer asks.
#pragma once

#include "emulator/effect_model.h"
#include "probe/touch_probe.h"
#include "setup/setup.h"

namespace trunnion::emulator {

/// Where the bodies and the device are at one sample.
struct PhysicalState {
    kinematics::MachinePose poses;
    kinematics::Perturbation
        extra;  ///< what effects add: the device reads tip, work and reading shifts here
};

/// Set-up quantities that differ from the setup file's, mm.
struct ReplayOffsets {
    std::vector<Vector3> artefact;  ///< by artefact: of its centre in W, of a tool's target in S
    struct InstrumentError {
        SmallMotion pose;
        double scale = 0.0;
    };
    std::vector<InstrumentError> instruments;
    std::vector<double> zeros;  ///< of the tests of linear and angle rows, mm or rad
    Vector3 cup_S = Vector3::Zero();
    double length = 0.0;                          ///< of the ballbar
    setup::ExtensionErrors stylus_S, long_cup_S;  ///< by extension
    /// Of the second session and on, in place of all but `zeros`: what belongs to a set-up begins
    /// anew with each. Fewer than there are: a session without an entry is as the first one.
    std::vector<ReplayOffsets> later_sessions = {};
};

/// One reading to be taken in one state.
struct InstrumentView {
    const setup::Setup& setup;
    const ReplayOffsets& offsets;
    const Contact& contact;
    const PhysicalState& state;
};

/// What the contact's device reads, mm (formats.md, "Readings"). A touch in a state that stands
/// away from the contact: the rest of the way, as if the machine did not change on it, is counted
/// in. Throws InputError without a place for a device that has no prediction.
double reading_mm(const InstrumentView& view);

/// From the centre of the contact's sphere to the stylus ball's.
Vector3 centre_to_tip_M(const InstrumentView& view);
/// Way from this state to where the stylus ball meets the sphere, as if the machine did not change
/// on it.
probe::WayToSphere way_to_contact(const InstrumentView& view);

/// Ready to be read: the device's contact at a row's nominal pose. Throws InputError without a
/// place when the setup lacks the device or the artefact.
Contact contact_of(const setup::Setup& setup, const kinematics::MachinePose& nominal,
                   const records::Reading& row);

}  // namespace trunnion::emulator
