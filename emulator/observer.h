// The one door to the physical machine: where its bodies are and what its devices read, with errors
// and effects. run, predict, identify, diagnose, compensate, volumetric and --truth ask it.
#pragma once

#include "emulator/instruments.h"
#include "kinematics/forward.h"

namespace trunnion::emulator {

/// For the errors of the spindle.
inline kinematics::SpindleAngle spindle_angle(const AxisSample& sample) {
    return sample.spindle_turns ? std::nullopt : kinematics::SpindleAngle(sample.spindle_rad);
}

/// A touch of a sphere along a straight line through the commanded end point.
struct TouchReading {
    double contact_mm = 0.0;  ///< where the ball meets the sphere, from the end along the direction
    double value_mm = 0.0;    ///< where the skip latches: later by what the probe adds
    bool meets = true;        ///< false: the line passes the sphere by
};

/// Noise-free and, as far as the effects are, smooth. Same sample and contact: the same reading.
class Observer {
  public:
    /// `setup` must outlive the observer; `machine` and `offsets` may differ from it (a fit).
    Observer(const setup::Setup& setup, const kinematics::Machine& machine, EffectModels effects,
             ReplayOffsets offsets = {});
    Observer(const setup::Setup& setup, EffectModels effects)
        : Observer(setup, setup.machine, std::move(effects)) {}

    const setup::Setup& setup() const { return setup_; }
    /// The machine at a sample; the contact says which device reads.
    PhysicalState at(const AxisSample& sample, const Contact& contact) const;
    /// The machine with its errors, without effects.
    kinematics::MachinePose nominal(const AxisSample& sample) const;
    /// What the contact's device reads, mm.
    double read(const AxisSample& sample, const Contact& contact) const;
    /// The touch is a root along the line: effects are those at the axis positions of the contact,
    /// found to 1e-11 mm where they change by less than the way, else to 1e-10 mm. The sample may
    /// stand anywhere on the line (`contact.along_mm`).
    TouchReading touch(const AxisSample& sample, const Contact& contact) const;
    /// Moves the sample to that contact.
    void go_to_contact(AxisSample& sample, Contact& contact) const;
    /// From the centre of the contact's sphere to the stylus ball, and how long that is in contact.
    Vector3 centre_to_tip_M(const AxisSample& sample, const Contact& contact) const;
    double reach_mm(const Contact& contact) const;

  private:
    InstrumentView view(const Contact& contact, const PhysicalState& state) const {
        return {setup_, offsets_, contact, state};
    }

    const setup::Setup& setup_;
    kinematics::ForwardModel model_;
    EffectModels effects_;
    ReplayOffsets offsets_;
};

}  // namespace trunnion::emulator
